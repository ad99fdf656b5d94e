#!/usr/bin/env bash
# Tests a wheel and an archive for musl in a container with Alpine Linux: `scripts/test-musl.sh WHEEL ARCHIVE`. Needs docker.
set -euo pipefail
cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.."

[[ $# -eq 2 && -f $1 && -f $2 ]] || { echo "usage: scripts/test-musl.sh WHEEL ARCHIVE, in dist/" >&2; exit 2; }
# shellcheck disable=SC2016 # the shell in the container expands
docker run --rm --volume "$PWD:/flap:ro" --workdir /flap python:3.13-alpine sh -c \
    'apk add --quiet bash && ./scripts/test-wheel.sh "$1" && ./scripts/test-archive.sh "$2"' sh "$1" "$2"
