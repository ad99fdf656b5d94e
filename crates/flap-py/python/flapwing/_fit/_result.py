"""The result of a fit."""

from __future__ import annotations

import os
from typing import Any, Mapping

import numpy as np

from .. import _arguments
from . import _device, _noise, _predict, _report
from ._solution import Solution
from ._predict import NextMeasurements, Prediction
from ._types import Array


class Fit(Solution):
    """The result of `fit`: estimates, their uncertainty, and how good the model is.

    ``print(fit)`` shows all of it. ``**fit.values`` sets the fitted parameters in other calls.

    Attributes
    ----------
    estimates : dict of str to Estimate
        By parameter: value, standard error, 95 % interval and profile, in SI units.
    correlations : array
        Of the estimates, in their order; nan for parameters that are not known.
    combinations : list of str
        The best and the worst known combination of the parameters.
    indistinct : list of str
        Changes of the parameters that no reading shows, at any values: exact scalings of the model, and parameters that
        have no effect.
    goodness : Goodness
        Chi-square, its probability, and the residuals by data set and measure.
    unsettled : list of Unsettled
        Readings that do not count, because the motion there does not settle.
    held_out : HeldOut or None
        The predictions of readings that were held out.
    effort : Effort
        Starts, points, right-hand sides and time.
    """

    def predict(self, points: Any, measure: str, *, data_set: str | None = None) -> Prediction:
        """A measure at other operating points, with 95 % bands.

        Bands are of the model's value, without the noise of a reading.

        Parameters
        ----------
        points : dict, DataFrame or Grid
            Columns of parameters, as in `Readings`. Those that all data have in common need not be given.
        measure : str
            A measure, also one that was not read.
        data_set : str, optional
            The data set whose own parameters hold, and on whose branch motions are. Default: the parameters of the first
            one, and motions from rest.

        Returns
        -------
        Prediction
            `value`, `error`, `low` and `high`, in the unit of the measure; nan where the motion does not settle.

        Raises
        ------
        ValueError
            Unknown columns, units or measures.
        """
        given = self._points("points", points)
        place, like = 0, None
        if data_set is not None:
            known = [one.name for one in self._sets]
            if data_set not in known:
                raise ValueError(f"there is no data set {data_set!r}\nchoose among {', '.join(known)}")
            place = known.index(data_set)
            like = self._sets[place]
        answer = _predict.answers(self._model, given, measure, self._x, place, like)
        return _predict.predict(self._model, given, measure, answer, self._covariance, self._quantile)

    def next_measurements(
        self, candidates: Any, for_: str | Mapping[str, Any], *, count: int = 5, measures: list[str] | None = None
    ) -> NextMeasurements:
        """The operating points at which readings would shrink the error of a parameter or a prediction most.

        Parameters
        ----------
        candidates : dict, DataFrame or Grid
            Operating points that could be measured, as columns of parameters.
        for_ : str or dict
            A parameter, or a prediction: ``{"measure": "lift_mean_mn", "drive_frequency": 110}``.
        count : int
            Readings wanted. A point may come twice: a repeated reading tells more too.
        measures : list of str, optional
            Measures that could be read. Default: those of the data.

        Returns
        -------
        NextMeasurements
            Points and measures, the best first, with the error that is left after each: for a parameter in its SI unit.

        Raises
        ------
        ValueError
            Unknown names, no points, or none with a settled motion.
        """
        if isinstance(count, bool) or not isinstance(count, (int, np.integer)) or count < 1:
            raise ValueError(f"`count` is {count!r}\nit must be a whole number, 1 or more")
        points = self._points("candidates", candidates)
        target, name, unit = self._target(for_)
        known = {measure: noise for one in self._sets for measure, noise in one.noise.items()}
        noises = {}
        for measure in measures if measures is not None else list(known):
            if measure not in known:
                raise ValueError(
                    f"the data have no readings of `{measure}`, so their error is not known\nchoose among {', '.join(known)}"
                )
            noise = known[measure]
            noises[measure] = (
                noise if np.ndim(noise.size) == 0 else _noise.Noise(noise.kind, float(np.median(noise.size)))
            )
        rows, chosen, errors, now = _predict.next_measurements(
            self._model, points, noises, self._x, self._information, target, int(count), self._guesses
        )
        return NextMeasurements(
            name, unit, now, [{key: values[row] for key, values in points.items()} for row in rows], chosen, errors
        )

    def device(self, path: str | os.PathLike[str], *, data_set: str | None = None, overwrite: bool = False) -> None:
        """Write the design with the fitted parameters, their standard errors and correlations as a device.

        Standard errors, correlations and sources of other parameters, which a device as the design may have, are kept, and so
        is its description.
        ``{"device": "mybee.toml"}`` begins a grid with it, and ``[sample] of = "device"`` draws builds from its errors.

        Parameters
        ----------
        path : str or path
            The file.
        data_set : str, optional
            The data set whose own parameters are written, if data sets do not share all.
        overwrite : bool
            Replace a file that is there.

        Raises
        ------
        FileExistsError
            The file is there, without `overwrite`.
        ValueError
            Data sets have parameters of their own, and `data_set` is not one of them.
        """
        _device.write(self, path, data_set, _arguments.flag("overwrite", overwrite))

    def _target(self, for_: str | Mapping[str, Any]) -> tuple[Array, str, str]:
        """The derivatives of a parameter or a prediction by the coordinates, with its name and unit."""
        space = self._model.space
        if isinstance(for_, str):
            if for_ not in space.labels:
                raise ValueError(
                    f"`{for_}` was not fitted\nchoose among {', '.join(space.labels)}, or give a prediction"
                )
            place = space.labels.index(for_)
            target = np.zeros(len(space))
            target[place] = space.slopes(self._x)[place]
            return target, for_, space.coordinates[place].unit
        if not isinstance(for_, Mapping) or "measure" not in for_:
            raise ValueError(
                '`for_` must name a parameter, or be a prediction: {"measure": "lift_mean_mn", "drive_frequency": 110}'
            )
        measure = str(for_["measure"])
        points = self._points("for_", {name: value for name, value in for_.items() if name != "measure"})
        answer = _predict.answers(self._model, points, measure, self._x)
        if len(answer.values) != 1 or not np.isfinite(answer.values[0]) or answer.gaps[0]:
            raise ValueError(
                f"`{measure}` has no derivatives at this point, or there are several\nchoose another point"
            )
        return answer.slopes[0], measure, self._model.names.unit(measure)

    def _points(self, place: str, given: Any) -> dict[str, Any]:
        """Operating points, with the parameters that all data have in common."""
        points = _predict.points_of(self._model.names, place, given)
        count = len(next(iter(points.values())))
        for name, values in self._model.points.items():
            if name in points:
                continue
            distinct = set(np.asarray(values).tolist())
            if len(distinct) > 1:
                raise ValueError(f"{place} lacks `{name}`, of which the data have {len(distinct)} values\nadd a column")
            value = distinct.pop()
            points[name] = [value] * count if isinstance(value, str) else np.full(count, value)
        for name in self._model.space.parameters:
            if name in points:
                raise ValueError(f"{place} has `{name}`, which was fitted\nleave it out")
        return points

    def __str__(self) -> str:
        return _report.text(self)

    def __repr__(self) -> str:
        told = ", ".join(f"{name}={one.value:.4g}" for name, one in self.estimates.items())
        return f"<flapwing.Fit of {told}>"

    def _repr_html_(self) -> str:
        return _report.html(self)
