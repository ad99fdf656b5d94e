"""Words and readable units for columns. It knows how columns are named, and no picture."""

from __future__ import annotations

import math
import re
from typing import Mapping, NamedTuple

import numpy as np

from .._flapwing import split_unit

# What is said behind a comma.
_QUALIFIERS = {
    "pp": "peak to peak",
    "amplitude": "amplitude",
    "mean": "mean",
    "max": "largest",
    "min": "smallest",
    "peak": "peak",
    "rms": "rms",
    "first": "first harmonic",
    "magnitude": "mean magnitude",
    "supply": "supply",
    "lag": "lag",
}

# Nouns that names of measures put before what describes them: power_drag_mean_mw is a drag power.
_NOUNS = {"lift", "drag", "power", "current", "force", "efficiency", "strain", "field"}

# Parameters whose last word is part of the noun, not a qualifier.
_WHOLE = {"drag_max", "drag_min", "lift_max"}

_PREFIXES = {9: "G", 6: "M", 3: "k", 0: "", -3: "m", -6: "µ", -9: "n", -12: "p"}
_SYMBOLS = {"m", "s", "N", "Pa", "V", "F", "kg", "Hz", "W", "A", "J", "Ohm", "C"}
_SUPERSCRIPTS = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


class Scale(NamedTuple):
    """What values are multiplied with to be shown, and the unit they are then in."""

    factor: float
    unit: str


def unit_of(name: str, units: Mapping[str, str]) -> str:
    """The unit of a column as flap writes it, from a table's units or else from the ending of the name."""
    return units[name] if name in units else split_unit(name)[1]


def words(name: str, unit: str = "") -> str:
    """A column's name in words, without its unit: `lift_mean_mn` is "Lift, mean"."""
    stem, measure = name, name.startswith("strain_")
    shortened, meant = split_unit(name)
    if meant and unit in ("", meant):
        stem, measure = shortened, True
    if stem in _WHOLE:
        return stem.replace("_", " ").capitalize()
    parts = stem.split("_")
    if stem.startswith("mode_") or len(parts) < 1:
        noun, behind = parts, []
    else:
        first = next((i for i, part in enumerate(parts) if i > 0 and part in _QUALIFIERS), len(parts))
        noun, behind = parts[:first], parts[first:]
    if measure and noun[0] in _NOUNS and len(noun) > 1 and not noun[1].isdigit() and noun[1] != "audit":
        noun = noun[1:] + noun[:1]
    text = " ".join(noun)
    said = [_QUALIFIERS.get(part, part) for part in behind]
    if behind and not all(part in _QUALIFIERS for part in behind):
        said = [" ".join(said)]
    return ", ".join([text[:1].upper() + text[1:], *said])


def pretty(unit: str) -> str:
    """A unit as people write it: `uN*m/rad` is "µN·m/rad", `mm^2` is "mm²", `deg` is "°"."""
    unit = re.sub(r"\bu(?=[A-Za-z])", "µ", unit.replace("*", "·"))
    unit = re.sub(r"\^(-?\d+)", lambda match: match.group(1).translate(_SUPERSCRIPTS), unit)
    return re.sub(r"\bdeg\b", "°", unit)


def scale(values: object, unit: str) -> Scale:
    """How values in an SI unit are best shown: with the prefix that brings the largest near to 1 to 1000."""
    if unit == "rad":
        return Scale(180.0 / math.pi, "°")
    if unit == "rad/s":
        return Scale(0.18 / math.pi, "°/ms")
    found = re.match(r"([A-Za-z]+)(?:\^(\d+))?(.*)$", unit)
    numbers = np.abs(np.asarray(values, dtype=float))
    numbers = numbers[np.isfinite(numbers)]
    largest = float(numbers.max()) if numbers.size else 0.0
    if found is None or found.group(1) not in _SYMBOLS or largest == 0.0 or 0.1 <= largest < 1e4:
        return Scale(1.0, pretty(unit))
    if unit == "kg*m^2":
        return Scale(1e12, "mg·mm²") if largest < 1e-9 else Scale(1e9, "g·mm²")
    symbol, power, rest = found.group(1), int(found.group(2) or 1), found.group(3)
    if symbol == "kg":
        symbol, base = "g", 3
    else:
        base = 0
    steps = math.floor((math.log10(largest) + base + 1e-9) / (3 * power))
    exponent = max(-12, min(9, 3 * steps))
    factor = float(f"1e{base - exponent * power}")
    return Scale(factor, _PREFIXES[exponent] + symbol + pretty((f"^{power}" if power > 1 else "") + rest))


def label(name: str, unit: str | None = None) -> str:
    """The label of an axis for a column.

    Parameters
    ----------
    name : str
        The column's name.
    unit : str, optional
        Its unit, as in `Table.units`; by default what the ending of the name says.

    Returns
    -------
    str
        The name in words, and the unit in parentheses if there is one.

    Examples
    --------
    >>> label("power_mean_mw")
    'Power, mean (mW)'
    >>> label("drive_voltage_pp", "V")
    'Drive voltage, peak to peak (V)'
    """
    unit = unit_of(name, {}) if unit is None else unit
    return titled(words(name, unit), pretty(unit))


def titled(text: str, unit: str) -> str:
    """Words and a unit, if there is one, in parentheses."""
    return f"{text} ({unit})" if unit else text


def number(value: float) -> str:
    """A number with up to four digits, without an exponent where that is short."""
    text = f"{value:.4g}"
    if "e" not in text:
        return text.replace("-", "−")
    mantissa, exponent = text.split("e")
    return f"{mantissa}×10{str(int(exponent)).translate(_SUPERSCRIPTS)}".replace("-", "−")
