"""Runs flap and other solvers on the same points, in turn, and compares their speed and their answers.

Needs nothing but Python's standard library; what a peer needs is the peer's matter.
"""
