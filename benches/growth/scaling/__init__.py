"""Sweeps of ever more points, with their times, their memory and a picture of both.

Needs nothing but Python's standard library.
"""
