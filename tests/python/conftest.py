"""What the tests share."""

import os
import subprocess
from pathlib import Path

import pytest

#: A grid with an axis of options, derived values, conditions, own measures, and points that fail in several ways.
GRID = """\
preset = "ozaki2018-large"

[params]
air_density = 1.2

[axes]
drive_voltage_pp = ["50 V", "80 V"]
lift_sign = ["corrected", "printed"]
drive_frequency = { from = "95 Hz", to = "125 Hz", n = 7 }

[derived]
hinge_stiffness = "preset.hinge_stiffness * (124 - drive_frequency) / 14"

[where]
not_hundred = "drive_frequency != 100"

[measure]
lift_per_volt = "lift_mean_mn / drive_voltage_pp"
strong = "lift_mean_mn > 2"

[solver]
newton = false
max_cycles = 24
"""


@pytest.fixture(scope="session")
def flap():
    """Runs the command."""
    command = os.environ.get("FLAP")
    if not command:
        pytest.fail("FLAP must name the command `flap`: scripts/test-python.sh builds it and says where it is")

    def run(*arguments, code=0):
        ended = subprocess.run([command, *map(os.fspath, arguments)], capture_output=True, text=True, check=False)
        assert ended.returncode == code, ended.stderr
        return ended

    return run


@pytest.fixture
def grid(tmp_path: Path) -> Path:
    """A grid file."""
    path = tmp_path / "grid.toml"
    path.write_text(GRID, encoding="utf-8")
    return path
