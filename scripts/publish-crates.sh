#!/usr/bin/env bash
# Publishes the crates on crates.io, in the order of their dependencies. Crates whose version is there are left out, so the script
# can run again after a failure. Needs a token in CARGO_REGISTRY_TOKEN; `--dry-run` needs none and publishes nothing.
set -euo pipefail
cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.."

version=$(sed -n '/^\[workspace.package\]/,/^\[/s/^version = "\(.*\)"$/\1/p' Cargo.toml)
crates=()
for crate in flap-{sources,core,experiments,sweep,live,cli}; do
    # In another folder, where cargo looks at crates.io and not at this workspace.
    if (cd / && cargo info --quiet --registry crates-io "$crate@$version") >/dev/null 2>&1; then
        printf '%s %s is on crates.io\n' "$crate" "$version"
    else
        crates+=("--package=$crate")
    fi
done
# scripts/check-packages.sh has compiled the packages.
[[ ${#crates[@]} -eq 0 ]] || cargo publish --locked --no-verify "${crates[@]}" "$@"
