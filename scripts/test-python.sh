#!/usr/bin/env bash
# Builds the Python wheel, installs it into a virtual environment of its own, and tests it:
#
#   scripts/test-python.sh [--release] [argument of pytest]...
#
# With arguments of pytest, the tests in tests/browser and benches/tests do not run.
#
# Cargo's dev profile is used, whose compiled dependencies `cargo test` shares; with --release, the profile of
# published wheels. The environment is kept in target/python; it is made anew when tests/python/requirements.txt
# or the interpreter changes, and only then does pip fetch anything.
#
# The interpreter is that of the oldest Python that the wheel claims to serve, where there is one, else python3. PYTHON
# names another.
set -euo pipefail

die() {
    printf 'test-python: %s\n' "$1" >&2
    exit 2
}

# Cargo will run in another directory, where a relative path would mean something else.
if [[ -n ${CARGO_TARGET_DIR-} ]]; then
    mkdir -p -- "$CARGO_TARGET_DIR"
    CARGO_TARGET_DIR=$(cd -- "$CARGO_TARGET_DIR" && pwd)
    export CARGO_TARGET_DIR
fi
cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.."

profile=dev
if [[ ${1-} == --release ]]; then
    profile=release
    shift
fi

floor=$(sed -n 's/^requires-python = ">=\(.*\)"$/\1/p' crates/flap-py/pyproject.toml)
python=${PYTHON:-python$floor}
[[ -n ${PYTHON-} ]] || "$python" -c 'import ensurepip, venv' 2>/dev/null || python=python3
command -v "$python" >/dev/null || die "$python is not installed: Python $floor or later is needed"
version=$("$python" -c 'import sys; print(sys.version)') || die "$python does not run"
"$python" -c "import sys; sys.exit(sys.version_info < (${floor/./, }))" ||
    die "$python is ${version%% *}: the tests need Python $floor or later"
printf 'Testing with Python %s; the oldest that the wheel serves is %s.\n' "${version%% *}" "$floor"
"$python" -c 'import ensurepip, venv' 2>/dev/null ||
    die "$python lacks its venv module: on Debian and Ubuntu, install python3-venv"
command -v cargo >/dev/null || die "cargo is not installed: building the wheel needs a Rust toolchain"

work=${CARGO_TARGET_DIR:-$PWD/target}/python
requirements=tests/python/requirements.txt
made_from=$work/made-from
if ! diff -q - "$made_from" >/dev/null 2>&1 < <(printf '%s\n' "$work" "$version"; cat "$requirements"); then
    rm -f -- "$made_from"
    "$python" -m venv --clear "$work"
    "$work/bin/python" -m pip install --quiet --disable-pip-version-check -r "$requirements"
    # For the test that installs the wheel into a new environment.
    "$work/bin/python" -m pip download --quiet --disable-pip-version-check --no-deps --dest "$work/packages" \
        "$(grep '^numpy==' "$requirements")"
    { printf '%s\n' "$work" "$version"; cat "$requirements"; } >"$made_from"
fi
export PATH="$work/bin:$PATH"

# Format and lints, by ruff.toml. `ruff format` and `ruff check --fix` mend most of what they name.
ruff format --quiet --check .
ruff check --quiet .

FLAPWING_WHEEL=$(./scripts/build-dev-wheel.sh "$profile")
export FLAPWING_WHEEL
# Rows are compared with those of the command.
folder=$profile
[[ $profile == dev ]] && folder=debug
export FLAP=${CARGO_TARGET_DIR:-$PWD/target}/$folder/flap
export FLAPWING_PACKAGES=$work/packages
python -m pip install --quiet --disable-pip-version-check --no-index --no-deps --force-reinstall "$FLAPWING_WHEEL"

export MYPY_CACHE_DIR=$work/mypy-cache
python -m mypy --config-file tests/python/mypy.ini crates/flap-py/python/flapwing
python -m mypy --config-file tests/python/mypy.ini benches/peers/harness
python -m mypy --config-file tests/python/mypy.ini benches/growth/scaling
python -m mypy --config-file tests/python/mypy.ini tests/data/generate/reference
python -m mypy.stubtest flapwing._flapwing --mypy-config-file tests/python/mypy.ini

export PYTHONDONTWRITEBYTECODE=1
# Two processes, because many tests use several cores themselves. The tests of a file share its fixtures.
python -m pytest --quiet -n 2 --dist loadfile -o "cache_dir=$work/pytest-cache" tests/python "$@"
[[ $# -eq 0 ]] || exit 0
# Pages of results and the live page, in chromium: skipped where that is not installed.
python -m pytest --quiet -o "cache_dir=$work/pytest-cache" tests/browser
# The programs of the comparison with other solvers.
python -m pytest --quiet -o "cache_dir=$work/pytest-cache" -c tests/python/pytest.ini --rootdir . benches/tests/test_{peers,growth}.py
