"""A picture of CPU time per point and peak memory over the number of points, in the colours of flap's pictures."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from html import escape
from statistics import median
from typing import Any

#: Okabe and Ito's colours, which readers with any colour vision can distinguish.
COLOURS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#56B4E9", "#E69F00")
DASHES = ("", ' stroke-dasharray="6 4"')

WIDTH, HEIGHT = 900, 400
#: The size of the axes of each panel.
PANEL_WIDTH, TOP, BOTTOM = 370, 70, 340

Run = dict[str, Any]


@dataclass(frozen=True)
class Panel:
    """A panel with a quantity over the number of points. The vertical axis begins at zero."""

    left: int
    label: str
    decades: tuple[int, int]
    highest: float

    def x(self, points: float) -> float:
        first, last = self.decades
        return self.left + PANEL_WIDTH * (math.log10(points) - first) / max(1, last - first)

    def y(self, value: float) -> float:
        return BOTTOM - (BOTTOM - TOP) * value / self.highest

    def axes(self) -> Iterator[str]:
        """Yield the grid lines with numbers, and the labels of the axes."""
        for decade in range(self.decades[0], self.decades[1] + 1):
            x = self.x(10.0**decade)
            yield f'<path class="grid" d="M{x:.1f} {TOP}V{BOTTOM}"/>'
            yield (
                f'<text x="{x:.1f}" y="{BOTTOM + 18}" text-anchor="middle">10'
                f'<tspan dy="-5" font-size="9">{decade}</tspan></text>'
            )
        step = even(self.highest / 5)
        for number in range(int(self.highest / step + 1e-9) + 1):
            y = self.y(number * step)
            yield f'<path class="grid" d="M{self.left} {y:.1f}H{self.left + PANEL_WIDTH}"/>'
            yield f'<text x="{self.left - 8}" y="{y + 4:.1f}" text-anchor="end">{number * step:g}</text>'
        yield f'<path class="axis" d="M{self.left} {TOP}V{BOTTOM}H{self.left + PANEL_WIDTH}"/>'
        yield f'<text x="{self.left}" y="{TOP - 12}" font-size="14">{escape(self.label)}</text>'
        yield f'<text x="{self.left + PANEL_WIDTH / 2}" y="{BOTTOM + 42}" text-anchor="middle">points</text>'


def draw(runs: Sequence[Run]) -> str:
    """Return the picture as SVG text."""
    cost = [1e6 * median(run["cpu_s"]) / run["points"] for run in runs]
    memory = [median(run["peak_mib"]) for run in runs]
    exponents = [math.log10(run["points"]) for run in runs]
    decades = (math.floor(min(exponents)), math.ceil(max(exponents)))
    parts = [
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT}"',
        ' font-family="sans-serif" font-size="12">',
        "<style>.grid{stroke:#e4e4e4}.axis{stroke:#444;fill:none}.line{fill:none;stroke-width:2}</style>",
        f'<rect width="{WIDTH}" height="{HEIGHT}" fill="#fff"/>',
    ]
    for left, label, values in ((60, "CPU time per point (µs)", cost), (510, "peak memory of a process (MiB)", memory)):
        panel = Panel(left, label, decades, ceiling(max(values)))
        parts += panel.axes()
        for colour, dash, members in lines(runs):
            places = [(panel.x(runs[member]["points"]), panel.y(values[member])) for member in members]
            path = "L".join(f"{x:.1f} {y:.1f}" for x, y in places)
            parts.append(f'<path class="line" stroke="{colour}"{dash} d="M{path}"/>')
            parts += [f'<circle cx="{x:.1f}" cy="{y:.1f}" r="3" fill="{colour}"/>' for x, y in places]
    parts += legend(runs)
    return "\n".join([*parts, "</svg>"]) + "\n"


def lines(runs: Sequence[Run]) -> Iterator[tuple[str, str, list[int]]]:
    """Yield the colour, the dashes and the runs of each line."""
    for name, colour in ways(runs):
        for rtol, dash in tolerances(runs):
            members = [number for number, run in enumerate(runs) if (run["way"], run["rtol"]) == (name, rtol)]
            if members:
                yield colour, dash, sorted(members, key=lambda member: int(runs[member]["points"]))


def legend(runs: Sequence[Run]) -> Iterator[str]:
    """Yield the legend above the panels: colours stand for the kinds of sweeps, and dashes stand for tolerances."""
    keys = [(name, colour, "") for name, colour in ways(runs)]
    keys += [(f"rtol {tolerance(rtol)}", "#444", dash) for rtol, dash in tolerances(runs)]
    spacing = min(150, (WIDTH - 60) // len(keys))
    for number, (text, colour, dash) in enumerate(keys):
        x = 60 + spacing * number
        yield f'<path class="line" stroke="{colour}"{dash} d="M{x} 24h30"/>'
        yield f'<text x="{x + 38}" y="28">{escape(text)}</text>'


def ways(runs: Sequence[Run]) -> list[tuple[str, str]]:
    return list(zip(dict.fromkeys(run["way"] for run in runs), COLOURS))


def tolerances(runs: Sequence[Run]) -> list[tuple[float, str]]:
    return list(zip(sorted({run["rtol"] for run in runs}), DASHES))


def tolerance(rtol: float) -> str:
    """Return a tolerance as short text, such as ``1e-6``."""
    return f"{rtol:.0e}".replace("e-0", "e-")


def even(value: float) -> float:
    """Return the next larger number that is 1, 2 or 5 times a power of ten."""
    ten = 10.0 ** math.floor(math.log10(value))
    return next(ten * factor for factor in (1, 2, 5, 10) if ten * factor >= value * (1 - 1e-9))


def ceiling(value: float) -> float:
    """Return the end of an axis: a whole number of steps, at or above the value."""
    step = even(value / 5)
    return step * math.ceil(value / step * 1.02)
