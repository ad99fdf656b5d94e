#!/usr/bin/env bash
# Builds the command for Windows on x86-64, runs it under Wine, and compares its rows with the rows of this machine.
# Needs, on Debian and Ubuntu:
#
#   apt-get install wine wine64 gcc-mingw-w64-x86-64 python3
#   rustup target add x86_64-pc-windows-gnu
#
# FLAP and FLAP_WINDOWS name commands that are built already.
set -euo pipefail
cd "$(dirname "$0")/.."

die() {
    printf 'test-windows: %s\n' "$1" >&2
    exit 1
}

target=x86_64-pc-windows-gnu
built=${CARGO_TARGET_DIR:-target}
[[ -n ${FLAP:-} ]] || cargo build --quiet --locked -p flap-cli
[[ -n ${FLAP_WINDOWS:-} ]] || cargo build --quiet --locked -p flap-cli --target "$target"
linux=$(realpath "${FLAP:-$built/debug/flap}")
windows=$(realpath "${FLAP_WINDOWS:-$built/$target/debug/flap.exe}")
grid=examples/ozaki_large.toml

room=$(mktemp -d)
export WINEPREFIX=$room/wine WINEDEBUG=-all WINEDLLOVERRIDES="mscoree,mshtml="
process=
# shellcheck disable=SC2317 # called by trap
clean_up() {
    [[ -z $process ]] || kill -KILL "$process" 2>/dev/null || true
    wineserver -k || true
    rm -rf -- "$room"
}
trap clean_up EXIT
mkdir "$room/files" "$room/bin"
cp "$windows" "$room/bin/flap.exe"
windows=$room/bin/flap.exe
# The standard library takes random numbers from a library that Wine contains from version 9 on.
cat >"$room/random.c" <<'C'
#include <windows.h>
BOOLEAN NTAPI SystemFunction036(PVOID, ULONG);
__declspec(dllexport) BOOL WINAPI ProcessPrng(PBYTE data, SIZE_T size) { return SystemFunction036(data, size); }
C
[[ $(wine --version) != wine-[1-8].* ]] ||
    x86_64-w64-mingw32-gcc -shared -o "$room/bin/bcryptprimitives.dll" "$room/random.c" -ladvapi32
cp "$grid" "$room/files/grid.toml"
cd "$room/files"
wine "$windows" --version || die "the command does not start"

# A process of Wine is a process of this machine, so signals reach it. Wine turns SIGINT into Ctrl-C.
start() {
    wine "$windows" "$@" >out 2>err &
    process=$!
}
stop() { # stop SIGNAL : `ended` becomes the exit code
    ended=0
    kill "-$1" "$process"
    wait "$process" 2>/dev/null || ended=$?
    process=
}
wait_until() { # wait_until WORDS COMMAND... : at most 60 s
    local what=$1
    shift
    for _ in {1..1200}; do
        if "$@"; then return; fi
        kill -0 "$process" 2>/dev/null || die "$what: the command has ended: $(cat err)"
        sleep 0.05
    done
    die "$what: not within 60 s"
}
has_checkpoints() { [[ -f $1.journal && $(wc -l <"$1.journal") -gt 3 ]]; }
has_address() { [[ -s out ]]; }
only() { # only FILE... : the results and files beside them
    local found
    found=$(echo "$1"*)
    [[ $found == "$*" ]] || die "files: $found, expected: $*"
}

# Rows in each format.
for ending in csv csv.zst parquet; do
    "$linux" sweep --quiet grid.toml --out "linux.$ending"
    wine "$windows" sweep --quiet grid.toml --out "rows.$ending" || die "sweep into $ending: exit code $?"
    cmp "linux.$ending" "rows.$ending" || die "the rows in rows.$ending are not those of Linux"
    only "rows.$ending" "rows.$ending.meta.toml"
done
echo "csv, csv.zst, parquet: the same bytes as on Linux, $(($(wc -l <rows.csv) - 1)) rows"

# A grid file with the line ends of Windows.
sed 's/$/\r/' grid.toml >lines.toml
wine "$windows" sweep --quiet lines.toml --out lines.csv || die "sweep of a file with CRLF: exit code $?"
cmp rows.csv lines.csv || die "the rows of a file with CRLF differ"

