#!/usr/bin/env bash
# Line coverage of src/ by the tests: per file, with what gcov of the compiler gives.
set -euo pipefail
cd "$(dirname "$0")/.."

scripts/bootstrap.sh test
scripts/build.sh coverage
ctest --preset coverage
cd build/coverage
find . -path '*stage_*' -name '*.gcda' -print0 | xargs -0 gcov --no-output 2>/dev/null |
    awk '/^File .*\/src\// { split($0, part, "/src/"); file = part[2]; sub(/\x27$/, "", file) }
         /^Lines executed/ && file { split($2, percent, "[:%]"); printf "%6.1f %%  %s\n", percent[2], file; file = "" }' |
    sort -u -k3 | sort -n
