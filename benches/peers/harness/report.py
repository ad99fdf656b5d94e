"""The results of the comparison, as a table and as JSON."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import asdict, dataclass
from statistics import median
from typing import Any

from .compare import Deviation
from .measure import Timing

#: Limit of a peer's integration error, as a multiple of the base's integration error. Above the limit, the work of the
#: peer is not comparable.
OUT_OF_LINE = 10.0


@dataclass(frozen=True)
class Row:
    """The line of a peer in the report."""

    timing: Timing
    #: Speed of the peer divided by the speed of the base, for each round.
    ratios: list[float]
    #: Deviation from the true values.
    deviation: Deviation | None
    #: Deviation from an exact integration that is measured from the same samples.
    integration: Deviation | None

    def remarks(self, base: Deviation | None, of: int) -> list[str]:
        """Return the remarks on the peer."""
        remarks = []
        if not self.timing.peer.adaptive:
            remarks.append("fixed step without error control")
        if self.timing.points < of:
            remarks.append(f"{self.timing.points} of {of} points, because the solver is slow")
        if self.integration is not None:
            if self.integration.missing:
                remarks.append(f"points without a result: {self.integration.missing}")
            if base is not None and self.integration.median > OUT_OF_LINE * base.median:
                remarks.append(f"OUT OF LINE: {self.integration.median / base.median:.0f} times the base's error")
        return remarks


HEADINGS = [
    ["", "points per CPU-second", "ratio to base", "rhs per", "periods", "deviation", "of the integration", ""],
    ["peer", "median (range)", "median (range)", "point", "per point", "median, max", "median, max", "remarks"],
]


def table(rows: Sequence[Row], base: Deviation | None, of: int) -> str:
    """Return the table as text, with the fastest peer first."""
    lines = [*HEADINGS]
    for row in sorted(rows, key=lambda row: -median(row.timing.speeds)):
        rhs, periods = row.timing.rhs_per_point, row.timing.periods_per_point
        lines.append(
            [
                row.timing.peer.name,
                spread(row.timing.speeds),
                spread(row.ratios),
                "–" if rhs is None else f"{rhs:,.0f}",
                "–" if periods is None else f"{periods:.1f}",
                errors(row.deviation),
                errors(row.integration),
                "; ".join(row.remarks(base, of)),
            ]
        )
    widths = [max(len(line[column]) for line in lines) for column in range(len(lines[0]))]
    return "\n".join("  ".join(map(str.ljust, line, widths)).rstrip() for line in lines)


def spread(values: Sequence[float]) -> str:
    """Return the median, the smallest and the largest value as text."""
    if not values:
        return "–"
    return f"{number(median(values))} ({number(min(values))} – {number(max(values))})"


def number(value: float) -> str:
    """Return a number as text with three digits, or with all digits before the decimal point."""
    return f"{value:,.0f}" if value >= 100.0 else f"{value:.3g}"


def errors(found: Deviation | None) -> str:
    return "–" if found is None else f"{found.median:.1e}, {found.largest:.1e}"


def record(row: Row, base: Deviation | None, of: int) -> dict[str, Any]:
    """Return the line of a peer as entries for a JSON file."""
    return {
        "name": row.timing.peer.name,
        "what": row.timing.peer.what,
        "adaptive": row.timing.peer.adaptive,
        "points": row.timing.points,
        "points_per_cpu_second": summary(row.timing.speeds),
        "ratio_to_base": summary(row.ratios),
        "rhs_per_point": row.timing.rhs_per_point,
        "periods_per_point": row.timing.periods_per_point,
        "deviation": row.deviation and asdict(row.deviation),
        "integration_deviation": row.integration and asdict(row.integration),
        "remarks": row.remarks(base, of),
    }


def summary(values: Iterable[float]) -> dict[str, Any] | None:
    """Return the values of all rounds, and the numbers of the table."""
    rounds = list(values)
    return {"median": median(rounds), "min": min(rounds), "max": max(rounds), "rounds": rounds} if rounds else None
