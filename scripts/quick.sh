#!/usr/bin/env bash
# The loop of a change: builds what it touches and runs the tests of the rooms that it lies in.
#   scripts/quick.sh [room ...]     rooms are folders of src, e.g. `tree` or `formats/volume`; without: those of files that differ from HEAD
set -euo pipefail
cd "$(dirname "$0")/.."

# program of tests/unit that a room belongs to (tests/CMakeLists.txt)
program_of() {
    case $1 in
        base | field | critical | tree | features | levelset | mesh) echo "unit_$1" ;;
        zones | analysis | persistence) echo theorems_trees ;;
        formats*) echo unit_formats ;;
        codec | store | bricks | census | atlas) echo unit_store ;;
        measures) echo unit_measures ;;
        image | render) echo unit_render ;;
        preview | catalogue | page | server) echo unit_server ;;
        phantom | verify) echo unit_checks ;;
        methods*) echo unit_methods ;;
        *) echo "quick: no room is called $1; rooms are the folders of src" >&2 && return 1 ;;
    esac
}

rooms=("$@")
if ((${#rooms[@]} == 0)); then
    mapfile -t rooms < <({ git diff --name-only HEAD; git ls-files --others --exclude-standard; } |
        sed -nE 's#^(src|tests/unit)/(formats|[a-z]+)/.*#\2#p' | sort -u)
fi
if ((${#rooms[@]} == 0)); then
    echo "quick: no file of src or tests/unit differs from HEAD; name a room, e.g. make quick ROOM=tree"
    exit 0
fi
programs=()
for room in "${rooms[@]}"; do programs+=("$(program_of "$room")"); done
mapfile -t programs < <(printf '%s\n' "${programs[@]}" | sort -u)
[[ -f build/dev/build.ninja ]] || cmake --preset dev >/dev/null
cmake --build build/dev --target "${programs[@]}"
ctest --test-dir build/dev --output-on-failure -j "$(nproc)" -R "^($(IFS='|'; echo "${programs[*]}"))(_[0-9]+)?\$"
