#!/usr/bin/env bash
# Run by CTest: pip builds the wheel from a clean copy of the sources, installs it into a fresh virtual environment without network, and what
# it holds is used from another folder.
#   wheel_test.sh SOURCE BUILD WORK     BUILD: a finished build; its bundled pages are taken, so that no npm is needed
# The modules of BUILD are taken. ISOATLAS_ALL_DATA=1: they are compiled anew (with ccache where it is installed), without optimisation.
set -euo pipefail
source=$1 build=$2 work=$3

skip() { echo "SKIPPED: $1" && exit 0; }
command -v git >/dev/null && git -C "$source" rev-parse --git-dir >/dev/null 2>&1 || skip "git does not know the sources"
command -v cmake >/dev/null && command -v ninja >/dev/null || skip "cmake or ninja is not installed"
/usr/bin/python3 -c "import ensurepip, venv, numpy" 2>/dev/null || skip "python3-venv or python3-numpy is not installed"
[[ -f $build/web/dist/viewer.html ]] || skip "this build has no pages"

rm -rf --one-file-system "$work"
mkdir -p "$work/source"
trap 'rm -rf --one-file-system "$work"' EXIT
(cd "$source" && git ls-files -z --cached --others --exclude-standard | tar --null --ignore-failed-read -T - -cf - 2>/dev/null) | tar -xf - -C "$work/source"
started=$SECONDS
step() { echo "$1: $((SECONDS - started)) s"; started=$SECONDS; }
/usr/bin/python3 -m venv --system-site-packages "$work/venv"
python=$work/venv/bin/python
step "a virtual environment"

cd "$work"
if command -v mold >/dev/null; then export LDFLAGS=-fuse-ld=mold; fi
modules=ISOATLAS_PYTHON_BUILT=$build/python/isoatlas
if [[ -n ${ISOATLAS_ALL_DATA:-} ]]; then modules=CMAKE_CXX_FLAGS_RELEASE=-O0; fi
pip=("$python" -m pip --disable-pip-version-check --no-cache-dir)
"${pip[@]}" wheel -v --no-build-isolation --no-index --no-deps -w "$work/wheels" --config-settings=ISOATLAS_WEB_DIST="$build/web/dist" \
    --config-settings="$modules" \
    "$work/source" >said 2>&1 || { tail -n 40 said && echo "the wheel was not built" && exit 1; }
step "the wheel, $(du -h "$work"/wheels/*.whl | cut -f1)"
"${pip[@]}" install --no-index --no-deps "$work"/wheels/*.whl >said 2>&1 || { cat said && echo "the wheel was not installed" && exit 1; }
rm -r "$work/source"  # what is used below is the wheel alone
mkdir elsewhere
cd elsewhere
env -u PYTHONPATH XDG_STATE_HOME="$work/state" "$python" -W error - "$work/venv" <<'PYTHON'
import importlib.metadata, pathlib, subprocess, sys, urllib.request
import numpy as np
import isoatlas
home = pathlib.Path(isoatlas.__file__).parent
assert pathlib.Path(sys.argv[1]) in home.parents, home
about = importlib.metadata.distribution("isoatlas")
assert about.version == isoatlas.__version__ and about.metadata["Requires-Dist"].startswith("numpy"), about.metadata
assert {path.name for path in about.files} >= {"METADATA", "WHEEL", "RECORD", "LICENSE", "py.typed", "_core.pyi", "napari.yaml"}
for path in about.files:
    content = path.read_binary() if path.hash else b""
    assert not path.hash or len(content) == path.size, path
plugin, = [one for one in importlib.metadata.entry_points(group="napari.manifest") if one.name == "isoatlas"]
module, file = plugin.value.split(":")
assert (home / "napari" / file).exists() and module == "isoatlas.napari"
array = isoatlas.phantom("demo", 48)
atlas = isoatlas.open(array, spacing=(1, 0.5, 0.5), unit="mm")
mesh = atlas.objects[0].surface()
mesh.verify()
mesh.save("object.ply")
atlas.save_evolution("evolution.vtkhdf", [90, 120])
assert pathlib.Path("evolution.vtkhdf").read_bytes()[:4] == b"\x89HDF"
picture = isoatlas.render(mesh, size=(64, 48), samples=1)
assert np.asarray(picture).shape[:2] == (48, 64) and np.asarray(picture).std() > 0
with atlas.view() as view:
    page = urllib.request.urlopen(view._viewer.address_for_one_frame()).read()
    assert page.lstrip().lower().startswith(b"<!doctype html") and len(page) > 100_000, page[:200]
    assert view.request("/api/objects?tau=120")["count"] > 0
print("isoatlas", isoatlas.__version__, "of the wheel:", repr(mesh))
PYTHON
step "import, table, surface, picture, viewer"
"${pip[@]}" uninstall -y isoatlas >/dev/null
left=$(find "$work/venv" -iname "*isoatlas*")
[[ -z $left ]] || { echo "pip uninstall leaves this behind: $left" && exit 1; }
