#!/usr/bin/env bash
# Unpacks an archive of the command, as a user without Python and compilers does, and runs it once.
#
#   scripts/test-archive.sh dist/flap-VERSION-TARGET.tar.gz    (or .zip)
set -euo pipefail

die() {
    printf 'test-archive: %s\n' "$1" >&2
    exit 1
}

[[ $# -eq 1 && -f $1 ]] || { printf 'usage: scripts/test-archive.sh ARCHIVE\n' >&2; exit 2; }
room=$(mktemp -d)
trap 'rm -rf -- "$room"' EXIT
case $1 in
    *.zip) unzip -q "$1" -d "$room" && command=$(echo "$room"/flap-*/flap.exe) ;;
    *) tar -xzf "$1" -C "$room" && command=$(echo "$room"/flap-*/flap) ;;
esac
[[ -x $command ]] || die "$1 has no command flap"

# Nothing is on the path.
clean() { (cd "$room" && env -i HOME="$room" ${SYSTEMROOT:+SYSTEMROOT="$SYSTEMROOT"} PATH= "$command" "$@"); }
printf 'preset = "ozaki2018-large"\n[axes]\ndrive_voltage_pp = { from = 60, to = 120, n = 4 }\n' >"$room/grid.toml"
clean --version
clean sweep grid.toml --out rows.csv || die "the command does not work"
[[ $(grep -c ',periodic,' "$room/rows.csv") -eq 4 ]] || die "its rows are not those of a sound sweep"
