"""Fixtures of the tests."""

import os
import subprocess
from pathlib import Path

import pytest
from grids import GRID


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
