#!/usr/bin/env bash
# Measures what docs/performance.md reports and renders its tables. Takes three quarters of an hour on two processors; leave the machine
# alone meanwhile.
#
#   scripts/bench.sh [--quick] [SECTION...]     sections, all of them by default:
#       engine extract builds decoding store fronts formats render pages remote python methods simplify scale
#
# --quick: 64^3 voxels, a run or two each, into build/bench/quick and a copy of the page there: do the scripts work? On a processor with
# AVX-512 everything is measured twice, with its own vectors and with ISOATLAS_SIMD=avx2; once, where ISOATLAS_SIMD is set, be it empty.
# ISOATLAS_BENCH_PROGRAMS: a folder with the programs; nothing is built then.
set -euo pipefail
cd "$(dirname "$0")/.."

quick=
if [[ ${1:-} == --quick ]]; then
    quick=yes
    shift
fi
sections=("$@")
if [[ $# -eq 0 ]]; then sections=(engine extract builds decoding store fronts formats render pages remote python methods simplify scale); fi
programs=${ISOATLAS_BENCH_PROGRAMS:-}
if [[ -z $programs ]]; then
    scripts/bootstrap.sh bench
    scripts/build.sh bench
    programs=build/bench/bin
fi
out=build/bench
page=docs/performance.md
fields=() methods=() surfaces=() simplify=() scale=() engine=() pairs=() package=() formats=()
if [[ -n $quick ]]; then
    out=build/bench/quick
    formats=(--volumes smooth-64 --pairs 1) engine=(smooth-64 noisy-64 white-64) scale=(--sizes 32 64) pairs=(--pairs 1) package=(--memmap smooth-64 --loops 100 --interrupts 2)
    methods=(smooth-16 smooth-32 smooth-64 white-16 white-32 white-64)
    fields=(--volumes "${engine[@]}")
    surfaces=(--volumes smooth-16 white-16) simplify=(--surfaces smooth-16@0 white-16@0.5)
fi
mkdir -p "$out/volumes"
if [[ -n $quick ]]; then cp "$page" "$out/performance.md" && page=$out/performance.md; fi
common=(--cache "$out/volumes")
if [[ -d ../shared/data ]]; then common+=(--data ../shared/data); fi
if [[ ${#surfaces[@]} -eq 0 ]]; then
    surfaces=(--volumes smooth-64 white-32)
    if [[ -d ../shared/data ]]; then surfaces+=(fuel neghip headsq); fi
fi

python() { /usr/bin/python3 -B "$@"; }

compare() { # a script, its program, further options; writes $to/$section.json
    python "bench/$1" "$programs/$2" "${fields[@]}" "${common[@]}" "${pairs[@]}" "${@:3}" --json "$to/$section.json"
}

measure() { # into the folder $1
    local to=$1 section start
    mkdir -p "$to"
    for section in "${sections[@]}"; do
        start=$SECONDS
        case $section in
            engine) "$programs/bench_engine" "${engine[@]}" "${common[@]}" "${pairs[@]}" --json "$to/engine.json" ;;
            extract) compare extract/compare_vtk.py bench_extract ;;
            builds) compare store/builds.py bench_store ;;
            decoding) compare store/decoding.py bench_store ;;
            store) compare store/compare_vtk.py bench_store ;;
            fronts) compare store/fronts.py bench_store ;;
            formats) python bench/formats/compare_libraries.py "$programs/bench_formats" "${formats[@]}" --cache "$out/volumes" --json "$to/formats.json" ;;
            render) compare render/compare_vtk.py bench_render ;;
            pages) compare page/first_pictures.py isoatlas ;;
            remote) compare view/remote_pictures.py isoatlas ;;
            python) compare python/package.py bench_extract "${package[@]}" ;;
            methods)
                "$programs/bench_methods" growth "${methods[@]}" "${common[@]}" --json "$to/methods.json"
                python bench/methods/surfaces.py "$programs/isoatlas" "${surfaces[@]}" "${common[@]}" --json "$to/methods-surfaces.json"
                python bench/machine.py "$to/methods-surfaces.json"
                ;;
            simplify) python bench/level_of_detail/compare.py "$programs" "${simplify[@]}" "${common[@]}" --json "$to/simplify.json" ;;
            scale) python bench/scale.py "$programs" "${scale[@]}" --cache "$out/volumes" --out "$to" ;;
            *) echo "bench: no section '$section'; sections: engine extract builds decoding store fronts formats render pages remote python methods simplify scale" >&2 && exit 2 ;;
        esac
        if [[ $section == scale ]]; then python bench/machine.py "$to"/scale-*.json; else python bench/machine.py "$to/$section.json"; fi
        python bench/report.py "$to" "$page"
        echo "bench: $section measured in $((SECONDS - start)) s"
    done
}

measure "$out"
if [[ -z ${ISOATLAS_SIMD+set} && $(python bench/machine.py --vectors) == AVX-512 ]]; then
    export ISOATLAS_SIMD=avx2
    measure "$out/avx2"
fi