# A sweep that takes some seconds.
printf '%s\n' 'preset = "ozaki2018-large"' '[axes]' 'drive_voltage_pp = { from = 40, to = 100, n = 60 }' \
    'drive_frequency = { from = 95, to = 122, n = 50 }' 'hinge_stiffness = { from = 60e-6, to = 160e-6, n = 10 }' >long.toml

# Sweeps that are killed, or stopped by Ctrl-C, and resumed.
for ending in csv csv.zst parquet; do
    wine "$windows" sweep --quiet long.toml --out "long.$ending" || die "sweep into long.$ending: exit code $?"
    for signal in KILL INT; do
        out=again.$ending
        rm -f again.*
        start sweep long.toml --out "$out" --checkpoint "20 ms" --threads 1
        wait_until "checkpoints in $out.journal" has_checkpoints "$out"
        if [[ $signal == KILL ]]; then
            # The lock keeps other runs away while the sweep runs, but not after its end.
            second=0
            wine "$windows" sweep long.toml --out "$out" 2>second || second=$?
            [[ $second -eq 3 ]] || die "a second sweep into $out: exit code $second: $(cat second)"
            grep -q "another run is writing to $out" second || die "a second sweep into $out: $(cat second)"
        fi
        stop "$signal"
        [[ $signal == KILL || $ended -eq 130 ]] || die "Ctrl-C in a sweep into $out: exit code $ended: $(cat err)"
        [[ -f $out.journal ]] || die "SIG$signal came after the end of the sweep"
        wine "$windows" results resume "$out" --threads 1 2>err || die "resume $out: exit code $?: $(cat err)"
        cmp "long.$ending" "$out" || die "the rows of a resumed sweep differ in $out"
        only "$out" "$out.meta.toml"
    done
done
echo "killed and stopped sweeps: resumed to the same bytes"

# New results replace earlier ones, and a folder has separators of Windows.
mkdir folder
printf 'preset = "jafferis2016"\n[axes]\ndrive_voltage_pp = { from = 100, to = 150, n = 6 }\n' >other.toml
"$linux" sweep --quiet other.toml --out other.csv
cp rows.csv rows.csv.meta.toml folder
wine "$windows" sweep --quiet other.toml --out 'folder\rows.csv' --restart || die "--restart: exit code $?"
cmp other.csv folder/rows.csv || die "the rows of --restart differ"
wine "$windows" results convert 'folder\rows.csv' 'folder\rows.parquet' || die "convert: exit code $?"
wine "$windows" results convert rows.csv 'folder\rows.parquet' --force || die "convert --force: exit code $?"
wine "$windows" results verify 'folder\rows.csv' 'folder\rows.parquet' rows.csv || die "verify: exit code $?"
[[ $(cd folder && echo *) == "rows.csv rows.csv.meta.toml rows.parquet rows.parquet.meta.toml" ]] ||
    die "files in the folder: $(echo folder/*)"
echo "earlier results: replaced"

"$linux" run ozaki2018-large >run.linux
wine "$windows" run ozaki2018-large | tr -d '\r' >run.windows
diff run.linux run.windows || die "flap run prints other numbers"
wine "$windows" plot other.csv --x drive_voltage_pp --y lift_mean_mn --out picture.png || die "plot: exit code $?"
"$linux" plot other.csv --x drive_voltage_pp --y lift_mean_mn --out linux.png
cmp linux.png picture.png || die "the picture is not that of Linux"
echo "run, plot: the same bytes as on Linux"

start live ozaki2018-large --no-open
wait_until "the address of flap live" has_address
python3 - "$(tr -d '\r' <out)" <<'PYTHON' || die "flap live does not answer"
import json
import sys
import urllib.request

address, token = sys.argv[1].split("/?token=")
page = urllib.request.urlopen(sys.argv[1], timeout=60).read().decode()
assert 'id="data"' in page
family = {
    "x": {"name": "drive_frequency", "from": 95.0, "to": 119.0, "n": 5},
}
headers = {"X-Flap-Token": token, "Content-Type": "application/json"}
request = urllib.request.Request(f"{address}/api/family", json.dumps(family).encode(), headers)
rows = json.load(urllib.request.urlopen(request, timeout=60))["rows"]
assert len(rows) == 5, rows
print(f"live: a page of {len(page)} characters, and {len(rows)} rows")
PYTHON
stop INT
[[ $ended -eq 0 ]] || die "Ctrl-C does not stop flap live: $(cat err)"
