#!/usr/bin/env bash
# The first five minutes: installs what is missing, builds, analyses a volume, writes its objects to demo/.
#   VOLUME=file   your own volume; otherwise one is generated
#   ARGS="..."    options for reading it, e.g. ARGS="--dims 256 256 128 --type uint8" for RAW files
set -euo pipefail
cd "$(dirname "$0")/.."
. scripts/caller.sh

surfaces=5   # of that many objects
here=""      # before paths that are printed: nothing, if the user is in this folder
[[ $CALLER -ef . ]] || here=$PWD/
out=${here}demo
read -r -a options <<<"${ARGS:-}"

say() { printf '\n== %s\n' "$*"; }

volume=${VOLUME:-}
if [[ -n $volume ]]; then
    meant=$(as_meant "$volume")
    if [[ -e $meant && ! $meant -ef $volume ]]; then volume=$meant; fi  # called from elsewhere
    if [[ ! -e $volume ]]; then
        looked="is no $meant"
        [[ -z $here || $volume == [/~]* ]] || looked+=", and no $PWD/$volume"
        echo "demo: there $looked (expected a volume). Next: VOLUME=path, from the folder where make is called" >&2
        exit 2
    fi
fi
scripts/bootstrap.sh demo
if [[ ! -x build/release/bin/isoatlas ]]; then
    say "building (about 6 minutes of processor time, 3 on two processors)"
fi
scripts/build.sh release isoatlas_cli
isoatlas=${here}build/release/bin/isoatlas

# An earlier demonstration stays whole until this one is.
before=$out.before
restore() {
    [[ -d $before ]] || return 0
    rm -rf "$out"
    mv "$before" "$out"
}
restore  # of a run that was killed
if [[ -d $out ]]; then cp -a "$out" "$before"; fi  # VOLUME may lie in it
trap restore EXIT
mkdir -p "$out"
rm -f "$out"/object_*.ply "$out"/object_*.vtp "$out"/tree.json "$out"/objects.json
if [[ -z $volume ]]; then
    volume=$out/demo.nrrd
    say "generating a demonstration volume"
    "$isoatlas" phantom demo -o "$volume"
fi

say "what is in $volume? A page shows it"
"$isoatlas" "$volume" "${options[@]}" -o "$out/demo.atlas.html" --restart

say "what is in $volume?"
"$isoatlas" objects "$volume" "${options[@]}"
"$isoatlas" objects "$volume" "${options[@]}" --top "$surfaces" --json --quiet >"$out/objects.json"
"$isoatlas" tree "$volume" "${options[@]}" --quiet -o "$out/tree.json" >/dev/null

# One object a line in the JSON document; a slice has curves, which PLY does not hold.
extension=ply
if "$isoatlas" info "$volume" "${options[@]}" --json --quiet | tr -d ' \n' | grep -q '"rank":2'; then extension=vtp; fi
mapfile -t numbers < <(sed -nE 's/.*"number": ?([0-9]+),.*"best_tau".*/\1/p' "$out/objects.json")
if [[ ${#numbers[@]} == 0 ]]; then
    echo "nothing in this volume rises above the noise; $isoatlas objects $volume --all lists everything"
else
    which="each of the first ${#numbers[@]}"
    [[ ${#numbers[@]} != 1 ]] || which="the first"
    say "writing a surface for $which, and proving that it is closed, manifold and oriented"
fi
for number in "${numbers[@]}"; do
    file=$out/object_$number.$extension
    "$isoatlas" extract "$volume" "${options[@]}" --object "$number" --quiet -o "$file"
    [[ $extension == ply ]] || continue
    # The file is read back and every guarantee checked; the details matter only when one does not hold.
    proof=$("$isoatlas" verify "$file" --quiet) || { code=$?; echo "$proof" >&2; exit "$code"; }
    echo "  verified: ${proof##*: }"
done

rm -rf "$before"
say "done"
cat <<TEXT
$out/demo.atlas.html   open it in a browser: a picture of every object, and the isovalues that show it
$out/objects.json      the table as JSON
$out/tree.json         the criticality tree: every topological change, with its zone
$out/object_N.$extension      the surface of object N at its best isovalue (any mesh viewer opens it)

Next:
  make demo VOLUME=your_file              the same for your data (NRRD, NIfTI, MHA, NPY, VTI, VTK, TIFF, MRC, RAW)
  $isoatlas --help       everything else
  make install PREFIX=~/.local            puts isoatlas and the C++ library there
  $isoatlas view $out/demo.atlas     explore it in a browser
TEXT
