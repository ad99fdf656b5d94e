"""Sweeps of increasing numbers of points, with the times and the memory of the sweeps, and a picture of both
quantities.

The package requires only Python's standard library.
"""
