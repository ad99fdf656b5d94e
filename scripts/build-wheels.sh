#!/usr/bin/env bash
# Builds what a release publishes for Linux into dist/, for x86_64 or the named processors:
#
#   scripts/build-wheels.sh [x86_64|aarch64]...
#
#   dist/flapwing-VERSION-cp311-abi3-manylinux….whl   the wheel: the Python package, and the command `flap`
#   dist/flap-VERSION-ARCH-linux.tar.gz               the command alone, for machines without Python
#
# Both run on every Linux with glibc 2.17 (2014) or later, and need no compiler there. Needs python3 with venv, cargo, and,
# for another processor, `rustup target add aarch64-unknown-linux-gnu`. The tools are in target/release-tools; pip fetches
# them when scripts/release-requirements.txt changes.
set -euo pipefail
cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.."

die() {
    printf 'build-wheels: %s\n' "$1" >&2
    exit 2
}

glibc=2.17
platform=manylinux_2_17
[[ $# -gt 0 ]] || set -- x86_64
for arch in "$@"; do
    [[ $arch == x86_64 || $arch == aarch64 ]] || die "$arch is no processor to build for: choose x86_64 or aarch64"
done
command -v cargo >/dev/null || die "cargo is not installed: the build needs a Rust toolchain"
if command -v rustup >/dev/null; then
    for arch in "$@"; do
        rustup target list --installed | grep -qx "$arch-unknown-linux-gnu" ||
            die "Rust's library for $arch is not installed: run \`rustup target add $arch-unknown-linux-gnu\`"
    done
fi

target=${CARGO_TARGET_DIR:-$PWD/target}
mkdir -p "$target"
target=$(cd -- "$target" && pwd)
export CARGO_TARGET_DIR=$target
tools=$target/release-tools
requirements=scripts/release-requirements.txt
if ! diff -q "$requirements" "$tools/made-from" >/dev/null 2>&1; then
    python3 -m venv --clear "$tools"
    "$tools/bin/python" -m pip install --quiet --disable-pip-version-check -r "$requirements"
    cp "$requirements" "$tools/made-from"
fi
export PATH="$tools/bin:$PATH"

version=$(sed -n '/^\[workspace.package\]/,/^\[/s/^version = "\(.*\)"$/\1/p' Cargo.toml)
trap 'rm -rf -- "${folder:-}"' EXIT
mkdir -p dist

for arch in "$@"; do
    triple=$arch-unknown-linux-gnu
    printf '\n== The command for %s\n' "$arch"
    cargo zigbuild --release --locked -p flap-cli --target "$triple.$glibc"

    folder=$(mktemp -d)
    package=flap-$version-$arch-linux
    mkdir "$folder/$package"
    cp "$target/$triple/release/flap" README.md CHANGELOG.md LICENSE-APACHE LICENSE-MIT CITATION.cff "$folder/$package"
    # The same files give the same archive.
    tar --sort=name --owner=0 --group=0 --numeric-owner --mtime=@0 -C "$folder" -c "$package" |
        gzip -9 --no-name >"dist/$package.tar.gz"
    rm -rf -- "$folder"

    printf '\n== The wheel for %s\n' "$arch"
    maturin build --release --locked --zig --target "$triple" --compatibility "$platform" \
        --manifest-path crates/flap-py/Cargo.toml --out dist

    wheel=$(echo dist/flapwing-"$version"-*"$platform"_"$arch"*.whl)
    [[ -f $wheel ]] || die "maturin wrote no wheel for $arch to dist"
    told=$(auditwheel show "$wheel" | tr '\n' ' ')
    grep -q "platform tag: \"${platform}_$arch\"" <<<"$told" || die "$wheel needs more than $platform has: $told"
    printf '%s is sound: %s_%s\n' "$wheel" "$platform" "$arch"
done
ls -l dist
