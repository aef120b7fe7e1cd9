#!/usr/bin/env bash
# Measures what docs/performance.md reports and renders its tables. Takes some minutes; leave the machine alone meanwhile.
set -euo pipefail
cd "$(dirname "$0")/.."

scripts/bootstrap.sh bench
scripts/build.sh bench
out=build/bench
data=../shared/data
options=(--cache "$out/volumes" --json "$out/engine.json" --growth)
real=()
if [[ -d $data ]]; then real=(--data "$data"); fi
"$out/bin/bench_engine" "${options[@]}" "${real[@]}"
/usr/bin/python3 bench/extract/compare_vtk.py "$out/bin/bench_extract" --cache "$out/volumes" --json "$out/extract.json"
/usr/bin/python3 bench/store/compare_vtk.py "$out/bin/bench_store" --cache "$out/volumes" "${real[@]}" --json "$out/store.json"
measured=(engine extract store)
if [[ -d $data ]]; then
    /usr/bin/python3 bench/render/compare_vtk.py "$out/bin/bench_render" "$data"/{bonsai/bonsai,engine/engine,headsq/headsq,heptane/heptane}.nrrd \
        --cache "$out/volumes" --json "$out/render.json"
    /usr/bin/python3 bench/page/first_pictures.py "$out/bin/isoatlas" "$data"/{bonsai/bonsai,headsq/headsq,engine/engine,tooth/tooth}.nrrd \
        --json "$out/pages.json"
    measured+=(render pages)
fi
for name in "${measured[@]}"; do /usr/bin/python3 bench/machine.py "$out/$name.json"; done
/usr/bin/python3 bench/report.py "$out"
