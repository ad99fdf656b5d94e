#!/usr/bin/env bash
# Installs a wheel into a new virtual environment as a user without compilers does, and uses it there: the package and
# the command.
#
#   scripts/test-wheel.sh dist/flapwing-….whl [argument of pip]...
#   scripts/test-wheel.sh dist/flapwing-VERSION.tar.gz
#
# The second line tests the source distribution: pip builds the package, which needs cargo and a C compiler.
#
# PYTHON names the interpreter [default: python3]. pip fetches numpy, unless its arguments say otherwise, such as `--no-index
# --find-links FOLDER`.
set -euo pipefail

die() {
    printf 'test-wheel: %s\n' "$1" >&2
    exit 1
}

[[ $# -ge 1 && -f $1 ]] || { printf 'usage: scripts/test-wheel.sh WHEEL [argument of pip]...\n' >&2; exit 2; }
wheel=$(cd -- "$(dirname -- "$1")" && pwd)/$(basename -- "$1")
shift
room=$(mktemp -d)
trap 'rm -rf -- "$room"' EXIT
python=${PYTHON:-$(command -v python3 || command -v python)}
"$python" -m venv "$room/env"
folder=$room/env/bin
[[ -d $folder ]] || folder=$room/env/Scripts # on Windows
"$folder/python" -m pip install --quiet --disable-pip-version-check "$@" "$wheel"

# Nothing but the environment is on the path: neither cargo nor a C compiler, nor an older flap.
clean() { (cd "$room" && env -i HOME="$room" ${SYSTEMROOT:+SYSTEMROOT="$SYSTEMROOT"} PATH="$folder" "$folder/$1" "${@:2}"); }

clean python - <<'PYTHON' || die "the package does not work"
import shutil

import flapwing

assert not any(map(shutil.which, ("cargo", "rustc", "cc", "gcc", "clang")))
rows = flapwing.sweep({"preset": "ozaki2018-large", "axes": {"drive_voltage_pp": {"from": 60, "to": 120, "n": 4}}})
assert rows.counts == {"periodic": 4}, rows.counts
print(f"flapwing {flapwing.__version__}: {len(rows)} rows, lift {rows['lift_mean_mn'].round(3)} mN")
PYTHON

printf 'preset = "ozaki2018-large"\n[axes]\ndrive_voltage_pp = { from = 60, to = 120, n = 4 }\n' >"$room/grid.toml"
clean flap --version
clean flap sweep --grid grid.toml --out rows.csv || die "the command does not work"
[[ $(grep -c ',periodic,' "$room/rows.csv") -eq 4 ]] || die "the command's rows are not those of a sound sweep"
clean python - <<'PYTHON' || die "the package and the command give different rows"
import flapwing

table = flapwing.sweep("grid.toml", out="again.csv")
assert open("again.csv", "rb").read() == open("rows.csv", "rb").read()
print("the package and the command give the same bytes")
PYTHON
