"""Labels of columns, and numbers as text for pictures."""

from __future__ import annotations

import textwrap
from collections.abc import Iterator

import numpy as np

from ._flapwing import better, printed, scale, split_unit, unit_of, words

__all__ = [
    "better",
    "label",
    "lowered",
    "number",
    "printed",
    "readable",
    "split_unit",
    "titled",
    "unit_of",
    "words",
    "wrapped",
]

_SUPERSCRIPTS = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


def readable(values: object, unit: str) -> tuple[float, str]:
    """Return the factor from `unit` to a unit in which values are easy to read, and the printed name of the readable
    unit.
    """
    sizes = np.abs(np.asarray(values, dtype=float))
    return scale(unit, float(np.max(sizes, initial=0.0, where=np.isfinite(sizes))))


def label(name: str, unit: str | None = None) -> str:
    """Return the label of an axis for a column.

    Parameters
    ----------
    name : str
        The column's name.
    unit : str, optional
        The unit of the column, as in `Table.units`. The default of `unit` is the unit at the end of the name of the
        column.

    Returns
    -------
    str
        The name of the column in words. If the column has a unit, the unit follows in parentheses.

    Examples
    --------
    >>> label("power_mean_mw")
    'Power, mean (mW)'
    >>> label("drive_voltage_pp", "V")
    'Drive voltage, peak to peak (V)'
    """
    unit = split_unit(name)[1] if unit is None else unit
    return titled(words(name, unit), printed(unit))


def titled(text: str, unit: str) -> str:
    """Return the text of a label. If `unit` is not empty, the unit follows in parentheses."""
    return f"{text} ({unit})" if unit else text


def lowered(text: str) -> str:
    """Return words with a small first letter, for use within a sentence."""
    return text[:1].lower() + text[1:]


def number(value: float) -> str:
    """Return a number as text with up to four digits. Very large and very small numbers are written with a power of
    ten."""
    text = f"{value:.4g}"
    if "e" not in text:
        return text.replace("-", "−")
    mantissa, exponent = text.split("e")
    return f"{mantissa}×10{str(int(exponent)).translate(_SUPERSCRIPTS)}".replace("-", "−")


def wrapped(title: str) -> Iterator[str]:
    """Yield versions of a title with more and more line breaks. The first version of the title is unchanged."""
    versions = [title]
    yield title
    for width in range(max(map(len, title.split("\n"))) - 1, 7, -1):
        lines = "\n".join(
            textwrap.fill(line, width, break_long_words=False, break_on_hyphens=False) for line in title.split("\n")
        )
        if lines.count("\n") != versions[-1].count("\n"):
            versions.append(lines)
            yield lines
