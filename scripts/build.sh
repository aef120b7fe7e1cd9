#!/usr/bin/env bash
# Configures a preset and builds it: scripts/build.sh PRESET [TARGET...]. ccache and, with a
# linker not chosen in LDFLAGS, mold are used when they are there.
set -euo pipefail
cd "$(dirname "$0")/.."
preset=$1
shift

options=()
if command -v ccache >/dev/null; then options+=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache); fi
if command -v mold >/dev/null; then export LDFLAGS="${LDFLAGS:--fuse-ld=mold}"; fi
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
