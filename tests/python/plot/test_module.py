"""`flapwing.plot` as a module: its imports and docstrings."""

import importlib.metadata
import subprocess
import sys
import textwrap

import pytest
from flapwing import plot


def test_importing_flapwing_does_not_import_matplotlib():
    code = "import sys, flapwing; sys.exit('matplotlib' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0


def test_without_matplotlib_the_error_says_what_to_install():
    required = importlib.metadata.requires("flapwing")
    (matplotlib,) = [line.split(";")[0].strip() for line in required if line.startswith("matplotlib")]
    code = textwrap.dedent(f"""
        import sys
        sys.modules["matplotlib"] = None
        try:
            import flapwing.plot
        except ImportError as error:
            assert "[plot]" in str(error) and "{matplotlib}" in str(error), error
        else:
            sys.exit("imported")
    """)
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0


@pytest.mark.parametrize(
    "function",
    [plot.heatmap, plot.histogram, plot.hysteresis, plot.pareto, plot.response_panels, plot.scatter],
)
def test_help_names_the_function_that_explains_slices(function):
    assert (
        "\n    where, **slices\n        Values of columns that select rows, as in `flapwing.plot.response`."
        in function.__doc__
    )
    assert "\n    where, **slices\n        Values of columns, which select the rows to draw" in plot.response.__doc__
