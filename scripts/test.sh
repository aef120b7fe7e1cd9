#!/usr/bin/env bash
# Everything that must hold before a change is shared. Prints what each step took.
set -euo pipefail
cd "$(dirname "$0")/.."

step() {
    local name=$1 start=$SECONDS
    shift
    echo "== $name"
    "$@"
    echo "== $name: ok, $((SECONDS - start)) s"
}

step "packages" scripts/bootstrap.sh test
step "format" scripts/format.sh
step "lint" scripts/lint.py --most --since HEAD~25 # more commits than are shared at once; make lint looks at everything
step "build" scripts/build.sh dev
log=build/dev/Testing/Temporary/LastTest.log
step "tests" sh -c 'ctest --preset dev || { status=$?; python3 -B scripts/failed_tests.py "$0"; exit $status; }' "$log"
python3 -B scripts/skipped_tests.py "$log"
echo "All checks passed in $SECONDS s."
