"""The report of a fit as text and as HTML."""

from __future__ import annotations

from collections.abc import Sequence
from html import escape

import numpy as np

from ._assess import DOUBTFUL, POOR, TOO_GOOD
from ._solution import Estimate, Solution
from ._spread import Spread

#: Largest number of unsettled readings, and of outliers, that the report lists.
_LISTED = 5


def text(fit: Solution) -> str:
    """Return the report of a fit as text."""
    lines = [table(*_estimates(fit)), *_remarks(fit), "", *_quality(fit), "", table(*_residuals(fit)), ""]
    if fit.combinations:
        lines += [*fit.combinations]
    if len(fit.estimates) > 1:
        lines += ["correlations:", table(*_correlations(fit))]
    return "\n".join([*lines, *_effort(fit)])


def html(fit: Solution) -> str:
    """Return the report of a fit as HTML, for notebooks."""
    parts = [
        _html_table(*_estimates(fit)),
        _paragraphs(_remarks(fit)),
        _paragraphs(_quality(fit)),
        _html_table(*_residuals(fit)),
    ]
    parts.append(_paragraphs(fit.combinations))
    if len(fit.estimates) > 1:
        parts.append(_html_table(*_correlations(fit)))
    return "".join([*parts, _paragraphs(_effort(fit))])


def _paragraphs(lines: list[str]) -> str:
    return "".join(f"<p>{escape(line)}</p>" for line in lines)


def _html_table(heads: list[str], rows: list[list[str]]) -> str:
    def row(cells: list[str], tag: str) -> str:
        return "<tr>" + "".join(f"<{tag}>{escape(cell)}</{tag}>" for cell in cells) + "</tr>"

    return "<table>" + row(heads, "th") + "".join(row(cells, "td") for cells in rows) + "</table>"


def _estimates(fit: Solution) -> tuple[list[str], list[list[str]]]:
    heads = ["parameter", "unit", "value", "error", "error %", "95 % from", "to", ""]
    rows = []
    for name, one in fit.estimates.items():
        # An estimate at a bound of zero has no meaningful share.
        share = f"{100 * one.error / abs(one.value):.2g}" if one.error < 1e3 * abs(one.value) else "-"
        low = "open" if one.open_below else f"{one.low:.5g}"
        high = "open" if one.open_above else f"{one.high:.5g}"
        rows.append([name, one.unit, f"{one.value:.5g}", f"{one.error:.2g}", share, low, high, _verdict(one)])
    return heads, rows


def _verdict(one: Estimate) -> str:
    if one.open_below or one.open_above:
        both = one.open_below and one.open_above
        side = "" if both else ": no lower limit" if one.open_below else ": no upper limit"
        return f"not fixed by the data{side}"
    if not one.is_known:
        return "not fixed by the data"
    return "at the end of its range" if one.at_bound else ""


def _spread(one: Spread) -> str:
    high = f"{one.high:.2g}" if np.isfinite(one.high) else "open"
    known = "given" if one.is_given else f"95 % from {one.low:.2g} to {high}"
    line = f"{one.parameter} of all robots: mean {one.mean:.5g}, error {one.error:.2g}, spread {one.value:.2g}"
    return f"{line} {one.unit}".rstrip() + f" ({known})"


def _remarks(fit: Solution) -> list[str]:
    lines = [_spread(one) for one in fit.spreads.values()]
    lines += [f"no such data can determine this: {one}" for one in fit.indistinct]
    if fit.unsettled:
        listed = ", ".join(f"{one.data_set} row {one.row} ({one.status})" for one in fit.unsettled[:_LISTED])
        more = f" and {len(fit.unsettled) - _LISTED} more" if len(fit.unsettled) > _LISTED else ""
        count = len(fit.unsettled)
        subject = "1 reading does" if count == 1 else f"{count} readings do"
        lines.append(f"{subject} not count, because the motion does not settle there: {listed}{more}")
    if fit.without_slopes:
        count = fit.without_slopes
        subject, verb = ("1 reading has", "does") if count == 1 else (f"{count} readings have", "do")
        lines.append(f"{subject} no derivatives at the estimate, and {verb} not narrow the errors")
    if not fit.converged:
        lines.append("the search has not converged: give more starts, or narrower bounds")
    return lines


