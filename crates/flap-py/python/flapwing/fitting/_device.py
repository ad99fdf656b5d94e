"""The device file of a fit, with parameters, standard errors and correlations. The device file describes a design,
which you can pass to functions of flapwing.
"""

from __future__ import annotations

import json
import os
import re
from typing import Any

import numpy as np

from .. import _flapwing
from .._evaluate import evaluate
from .._mistakes import refused
from ._solution import Solution

#: Largest correlation in a device file. With larger correlations, rounding could make the correlation matrix
#: indefinite.
_NEAREST = 0.999999

#: The text that a fit adds to the description of a device; a later fit of the same robot replaces this text.
_FITTED = re.compile(r"(; |^)fitted to \d+ readings, .*", re.DOTALL)


def write(fit: Solution, path: str | os.PathLike[str], data_set: str | None, overwrite: bool) -> None:
    """Write the result of a fit to a device file. Raise FileExistsError if `path` exists and `overwrite` is False."""
    if not isinstance(path, (str, os.PathLike)):
        raise refused("path", path, "it must be the path of a device file")
    text = text_of(fit, data_set)
    try:
        with open(path, "w" if overwrite else "x", encoding="utf-8") as file:
            file.write(text)
    except FileExistsError:
        raise FileExistsError(f"{os.fspath(path)} already exists\ngive another path, or overwrite=True") from None


def text_of(fit: Solution, data_set: str | None) -> str:
    """Return the text of the device file of a fit."""
    fitted = _fitted(fit, data_set)
    names = fit._model.names
    base = {parameter["name"]: parameter["value"] for parameter in _flapwing.params(names.grid.preset)}
    good = fit.goodness
    readings = sum(one.count for one in good.residuals)
    quality = f"chi-square {good.chi_square:.4g} for {good.freedom} degrees of freedom"
    description, sources = _flapwing.origins(names.grid)
    described = "; ".join(
        part for part in (_FITTED.sub("", description), f"fitted to {readings} readings, {quality}") if part
    )
    lines = [
        f"description = {_text(described)}",
        f'preset = "{names.grid.preset}"',
        "",
        "[params]",
    ]
    errors, earlier_correlations = _flapwing.uncertainty(names.grid)
    # A fitted or newly set value does not keep the old error and source.
    new_values = {*fitted, *fit._model.keywords, *names.grid.varied}
    errors = {name: error for name, error in errors.items() if name not in new_values}
    sources = {name: source for name, source in sources.items() if name not in new_values}
    for name, value in {**fit._model.nominal, **_derived(fit, fitted)}.items():
        entries = [f"sd = {errors[name]!r}"] if name in errors else []
        entries += [f"source = {_text(sources[name])}"] if name in sources else []
        if entries:
            lines.append(f"{name} = {{ {', '.join([f'value = {_cell(value)}', *entries])} }}")
        elif name not in fitted and not _same(value, base.get(name)):
            lines.append(f"{name} = {_cell(value)}")
    place = {label: number for number, label in enumerate(fit.estimates)}
    known = []
    for name, label in fitted.items():
        one = fit.estimates[label]
        if np.isfinite(one.error) and one.error > 0:
            known.append((name, place[label]))
            doubt = (
                "" if one.is_known else ", at the end of its range" if one.at_bound else ", but not fixed by the data"
            )
            lines.append(f'{name} = {{ value = {one.value!r}, sd = {one.error!r}, source = "fitted{doubt}" }}')
        else:
            lines.append(f'{name} = {{ value = {one.value!r}, source = "not fixed by the data of the fit" }}')
    coefficients = [one for one in earlier_correlations if one[0] in errors and one[1] in errors]
    correlations = fit.correlations
    for number, (name, row) in enumerate(known):
        for other, column in known[:number]:
            coefficients.append((other, name, float(np.clip(correlations[row, column], -_NEAREST, _NEAREST))))
    for first, second, coefficient in coefficients:
        lines += ["", "[[correlation]]", f'between = ["{first}", "{second}"]', f"coefficient = {coefficient!r}"]
    return "\n".join(lines) + "\n"


def _fitted(fit: Solution, data_set: str | None) -> dict[str, str]:
    """Return a dictionary from the name of each fitted parameter to the key of this parameter in `Fit.estimates`. If
    each data set has a separate value of a parameter, the dictionary contains the key for the chosen data set.
    """
    place = None if data_set is None else fit._place(data_set)
    labels = {}
    for one in fit._model.space.coordinates:
        if one.of_set is not None and place is None:
            known = ", ".join(each.name for each in fit._sets)
            raise ValueError(f"each data set has its own `{one.parameter}`\ngive data_set=, one of {known}")
        if one.of_set in (None, place):
            labels[one.parameter] = one.label
    return labels


def _derived(fit: Solution, labels: dict[str, str]) -> dict[str, float]:
    """Return the derived parameters of the design, computed from the fitted parameters. Raise ValueError if a derived
    parameter has different values at different readings.
    """
    model = fit._model
    names = model.names.grid.varied
    if not names:
        return {}
    keywords: dict[str, Any] = {name: value for name, value in model.keywords.items() if name not in model.points}
    keywords |= {name: fit.estimates[label].value for name, label in labels.items()}
    measure = [model.outputs.measure[0]]
    table = evaluate(model.names.grid, model.points, measures=measure, **keywords)
    for name in names:
        if np.ptp(table[name]) > 1e-9 * np.abs(table[name]).max():
            raise ValueError(
                f"the derived parameter `{name}` differs between the readings, so a device cannot contain it\n"
                "use the grid of the fit with the fitted values: flapwing.run(grid, **fit.values)"
            )
    return {name: float(table[name][0]) for name in names}


def _same(value: Any, other: Any) -> bool:
    if isinstance(value, float) and np.isnan(value):
        return True
    return bool(value == other)


def _text(text: str) -> str:
    return json.dumps(text, ensure_ascii=False).replace("\x7f", "\\u007f")


def _cell(value: Any) -> str:
    return _text(value) if isinstance(value, str) else repr(float(value))
