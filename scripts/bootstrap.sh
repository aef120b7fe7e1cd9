#!/usr/bin/env bash
# Installs the Debian packages that a step needs and that are missing, and says why. Nothing else is touched.
#   scripts/bootstrap.sh [--list] GROUP...     groups: demo test bench fuzz package
# Exit 0: all there. 2: something is missing and cannot be installed from here (the command to run is printed).
# ISOATLAS_NO_BOOTSTRAP=1 skips the check, for systems whose libraries come from elsewhere.
set -euo pipefail

# group | package | why
packages() {
    cat <<'TABLE'
demo|make|the commands of the README
demo|g++|compiler (C++20)
demo|cmake|configures the build
demo|ninja-build|runs the build
demo|libtbb-dev|threads
demo|zlib1g-dev|compressed NRRD, NIfTI, MetaImage and VTK files
demo|libtiff-dev|TIFF stacks
demo|libpugixml-dev|VTK XML files
demo|libhdf5-dev|stores
demo|libxxhash-dev|checksums of stores
demo|libdeflate-dev|compressed trees in stores, PNG files
demo|libqhull-dev|convex hulls of objects, for their diameters
demo|libembree-dev|ray tracing of pictures
demo|libwebp-dev|WebP pictures
demo|libboost-dev|the server of the viewer, integers of any size (headers only)
demo|libmeshoptimizer-dev|meshes in few bytes for the viewer
demo|libzstd-dev|the same
demo|nodejs|bundles the page
demo|npm|bundles the page
demo|libcli11-dev|command line
demo|libfmt-dev|text output of the command line
demo|nlohmann-json3-dev|JSON output of the command line
test|libgtest-dev|test framework
test|librapidcheck-dev|random volumes that shrink to the smallest failing one
test|libcgal-dev|exact predicates: surfaces must not cross themselves
test|python3|layering test, schema test, documentation test
test|assimp-utils|independent reader of the surfaces we write
test|python3-vtk9|independent reader of the surfaces and trees we write
test|python3-numpy|arrays of python3-vtk9
test|python3-nibabel|independent reader of the NIfTI files we write
test|python3-tifffile|independent reader of the TIFF files we write
test|chromium|opens the page
test|python3-pil|independent reader of the pictures we write
test|python3-h5py|independent reader of stores
test|python3-networkx|independent reader of the trees we write
test|dpkg-dev|finds what a Debian package depends on
test|file|tells CPack what to strip
test|zsh|completion of its users
test|fish|completion of its users
test|groff|manual pages without a warning
test|clang-format-19|format check
test|clang-tidy-19|lint
test|mold|links the many test programs
bench|python3-vtk9|Flying Edges, the yardstick of surface extraction
bench|python3-numpy|reads the volumes for VTK
bench|xvfb|a display for VTK's ray caster, the yardstick of volume rendering
bench|xauth|lets VTK at that display
package|dpkg-dev|finds what a Debian package depends on
package|file|tells CPack what to strip
fuzz|clang-19|compiler with libFuzzer
fuzz|libclang-rt-19-dev|runtime of libFuzzer and the sanitizers
TABLE
}

list=no
groups=()
for argument in "$@"; do
    case $argument in
        --list) list=yes ;;
        demo) groups+=(demo) ;;
        test | bench | fuzz | package) groups+=(demo "$argument") ;;
        *)
            echo "bootstrap: unknown group '$argument'; groups: demo test bench fuzz package" >&2
            exit 2
            ;;
    esac
done
[[ ${#groups[@]} -gt 0 ]] || groups=(demo)
[[ ${ISOATLAS_NO_BOOTSTRAP:-0} != 1 ]] || exit 0

declare -A why
wanted=()
while IFS='|' read -r group package reason; do
    for chosen in "${groups[@]}"; do
        if [[ $group == "$chosen" && -z ${why[$package]:-} ]]; then
            wanted+=("$package")
            why[$package]=$reason
        fi
    done
done < <(packages)

if [[ $list == yes ]]; then
    for package in "${wanted[@]}"; do printf '%-22s %s\n' "$package" "${why[$package]}"; done
    exit 0
fi
if ! command -v dpkg-query >/dev/null || ! command -v apt-get >/dev/null; then
    echo "bootstrap: no Debian package manager here. Install what 'scripts/bootstrap.sh --list ${groups[*]}' shows," >&2
    echo "           then run again with ISOATLAS_NO_BOOTSTRAP=1" >&2
    exit 2
fi

declare -A installed
while read -r status package; do
    if [[ $status == installed ]]; then installed[${package%%:*}]=1; fi
done < <(dpkg-query -W -f='${db:Status-Status} ${Package}\n' "${wanted[@]}" 2>/dev/null || true)
if command -v npm >/dev/null; then installed[nodejs]=1 installed[npm]=1; fi  # Node.js from elsewhere brings its own npm
missing=()
for package in "${wanted[@]}"; do
    [[ -n ${installed[$package]:-} ]] || missing+=("$package")
done
[[ ${#missing[@]} -gt 0 ]] || exit 0

echo "isoatlas needs ${#missing[@]} Debian package(s) that are not installed:"
for package in "${missing[@]}"; do printf '  %-22s %s\n' "$package" "${why[$package]}"; done

as_root=()
if [[ $(id -u) != 0 ]]; then
    # A password can only be asked for on a terminal.
    if command -v sudo >/dev/null && { [[ -t 0 ]] || sudo -n true 2>/dev/null; }; then
        as_root=(sudo)
    else
        echo "bootstrap: neither root nor sudo here. As root, run this and start again:" >&2
        echo "  apt-get update && apt-get install --yes --no-install-recommends ${missing[*]}" >&2
        exit 2
    fi
fi

# sudo drops the environment; the proxies have to come along.
settings=(DEBIAN_FRONTEND=noninteractive)
for name in http_proxy https_proxy no_proxy HTTP_PROXY HTTPS_PROXY NO_PROXY; do
    [[ -z ${!name:-} ]] || settings+=("$name=${!name}")
done
apt() { "${as_root[@]}" env "${settings[@]}" apt-get -q -o Dpkg::Use-Pty=0 "$@"; }
log=$(mktemp)
trap 'rm -f "$log"' EXIT
attempt() {
    echo "+ apt-get $*"
    apt "$@" >"$log" 2>&1
}
# The package lists may be absent (fresh image) or stale (404): then they are fetched and the installation is tried again.
if ! apt-get -q -s install --no-install-recommends "${missing[@]}" >/dev/null 2>&1 ||
    ! attempt install --yes --no-install-recommends "${missing[@]}"; then
    attempt update || { cat "$log" >&2 && echo "bootstrap: 'apt-get update' failed; check the network and /etc/apt" >&2 && exit 2; }
    attempt install --yes --no-install-recommends "${missing[@]}" || {
        tail -n 40 "$log" >&2
        echo "bootstrap: the packages could not be installed; the message of apt-get is above" >&2
        exit 2
    }
fi
echo "installed: ${missing[*]}"
