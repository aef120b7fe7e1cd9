#!/usr/bin/env bash
# clang-tidy over src and apps: scripts/lint.sh [BUILD_FOLDER]. The compile commands come from that folder (default build/dev).
set -euo pipefail
cd "$(dirname "$0")/.."
build=${1:-build/dev}

find src apps -name '*.cpp' -print0 | sort -z |
    xargs -0 -r -n 1 -P "$(nproc)" clang-tidy-19 -p "$build" --quiet --extra-arg=-Wno-unknown-warning-option 2>/dev/null || {
    echo "lint: the findings are above; each must be mended (or, with a reason, marked NOLINT)" >&2
    exit 1
}
