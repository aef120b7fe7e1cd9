#!/usr/bin/env bash
# Measures what docs/performance.md reports and renders its tables. Takes some minutes; leave the machine alone meanwhile.
set -euo pipefail
cd "$(dirname "$0")/.."

scripts/bootstrap.sh bench
scripts/build.sh bench
out=build/bench
data=../shared/data
options=(--cache "$out/volumes" --json "$out/engine.json" --growth)
if [[ -d $data ]]; then options+=(--data "$data"); fi
"$out/bin/bench_engine" "${options[@]}"
if [[ -x bench/extract/run.sh ]]; then bench/extract/run.sh "$out"; fi
python3 bench/report.py "$out"
