"""Comparison of rows."""


def is_same(one, other) -> bool:
    """True of equal values, and of equal rows. Values without a number are equal too."""
    if isinstance(one, dict):
        return list(one) == list(other) and all(is_same(one[name], other[name]) for name in one)
    return one == other or (one != one and other != other)
