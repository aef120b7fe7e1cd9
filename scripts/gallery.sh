#!/usr/bin/env bash
# Pages of many volumes, to be looked at: one NAME.atlas.html each and an index.html, in FOLDER. Stores are kept there, so that a second run is quick.
#
#     scripts/gallery.sh FOLDER VOLUME...
#     scripts/gallery.sh gallery ../shared/data/{tooth/tooth,engine/engine}.nrrd
#
# Without volumes: those of ../shared/data that the study of significant objects looked at. ISOATLAS is the program (build/release/bin/isoatlas).
# With Chromium installed, scripts/screenshots.mjs takes pictures of the pages.
set -euo pipefail
here=$(cd "$(dirname "$0")/.." && pwd)
isoatlas=$(realpath "${ISOATLAS:-$here/build/release/bin/isoatlas}")
[ $# -ge 1 ] || { sed -n '2,8s/^# \{0,1\}//p' "$0"; exit 2; }
folder=$1
shift
if [ $# -eq 0 ]; then
  data=$here/../shared/data
  [ -d "$data" ] || { echo "gallery: there is no ../shared/data beside the checkout. Next: name volumes of your own" >&2; exit 2; }
  data=$(realpath "$data")
  for name in tooth engine bonsai headsq fuel neghip heptane pet; do set -- "$@" "$data/$name/$name.nrrd"; done
fi
mkdir -p "$folder"
escaped() { sed 's/&/\&amp;/g; s/</\&lt;/g; s/"/\&quot;/g'; }
links=""
for volume in "$@"; do
  volume=$(realpath "$volume")
  name=$(basename "$volume")
  name=${name%.gz} name=${name%.*}
  before=$SECONDS
  told=$(cd "$folder" && "$isoatlas" atlas "$volume" -o "$name.atlas.html" --quiet)
  echo "$told, $((SECONDS - before)) s"
  links+="<li><a href=\"$(escaped <<<"$name.atlas.html")\">$(escaped <<<"$name")</a> $(escaped <<<"${told#*: }")</li>"$'\n'
done
cat >"$folder/index.html" <<PAGE
<!doctype html>
<html lang="en">
<head><meta charset="utf-8"><meta name="viewport" content="width=device-width, initial-scale=1"><meta name="color-scheme" content="light dark"><title>Atlases</title></head>
<body style="font: 16px/1.6 system-ui, sans-serif; max-width: 40rem; margin: 2rem auto; padding: 0 1rem">
<h1>Atlases</h1>
<ul>
$links</ul>
</body>
</html>
PAGE
echo "$folder/index.html"
