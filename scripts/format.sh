#!/usr/bin/env bash
# Checks the format of all C++ sources (--fix: formats them) with the pinned clang-format.
set -euo pipefail
cd "$(dirname "$0")/.."
mode=(--dry-run -Werror)
if [[ ${1:-} == --fix ]]; then mode=(-i); fi

find src include apps python tests bench \( -name '*.h' -o -name '*.cpp' \) -print0 | sort -z |
    xargs -0 -r -n 16 -P "$(nproc)" clang-format-19 "${mode[@]}" || {
    echo "format: some files are not formatted; 'make format' does it" >&2
    exit 1
}
