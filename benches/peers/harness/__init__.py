"""Runs flap and other solvers on the same points, in turn, and compares speeds and results.

The package requires only Python's standard library. A peer is one of the compared programs, and can have further
requirements.
"""