def _quality(fit: Solution) -> list[str]:
    good = fit.goodness
    quality = f"chi-square {good.chi_square:.1f} for {good.freedom} degrees of freedom"
    if not fit.sigma_known:
        lines = [f"{quality}: standard errors are estimated from the residuals, so it does not test the model"]
    elif good.p < POOR:
        lines = [f"{quality}, p = {good.p:.2g}: POOR, the model lacks an effect or the standard errors are too small"]
    elif good.p < DOUBTFUL:
        lines = [
            f"{quality}, p = {good.p:.2g}: doubtful, a correct model has such a value once in {1 / good.p:.0f} fits; "
            "look at the residuals"
        ]
    elif good.p > TOO_GOOD:
        lines = [f"{quality}, p = {good.p:.4f}: the given standard errors are too large"]
    else:
        lines = [f"{quality}, p = {good.p:.2f}: the model agrees with the data"]
    for one in good.structure:
        if one.is_structured:
            lines.append(
                f"residuals of {one.measure} along {one.parameter} are STRUCTURED (p = {one.p:.1g}): "
                "neighbouring residuals are alike, so the model lacks an effect"
            )
    if fit.discrepancy:
        sizes = " and ".join(f"{one.size:.2g} {one.unit} of {one.measure}" for one in fit.discrepancy)
        lines.append(f"model discrepancy: {sizes}, included in errors, intervals and bands")
    if fit.drifting:
        lines.append(
            f"data sets disagree: {fit.drifting} explains the difference best, if each data set has its own value "
            "(FreeParameter(per_set=True))"
        )
    if fit.outliers:
        listed = ", ".join(
            f"{one.data_set} row {one.row} {one.measure} ({one.residual:+.1f})" for one in fit.outliers[:_LISTED]
        )
        more = f" and {len(fit.outliers) - _LISTED} more" if len(fit.outliers) > _LISTED else ""
        lines.append(f"outliers (model minus reading in standard errors): {listed}{more}")
    if fit.held_out is not None:
        rms = ", ".join(f"{value:.3g} ({name})" for name, value in fit.held_out.rms.items()) or "unknown"
        lost = fit.held_out.unsettled
        covered = fit.held_out.covered
        lines.append(
            f"{fit.held_out.count} readings held out: rms error of prediction {rms}; "
            + ("none has a 95 % band" if np.isnan(covered) else f"{100 * covered:.0f} % in their 95 % bands")
            + (f"; no settled motion at {lost} of them, which the rms error leaves out" if lost else "")
        )
    return lines


def _residuals(fit: Solution) -> tuple[list[str], list[list[str]]]:
    heads = ["data set", "measure", "readings", "rms", "largest", "unit"]
    rows = []
    for one in fit.goodness.residuals:
        if not one.count:
            continue
        largest = float(np.nanmax(np.abs(one.values))) if np.isfinite(one.values).any() else np.nan
        rows.append([one.data_set, one.measure, str(one.count), f"{one.rms:.3g}", f"{largest:.3g}", one.unit])
    return heads, rows


def _correlations(fit: Solution) -> tuple[list[str], list[list[str]]]:
    names = list(fit.estimates)
    rows = [[name, *(f"{value:+.2f}" for value in row)] for name, row in zip(names, fit.correlations)]
    return ["", *(str(number + 1) for number in range(len(names)))], rows


def _effort(fit: Solution) -> list[str]:
    one = fit.effort
    lines = [
        f"{one.agreed} of {one.starts} starts ended at this fit; "
        f"{one.points:,} points with {one.rhs_evals:.3g} right-hand sides in {one.seconds:.1f} s"
    ]
    if one.agreed <= 1 < one.starts:
        lines.append(f"few starts ended at this fit, so a better fit may exist: fit again with starts={4 * one.starts}")
    return lines


def table(heads: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    """Return a text that shows a table with aligned columns."""
    widths = [max(len(line[place]) for line in [heads, *rows]) for place in range(len(heads))]
    return "\n".join(
        "  ".join(cell.ljust(width) for cell, width in zip(line, widths)).rstrip() for line in [heads, *rows]
    )
