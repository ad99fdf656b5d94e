#!/usr/bin/env bash
# Installs a wheel with the oldest versions that crates/flap-py/pyproject.toml allows, for Python, NumPy and every extra, and runs
# the tests of the functions that use these libraries:
#
#   scripts/test-oldest.sh WHEEL
#
# Needs the oldest Python of the wheel; PYTHON names another interpreter.
set -euo pipefail
cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.."

[[ $# -eq 1 && -f $1 ]] || { printf 'usage: scripts/test-oldest.sh WHEEL\n' >&2; exit 2; }
floor=$(sed -n 's/^requires-python = ">=\(.*\)"$/\1/p' crates/flap-py/pyproject.toml)
folder=$(mktemp -d)
trap 'rm -rf -- "$folder"' EXIT
"${PYTHON:-python$floor}" -m venv "$folder/tools"
"$folder/tools/bin/python" -m pip install --quiet --disable-pip-version-check uv==0.13.8
"${PYTHON:-python$floor}" -m venv --without-pip "$folder/env"
install() { "$folder/tools/bin/uv" pip install --quiet --python "$folder/env/bin/python" "$@"; }
# Old versions of matplotlib need an old pyparsing.
install --resolution lowest-direct --only-binary :all: -r crates/flap-py/pyproject.toml --all-extras \
    pytest==9.2.0 pillow==10.1.0 pyparsing==3.1.0
install --no-deps "$1"
"$folder/tools/bin/uv" pip freeze --quiet --python "$folder/env/bin/python" |
    grep -E '^(anywidget|distributed|matplotlib|moocore|numpy|pandas|polars|pyarrow|scipy|tqdm|xarray)=='

tests=tests/python
export FLAP=$folder/env/bin/flap PYTHONDONTWRITEBYTECODE=1
# Warnings of old libraries are not errors. The deselected test compares the palette of a picture.
"$folder/env/bin/python" -m pytest --quiet -p no:cacheprovider -o filterwarnings= --disable-warnings \
    --deselect "plot/test_wing_path.py::test_wing_path_is_saved_as_gif" \
    "$tests"/test_{table,fit_results,live,cluster}.py "$tests"/plot/test_{heatmap,pareto,slices,hysteresis,trajectory,wing_path}.py
