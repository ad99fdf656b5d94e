#!/usr/bin/env bash
# Writes dist/flap-VERSION.cdx.json and dist/flapwing-VERSION.cdx.json: the crates of the command and of the wheel with versions and
# licences (CycloneDX).
set -euo pipefail
cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.."

tools=${CARGO_TARGET_DIR:-$PWD/target}/sbom-tools
[[ -x $tools/bin/cargo-sbom ]] || cargo install --quiet --locked --root "$tools" cargo-sbom@0.10.0
version=$(sed -n '/^\[workspace.package\]/,/^\[/s/^version = "\(.*\)"$/\1/p' Cargo.toml)
mkdir -p dist
"$tools/bin/cargo-sbom" sbom --cargo-package flap-cli --output-format cyclone_dx_json_1_6 >"dist/flap-$version.cdx.json"
"$tools/bin/cargo-sbom" sbom --cargo-package flap-py --output-format cyclone_dx_json_1_6 >"dist/flapwing-$version.cdx.json"
