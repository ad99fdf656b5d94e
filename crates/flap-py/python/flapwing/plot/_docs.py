"""Paragraphs that docstrings of several pictures share."""

from __future__ import annotations

from typing import Callable, TypeVar

_F = TypeVar("_F", bound=Callable[..., object])

_PARAGRAPHS = {
    "%(where)s": """\
where, **slices
        Columns and the value that rows must have, a number in SI units or a word: the slice of a grid with more axes.
        In the mapping `where`, or as keywords such as ``drive_voltage_pp=100``.""",
    "%(axes)s": """\
ax : matplotlib Axes, optional
        Axes to draw in; by default those of a new figure.

    Returns
    -------
    matplotlib Axes""",
}


def completed(function: _F) -> _F:
    """The function, its docstring with paragraphs in place of their names."""
    for name, paragraph in _PARAGRAPHS.items():
        if function.__doc__:
            function.__doc__ = function.__doc__.replace(name, paragraph)
    return function
