#!/usr/bin/env bash
# Runs every fuzz target for SECONDS_PER_TARGET (default 60) from its seed corpus. New inputs go to build/fuzz/corpus,
# a crash to build/fuzz/crashes: add it to tests/fuzz/corpus once it is mended.
set -euo pipefail
cd "$(dirname "$0")/.."
seconds=${SECONDS_PER_TARGET:-60}

scripts/bootstrap.sh fuzz
scripts/build.sh fuzz
mkdir -p build/fuzz/crashes
found=0
while IFS= read -r target; do
    name=$(basename "$target")
    seeds=tests/fuzz/corpus/${name%_fuzz}
    grown=build/fuzz/corpus/$name
    mkdir -p "$grown"
    echo "== $name, $seconds s"
    folders=("$grown")
    if [[ -d $seeds ]]; then folders+=("$seeds"); fi
    words=tests/fuzz/${name%_fuzz}.dict
    options=()
    if [[ -f $words ]]; then options+=(-dict="$words"); fi
    "$target" "${options[@]}" -max_total_time="$seconds" -rss_limit_mb=2048 -timeout=20 -print_final_stats=1 \
        -artifact_prefix=build/fuzz/crashes/"$name"- "${folders[@]}"
    found=$((found + 1))
done < <(find build/fuzz -name '*_fuzz' ! -name 'replay_*' -type f -executable | sort)
if [[ $found == 0 ]]; then
    echo "fuzz: no target was built" >&2
    exit 1
fi
echo "fuzz: $found targets, no crash"
