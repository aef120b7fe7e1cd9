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
/usr/bin/python3 bench/extract/compare_vtk.py "$out/bin/bench_extract" --cache "$out/volumes" --json "$out/extract.json"
/usr/bin/python3 bench/store/compare_vtk.py "$out/bin/bench_store" --cache "$out/volumes" --json "$out/store.json"
if [[ -d $data ]]; then
    /usr/bin/python3 bench/render/compare_vtk.py "$out/bin/bench_render" "$data"/{bonsai/bonsai,engine/engine,headsq/headsq,heptane/heptane}.nrrd \
        --cache "$out/volumes" --json "$out/render.json"
fi
/usr/bin/python3 bench/report.py "$out"
