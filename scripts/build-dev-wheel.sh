#!/usr/bin/env bash
# Builds the command and the Python wheel for tests and for the manual, and prints the path of the wheel:
#
#   scripts/build-dev-wheel.sh [dev|release]
#
# Needs cargo and python3 with venv. The wheel is in target/wheel, beside the environment that builds it: for the
# interpreter of another environment, cargo would compile the bindings again.
set -euo pipefail
cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.."

profile=${1:-dev}
work=${CARGO_TARGET_DIR:-$PWD/target}/wheel
maturin=$(grep '^maturin==' scripts/release-requirements.txt)
floor=$(sed -n 's/^requires-python = ">=\(.*\)"$/\1/p' crates/flap-py/pyproject.toml)
# The interpreter of an environment can be removed, or older than the wheel allows.
if [[ $maturin != "$(cat -- "$work/made-from" 2>/dev/null)" ]] ||
    ! "$work/env/bin/python" -c "import sys; sys.exit(sys.version_info < (${floor/./, }))" 2>/dev/null; then
    rm -rf -- "$work"
    python3 -m venv "$work/env"
    "$work/env/bin/python" -m pip install --quiet --disable-pip-version-check "$maturin"
    printf '%s\n' "$maturin" >"$work/made-from"
fi

# Selected with the package, the command has the dependencies' features of the wheel, so crates are not compiled twice.
cargo build --quiet --profile "$profile" --locked -p flap-cli -p flap-py --bin flap
rm -f -- "$work"/*.whl
"$work/env/bin/maturin" build --quiet --profile "$profile" --locked --compatibility off \
    --manifest-path crates/flap-py/Cargo.toml --interpreter "$work/env/bin/python" --out "$work" >&2
echo "$work"/*.whl
