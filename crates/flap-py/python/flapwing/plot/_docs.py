"""Paragraphs that docstrings of several pictures share."""

from __future__ import annotations

from typing import Callable, TypeVar

_F = TypeVar("_F", bound=Callable[..., object])

_PARAGRAPHS = {
    "%(where)s": """\
where, **slices
        Columns and the value that rows must have, a number in SI units, text with a unit or a word: the slice of a grid
        with more axes. In the mapping `where`, or as keywords such as ``drive_voltage_pp="100 V"``. An axis that is
        neither drawn nor chosen is fixed at its middle value, which a warning tells.""",
    "%(legend)s": """\
legend : bool or str
        False for no legend, or a place inside the axes such as ``"upper left"``. By default it is beside new axes,
        and inside axes that are given.""",
    "%(colorbar)s": """\
colorbar : bool or matplotlib Axes
        False for no colour bar, or the axes to draw it in. By default it takes its room from the axes.""",
    "%(axes)s": """\
ax : matplotlib Axes, optional
        Axes to draw in, in the look of their figure: nothing is drawn outside them but their labels and a colour bar.
        By default those of a new figure.

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
