#!/usr/bin/env bash
# Builds the files of a release into dist/, for x86_64-unknown-linux-gnu or the named targets of Rust:
#
#   scripts/build-wheels.sh [TARGET]...
#
#   dist/flapwing-VERSION-cp311-abi3-….whl   the wheel: the Python package, and the command `flap`
#   dist/flap-VERSION-TARGET.tar.gz          the command alone, for machines without Python; .zip for Windows
#
# TARGET is {x86_64,aarch64}-unknown-linux-{gnu,musl}, {x86_64,aarch64}-apple-darwin or x86_64-pc-windows-msvc. The files for
# glibc run on every Linux with glibc 2.17 (2014) or later. Files for Linux are built on any Linux; files for macOS and
# Windows need that system. Needs python3 with venv, cargo and, for another target, `rustup target add TARGET`. The tools are
# in target/release-tools; pip fetches them when scripts/release-requirements.txt changes.
set -euo pipefail
cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.."

die() {
    printf 'build-wheels: %s\n' "$1" >&2
    exit 2
}

glibc=2.17
[[ $# -gt 0 ]] || set -- x86_64-unknown-linux-gnu
for triple in "$@"; do
    case $triple in
        x86_64-unknown-linux-gnu | aarch64-unknown-linux-gnu | x86_64-unknown-linux-musl | aarch64-unknown-linux-musl) system=Linux ;;
        x86_64-apple-darwin | aarch64-apple-darwin) system=Darwin ;;
        x86_64-pc-windows-msvc) system=MINGW ;;
        *) die "$triple is not a target of releases: the head of this script lists the targets" ;;
    esac
    [[ $(uname -s) == "$system"* ]] || die "$triple is built on $system, and this system is $(uname -s)"
done
command -v cargo >/dev/null || die "cargo is not installed: the build needs a Rust toolchain"
if command -v rustup >/dev/null; then
    for triple in "$@"; do
        rustup target list --installed | grep -qx "$triple" ||
            die "Rust's library for $triple is not installed: run \`rustup target add $triple\`"
    done
fi

python=$(command -v python3 || command -v python) || die "python3 is not installed"
target=${CARGO_TARGET_DIR:-$PWD/target}
mkdir -p "$target"
target=$(cd -- "$target" && pwd)
export CARGO_TARGET_DIR=$target
tools=$target/release-tools
export PATH="$tools/bin:$tools/Scripts:$PATH" # Scripts is the folder on Windows
requirements=scripts/release-requirements.txt
if ! diff -q "$requirements" "$tools/made-from" >/dev/null 2>&1; then
    "$python" -m venv --clear "$tools"
    hash -r
    python -m pip install --quiet --disable-pip-version-check -r "$requirements"
    cp "$requirements" "$tools/made-from"
fi

command -v cargo-bundle-licenses >/dev/null || cargo install --quiet --locked --root "$tools" cargo-bundle-licenses@5.0.0

version=$(sed -n '/^\[workspace.package\]/,/^\[/s/^version = "\(.*\)"$/\1/p' Cargo.toml)
trap 'rm -rf -- "${folder:-}" "${licences:-}"' EXIT
mkdir -p dist

# The licences of the crates in the command and in the wheel. maturin adds files named LICENSE to wheels.
licences=crates/flap-py/LICENSE-THIRD-PARTY.yml
(cd crates/flap-py && cargo bundle-licenses --format yaml --output "${licences##*/}")

# macOS 11 is the oldest that runs on both kinds of processors.
export MACOSX_DEPLOYMENT_TARGET=11.0
for triple in "$@"; do
    arch=${triple%%-*} zig=() suffix=""
    case $triple in
        *-gnu) cargo=(zigbuild --target "$triple.$glibc") zig=(--zig --compatibility manylinux_2_17) tag=manylinux_2_17_$arch ;;
        *-musl) cargo=(zigbuild --target "$triple") zig=(--zig --compatibility musllinux_1_2) tag=musllinux_1_2_$arch ;;
        aarch64-apple-darwin) cargo=(build --target "$triple") tag=macosx_11_0_arm64 ;;
        x86_64-apple-darwin) cargo=(build --target "$triple") tag=macosx_11_0_x86_64 ;;
        *-msvc)
            cargo=(build --target "$triple") tag=win_amd64 suffix=.exe
            # Without Microsoft's redistributable libraries.
            export RUSTFLAGS="-C target-feature=+crt-static"
            ;;
    esac
    printf '\n== The command for %s\n' "$triple"
    cargo "${cargo[@]}" --release --locked -p flap-cli

    folder=$(mktemp -d)
    package=flap-$version-$triple
    mkdir "$folder/$package"
    cp "$target/$triple/release/flap$suffix" README.md CHANGELOG.md LICENSE-APACHE LICENSE-MIT "$licences" CITATION.cff "$folder/$package"
    python scripts/archive.py "$folder/$package" dist
    rm -rf -- "$folder"

    printf '\n== The wheel for %s\n' "$triple"
    maturin build --release --locked "${zig[@]+"${zig[@]}"}" --target "$triple" --manifest-path crates/flap-py/Cargo.toml --out dist

    wheel=$(echo dist/flapwing-"$version"-*"$tag"*.whl)
    [[ -f $wheel ]] || die "maturin wrote no wheel for $tag to dist"
    grep -q "/${licences##*/}" <<<"$(python -m zipfile --list "$wheel")" || die "$wheel lacks the licences of its crates"
    if [[ $triple == *-linux-* ]]; then
        told=$(auditwheel show "$wheel" | tr '\n' ' ')
        grep -q "platform tag: \"$tag\"" <<<"$told" || die "$wheel needs more than $tag has: $told"
        printf '%s is sound: %s\n' "$wheel" "$tag"
    fi
done
ls -l dist
