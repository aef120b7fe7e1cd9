#!/usr/bin/env bash
# Configures a preset and builds it: scripts/build.sh PRESET [TARGET...]. ccache is used when it is there.
set -euo pipefail
cd "$(dirname "$0")/.."
preset=$1
shift

options=()
if command -v ccache >/dev/null; then options+=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache); fi
mkdir -p "build/$preset"
log=build/$preset/configure.log
cmake --preset "$preset" "${options[@]}" >"$log" 2>&1 || {
    cat "$log" >&2
    echo "build: configuring '$preset' failed; the message of cmake is above" >&2
    exit 1
}
targets=()
for target in "$@"; do targets+=(--target "$target"); done
cmake --build "build/$preset" "${targets[@]}"
