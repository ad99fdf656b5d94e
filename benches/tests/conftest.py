"""Fixtures of the tests of benchmarks."""

import os

import pytest


@pytest.fixture(scope="session")
def flap():
    """The path of the command."""
    command = os.environ.get("FLAP")
    if not command:
        pytest.fail("FLAP must name the command `flap`: `just test-benches` builds it and sets FLAP")
    return command
