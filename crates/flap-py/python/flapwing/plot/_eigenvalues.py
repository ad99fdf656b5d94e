"""A map of the eigenvalues of linear models in the complex plane."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from matplotlib.axes import Axes

from .._mistakes import refused
from . import _style
from ._checks import checked

#: The markers of models, in the order of the models.
_MARKERS = "oxs^Dv+P"


@checked
def eigenvalues(models: Any, *, legend: bool | str = True, ax: Axes | None = None) -> _style.Drawn:
    """Draw the eigenvalues of linear models in the complex plane. A mode grows over time if its eigenvalue has a
    positive real part, to the right of the vertical line.

    Parameters
    ----------
    models : LinearModel, or mapping of names to LinearModel
        One linear model, or several linear models with names. You can give an array of eigenvalues (1/s) instead of a
        model.
    legend, ax
        These arguments have the same meaning as in `flapwing.plot.response`. If `models` is one LinearModel without a
        name, the picture has no legend.

    Returns
    -------
    matplotlib Axes

    Raises
    ------
    ValueError
        Raised if `models` is empty.
    TypeError
        Raised if an entry of `models` is neither a LinearModel nor an array of numbers.

    Examples
    --------
    >>> ax = eigenvalues({"passive": [3.1 + 10.1j, 3.1 - 10.1j, -1.9], "frozen": [6.5 + 18.3j, 6.5 - 18.3j, -3.1]})
    >>> ax.get_xlabel()
    'Real part (1/s)'
    """
    named = dict(models) if isinstance(models, Mapping) else {"": models}
    if not named:
        raise ValueError("`models` is empty\nit must contain at least one linear model")
    values = {name: _values(name, model) for name, model in named.items()}
    given = ax is not None
    with _style.applied(ax):
        ax = _style.axes_of(ax, 6.4, 4.4)
        ax.axvline(0.0, color=_style.ink(ax), linewidth=_style.width(0.5), zorder=0.5)
        colours = _style.series()
        for place, (name, each) in enumerate(values.items()):
            ax.plot(
                each.real,
                each.imag,
                linestyle="none",
                marker=_MARKERS[place % len(_MARKERS)],
                markersize=_style.size(1.0),
                color=colours[place % len(colours)],
                label=str(name),
            )
        ax.set_xlabel("Real part (1/s)")
        ax.set_ylabel("Imaginary part (1/s)")
        if any(str(name) for name in values):
            _style.legend(ax, legend, given)
    return ax


def _values(name: Any, model: Any) -> np.ndarray[Any, np.dtype[np.complex128]]:
    """Return the eigenvalues of a LinearModel, or an array of eigenvalues that is given instead of a model."""
    allowed = "it must be a flapwing.LinearModel, or an array of eigenvalues"
    try:
        return np.atleast_1d(np.asarray(getattr(model, "eigenvalues", model), dtype=complex))
    except (TypeError, ValueError):
        raise refused(f"models[{name!r}]" if name else "models", model, allowed) from None
