"""Fixtures for the tests of the benchmarks."""

import os
import subprocess

import pytest


@pytest.fixture(scope="session")
def flap():
    """Return a function that runs the command `flap`."""
    command = os.environ.get("FLAP")
    if not command:
        pytest.fail("FLAP must name the command `flap`: `just test-benches` builds it and sets FLAP")

    def run(*arguments):
        return subprocess.run([command, *map(os.fspath, arguments)], capture_output=True, text=True, check=True)

    return run
