#!/usr/bin/env bash
# Runs fuzz targets from their seeds for SECONDS_PER_TARGET (default 60) each, counted in time of a processor so that a busy machine runs as
# many inputs as an idle one, one on each processor at a time: those named in FUZZ_TARGETS ("tiff zarr"; default: all). New inputs go to
# build/fuzz/corpus, what was printed to build/fuzz/NAME.log, an input that crashes, leaks, takes 2 GiB or a minute to build/fuzz/crashes:
# add it to tests/fuzz/corpus once it is mended. tests/fuzz/NAME.flags: of libFuzzer, one a line. FUZZ_RECORD=FILE appends a line for each
# target to a table (tests/fuzz/hours.tsv).
set -euo pipefail
cd "$(dirname "$0")/.."

# The seconds of a processor that a process has taken; none once it has ended.
processor_seconds() {
    awk '{ print int(($14 + $15) / ticks) }' ticks="$(getconf CLK_TCK)" "/proc/$1/stat" 2>/dev/null || true
}

# Runs one target; prints a line for it. A third argument tells processes of one target apart that run at the same time: they share what
# they find.
run_target() {
    local name=$1 seconds=$2 program=build/fuzz/tests/fuzz/$1_fuzz result="no finding" commit
    local folders=(build/fuzz/corpus/"$name") options=() words=tests/fuzz/$name.dict log=build/fuzz/$name${3:+.$3}.log
    commit=$(git rev-parse --short=8 HEAD)
    mkdir -p "${folders[0]}"
    if [[ -d tests/fuzz/corpus/$name ]]; then folders+=(tests/fuzz/corpus/"$name"); fi
    if [[ -f $words ]]; then options+=(-dict="$words"); fi
    if [[ -f tests/fuzz/$name.flags ]]; then mapfile -t -O "${#options[@]}" options < tests/fuzz/"$name".flags; fi
    # One allocation may be larger than all that is used: libhdf5 asks for what a damaged length says, and then reads less.
    options+=(-rss_limit_mb=2048 -malloc_limit_mb=8192 -timeout=60 -print_final_stats=1)
    "$program" "${options[@]}" -artifact_prefix=build/fuzz/crashes/"$name"- "${folders[@]}" > "$log" 2>&1 &
    local process=$! taken=0 now inputs coverage
    while now=$(processor_seconds "$process") && [[ -n $now ]]; do
        taken=$now
        if ((taken >= seconds)); then
            kill -USR1 "$process" 2>/dev/null || true  # libFuzzer prints its figures and exits with 0
            break
        fi
        sleep 1
    done
    wait "$process" || result="FAILED: $log"
    inputs=$(sed -n 's/^stat::number_of_executed_units: *//p' "$log" | tail -n 1)
    coverage=$(grep -o 'cov: [0-9]*' "$log" | tail -n 1 || true)
    printf '%-14s %8s s of a processor %12s inputs  %10s  %s\n' "$name" "$taken" "${inputs:-0}" "${coverage:-}" "$result"
    if [[ -n ${FUZZ_RECORD:-} ]]; then
        printf '%s\t%s\t%s\t%s\t%s\t%s\t%s\n' "$name" "$(date -u +%F)" "$commit" "$taken" "${inputs:-0}" \
            "${coverage#cov: }" "${result%%:*}" >> "$FUZZ_RECORD"
    fi
    [[ $result == "no finding" ]]
}

if [[ ${1:-} == --target ]]; then
    run_target "${@:2}"
    exit
fi
scripts/bootstrap.sh fuzz
read -r -a targets <<< "${FUZZ_TARGETS:-}"
for name in "${targets[@]}"; do
    if [[ ! -f tests/fuzz/${name}_fuzz.cpp ]]; then
        echo "fuzz: there is no target '$name': tests/fuzz has NAME_fuzz.cpp for each" >&2
        exit 2
    fi
done
scripts/build.sh fuzz "${targets[@]/%/_fuzz}"
mkdir -p build/fuzz/crashes
if [[ ${#targets[@]} == 0 ]]; then
    mapfile -t targets < <(find build/fuzz/tests/fuzz -maxdepth 1 -name '*_fuzz' -type f -executable -printf '%f\n' | sed 's/_fuzz$//' | sort)
fi
if [[ ${#targets[@]} == 0 ]]; then
    echo "fuzz: no target was built" >&2
    exit 1
fi
if ! printf '%s\n' "${targets[@]}" | xargs -P "$(nproc)" -I NAME "$0" --target NAME "${SECONDS_PER_TARGET:-60}"; then
    echo "fuzz: inputs that fail are in build/fuzz/crashes" >&2
    exit 1
fi
echo "fuzz: ${#targets[@]} targets, no finding"
