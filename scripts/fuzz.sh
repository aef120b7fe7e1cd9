#!/usr/bin/env bash
# Runs fuzz targets for SECONDS_PER_TARGET (default 60) each from their seeds, one on each processor at a time: those named in FUZZ_TARGETS
# ("tiff zarr"; default: all). New inputs go to build/fuzz/corpus, what was printed to build/fuzz/NAME.log, an input that crashes, leaks,
# takes 2 GiB or 20 s to build/fuzz/crashes: add it to tests/fuzz/corpus once it is mended.
set -euo pipefail
cd "$(dirname "$0")/.."

# Runs one target; prints a line for it.
run_target() {
    local name=$1 seconds=$2 program=build/fuzz/tests/fuzz/$1_fuzz result="no finding"
    local folders=(build/fuzz/corpus/"$name") options=() words=tests/fuzz/$name.dict log=build/fuzz/$name.log
    mkdir -p "${folders[0]}"
    if [[ -d tests/fuzz/corpus/$name ]]; then folders+=(tests/fuzz/corpus/"$name"); fi
    if [[ -f $words ]]; then options+=(-dict="$words"); fi
    local TIMEFORMAT=%U inputs coverage
    {
        time "$program" "${options[@]}" -max_total_time="$seconds" -rss_limit_mb=2048 -timeout=20 -print_final_stats=1 \
            -artifact_prefix=build/fuzz/crashes/"$name"- "${folders[@]}" > "$log" 2>&1
    } 2> "$log.processor" || result="FAILED: $log"
    inputs=$(sed -n 's/^stat::number_of_executed_units: *//p' "$log" | tail -n 1)
    coverage=$(grep -o 'cov: [0-9]*' "$log" | tail -n 1 || true)
    printf '%-14s %8s s of processor %12s inputs  %10s  %s\n' "$name" "$(tail -n 1 "$log.processor")" "${inputs:-0}" "${coverage:-}" "$result"
    [[ $result == "no finding" ]]
}

if [[ ${1:-} == --target ]]; then
    run_target "$2" "$3"
    exit
fi
scripts/bootstrap.sh fuzz
scripts/build.sh fuzz
mkdir -p build/fuzz/crashes
targets=${FUZZ_TARGETS:-$(find build/fuzz/tests/fuzz -maxdepth 1 -name '*_fuzz' -type f -executable -printf '%f\n' | sed 's/_fuzz$//' | sort)}
for name in $targets; do
    if [[ ! -x build/fuzz/tests/fuzz/${name}_fuzz ]]; then
        echo "fuzz: there is no target '$name': tests/fuzz has NAME_fuzz.cpp for each" >&2
        exit 2
    fi
done
if [[ -z $targets ]]; then
    echo "fuzz: no target was built" >&2
    exit 1
fi
# shellcheck disable=SC2086 # names
if ! printf '%s\n' $targets | xargs -P "$(nproc)" -I NAME "$0" --target NAME "${SECONDS_PER_TARGET:-60}"; then
    echo "fuzz: inputs that fail are in build/fuzz/crashes" >&2
    exit 1
fi
echo "fuzz: $(wc -w <<< "$targets") targets, no finding"
