#!/usr/bin/env bash
# Builds flap for aarch64 and runs it in an emulator: the tests of elementary functions and lanes, and a sweep of each
# model, whose rows must be those of this machine to the last bit. Needs, on Debian and Ubuntu:
#
#   apt-get install qemu-user gcc-aarch64-linux-gnu libc6-dev-arm64-cross
#   rustup target add aarch64-unknown-linux-gnu
#
# This machine must fuse multiplication and addition, as every aarch64 does: x86-64 with AVX2.
set -euo pipefail
cd "$(dirname "$0")/.."

target=aarch64-unknown-linux-gnu
export CARGO_TARGET_AARCH64_UNKNOWN_LINUX_GNU_LINKER=aarch64-linux-gnu-gcc
export CARGO_TARGET_AARCH64_UNKNOWN_LINUX_GNU_RUNNER="qemu-aarch64 -L /usr/aarch64-linux-gnu"

cargo test --locked -p flap-core --target "$target" --test core -- elementary:: ensemble:: lanes::

out=$(mktemp -d)
trap 'rm -rf "$out"' EXIT
# Pictures and Parquet have nothing to do with processors.
flap=(cargo run --quiet --locked -p flap-cli --no-default-features)
for preset in jafferis2016 ozaki2018-large arabagi2013-75hz; do
    cat >"$out/$preset.toml" <<GRID
preset = "$preset"
[axes]
drive_voltage_pp = { from = 100, to = 150, n = 6 }
GRID
    "${flap[@]}" -- sweep --grid "$out/$preset.toml" --out "$out/here.csv" --restart
    "${flap[@]}" --target "$target" -- sweep --grid "$out/$preset.toml" --out "$out/there.csv" --restart
    cmp "$out/here.csv" "$out/there.csv"
    echo "$preset: the same bytes on $(grep ^instructions "$out/here.csv.meta.toml") and $(grep ^instructions "$out/there.csv.meta.toml")"
done
