#!/usr/bin/env bash
# Installs the Debian packages that a step needs and that are missing. Before: which, why, how many with those they bring, megabytes to
# download and on disk. On a terminal it asks. Nothing else is touched.
#   scripts/bootstrap.sh [--list] [--yes] GROUP...     groups: demo test bench fuzz package
# Exit 0: all there. 2: something is missing and was not installed (the command that does it is printed).
# ISOATLAS_YES=1, or CI in the environment: as --yes, nothing is asked.
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
demo|libpng-dev|slices in PNG files
demo|libjpeg-dev|slices in JPEG files
demo|libpugixml-dev|VTK XML files
demo|libhdf5-dev|stores, VTKHDF files, HDF5 and NetCDF volumes
demo|libgdcm-dev|compressed DICOM files
demo|libopenvdb-dev|OpenVDB files
demo|libblosc-dev|compressed chunks of Zarr arrays
demo|liblz4-dev|the same
demo|libbz2-dev|the same, and of HDF5, bzip2 in NRRD files
demo|libdraco-dev|meshes for Neuroglancer
demo|libcurl4-openssl-dev|files on web servers
demo|libxxhash-dev|checksums of stores
demo|libdeflate-dev|compressed trees in stores, PNG files
demo|libqhull-dev|convex hulls of objects, for their diameters
demo|libembree-dev|ray tracing of pictures
demo|libwebp-dev|WebP pictures
demo|libboost-dev|the server of the viewer, integers of any size (headers only)
demo|libmeshoptimizer-dev|meshes in few bytes for the viewer
demo|libzstd-dev|the same, chunks of Zarr arrays
demo|nodejs|bundles the page
demo|npm|bundles the page
demo|libcli11-dev|command line
demo|pybind11-dev|the Python package
demo|python3-dev|the same
demo|python3-numpy|its arrays
demo|libfmt-dev|text output of the command line
demo|nlohmann-json3-dev|JSON output of the command line
test|libgtest-dev|test framework
test|librapidcheck-dev|random volumes that shrink to the smallest failing one
test|libcgal-dev|exact predicates: surfaces must not cross themselves
test|python3|layering test, schema test, documentation test
test|assimp-utils|independent reader of the surfaces we write
test|python3-vtk9|independent reader of the surfaces and trees we write
test|python3-pytest|tests of the Python package
test|python3-scipy|independent labels
test|python3-skimage|independent surfaces
test|python3-pandas|tables of the Python package
test|python3-meshio|meshes of the Python package
test|python3-mypy|types of the Python package
test|python3-qtpy|the dock widget of the Python package
test|python3-pyqt5|the same
test|python3-yaml|its manifest, the conda recipe
test|python3-nbclient|the notebook of the Python package
test|python3-ipykernel|the same
test|python3-venv|a virtual environment for its wheel
test|python3-nibabel|independent reader of the NIfTI files we write
test|python3-openvdb|independent reader and writer of OpenVDB files
test|python3-mrcfile|independent reader and writer of MRC maps
test|python3-zarr|independent reader and writer of Zarr arrays
test|python3-pydicom|independent reader and writer of DICOM files
test|python3-tifffile|independent reader and writer of TIFF files
test|chromium|opens the page
test|python3-pil|independent reader and writer of pictures
test|python3-h5py|independent reader of stores, writer of HDF5 volumes
test|hdf5-filter-plugin|independent filters of HDF5: LZ4, bzip2
test|hdf5-filter-plugin-blosc-serial|independent filter of HDF5: Blosc
test|python3-netcdf4|independent writer of NetCDF files
test|python3-networkx|independent reader of the trees we write
test|debootstrap|a bare Debian, where the package is installed
test|dpkg-dev|finds what a Debian package depends on
test|file|tells CPack what to strip
test|zsh|completion of its users
test|fish|completion of its users
test|groff|manual pages without a warning
test|clang-format-19|format check
test|clang-tidy-19|lint
test|mold|links the many test programs
bench|python3-vtk9|Flying Edges, the yardstick of surface extraction
bench|libcgal-dev|edge collapse, beside ours
bench|python3-numpy|reads the volumes for VTK
bench|python3-h5py|reads HDF5 for the table of files
bench|python3-zarr|reads Zarr for the table of files
bench|python3-netcdf4|reads NetCDF for the table of files
bench|python3-tifffile|reads TIFF for the table of files
bench|python3-mrcfile|reads MRC for the table of files
bench|python3-nibabel|reads NIfTI for the table of files
bench|python3-pydicom|reads DICOM for the table of files
bench|python3-skimage|Marching Cubes of Lewiner and Lorensen, beside the methods of the literature
bench|python3-scipy|components of their surfaces
bench|xvfb|a display for VTK's ray caster, the yardstick of volume rendering
bench|xauth|lets VTK at that display
package|dpkg-dev|finds what a Debian package depends on
package|file|tells CPack what to strip
fuzz|clang-19|compiler with libFuzzer
fuzz|libclang-rt-19-dev|runtime of libFuzzer and the sanitizers
TABLE
}

list=no
yes=${ISOATLAS_YES:-}
[[ ${CI:-false} == false ]] || yes=1
groups=()
for argument in "$@"; do
    case $argument in
        --list) list=yes ;;
        --yes) yes=1 ;;
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

# find_missing: those of `wanted` that are not installed, in `missing`.
find_missing() {
    local -A installed=()
    local status package
    while read -r status package; do
        if [[ $status == installed ]]; then installed[${package%%:*}]=1; fi
    done < <(dpkg-query -W -f='${db:Status-Status} ${Package}\n' "${wanted[@]}" 2>/dev/null || true)
    if command -v npm >/dev/null; then installed[nodejs]=1 installed[npm]=1; fi  # Node.js from elsewhere brings its own npm
    missing=()
    for package in "${wanted[@]}"; do
        [[ -n ${installed[$package]:-} ]] || missing+=("$package")
    done
}
find_missing
[[ ${#missing[@]} -gt 0 ]] || exit 0

echo "isoatlas needs ${#missing[@]} Debian package(s) that are not installed:"
for package in "${missing[@]}"; do printf '  %-22s %s\n' "$package" "${why[$package]}"; done

by_hand="apt-get update && apt-get install --yes --no-install-recommends ${missing[*]}"
as_root=()
if [[ $(id -u) != 0 ]]; then
    # A password can only be asked for on a terminal.
    if command -v sudo >/dev/null && { [[ -t 0 ]] || sudo -n true 2>/dev/null; }; then
        as_root=(sudo)
    else
        echo "bootstrap: neither root nor sudo here. As root, run this and start again:" >&2
        echo "  $by_hand" >&2
        exit 2
    fi
fi

# sudo drops the environment; the proxies have to come along.
settings=(DEBIAN_FRONTEND=noninteractive LC_ALL=C)
for name in http_proxy https_proxy no_proxy HTTP_PROXY HTTPS_PROXY NO_PROXY; do
    [[ -z ${!name:-} ]] || settings+=("$name=${!name}")
done
here=$(cd "$(dirname "$0")/.." && pwd)
mkdir -p "$here/build"
log=$here/build/bootstrap.log
: >"$log"
packages=0 download=""

# apt ARGUMENT...: runs it as root, with its progress on the standard output and everything else in the log. The descriptor of the progress
# is opened behind sudo, which closes all but three.
apt() {
    echo "+ apt-get $*" | tee -a "$log"
    # shellcheck disable=SC2016
    "${as_root[@]}" env "${settings[@]}" sh -c 'exec apt-get -q -o Dpkg::Use-Pty=0 -o APT::Status-Fd=3 "$@" 3>&1 >&2' sh "$@" 2>>"$log" </dev/null |
        "$here/scripts/apt_progress.sh" "$packages" "$download"
}

failed() {
    tail -n 25 "$log" >&2
    echo "bootstrap: $1; the message of apt-get is above, all that it said in $log" >&2
    echo "           $2, then start again, or run as root:" >&2
    echo "  $by_hand" >&2
    exit 2
}

update_lists() {
    packages=0 download=""
    apt update || failed "the package lists could not be fetched" "Check the network and /etc/apt"
}

# How many packages come, and their sizes. With --yes --print-uris apt-get says it and does nothing. False: it does not know them all, for
# want of lists (it then takes `g++` for a pattern).
look_ahead() {
    local told
    told=$(LC_ALL=C apt-get -q --yes --print-uris -o Debug::NoLocking=true install --no-install-recommends "${missing[@]}" 2>>"$log") || return 1
    packages=$(sed -nE 's/^([0-9]+) upgraded, ([0-9]+) newly installed.*/\1 + \2/p' <<<"$told")
    packages=$((packages))
    ((packages >= ${#missing[@]})) || return 1
    download=$(sed -nE 's|^Need to get ([0-9.,]+ [kMGT]?B).*|\1|p' <<<"$told")
    disk=$(sed -nE 's/^After this operation, ([0-9.,]+ [kMGT]?B) of additional disk space.*/\1/p' <<<"$told")
    echo "In all $packages packages with those that they need: ${download:-0 B} to download, ${disk:-0 B} more on the disk."
}

echo "asking apt-get what they bring along ..."
if ! look_ahead; then
    echo "the package lists are missing or too old; they come first"
    update_lists
    look_ahead || failed "apt-get does not have all of these packages" "Debian 12 has them: see that /etc/apt names its main archive"
fi
if [[ -z $yes && -t 0 && -t 1 ]]; then
    read -r -p "Install them? [Y/n] " answer || answer=n
    if [[ ! ${answer:-y} =~ ^[Yy] ]]; then
        echo "bootstrap: nothing was installed. As root, the same by hand, then start again:" >&2
        echo "  $by_hand" >&2
        exit 2
    fi
fi
before=$SECONDS
install() { apt install --yes --no-install-recommends "${missing[@]}"; }
# A package that is not found may have been replaced by a newer one: then the lists are fetched and it is tried again.
if ! install; then
    echo "that failed; once more with new package lists"
    update_lists
    find_missing
    if ! { look_ahead && install; }; then failed "the packages could not be installed" "Do what it asks for"; fi
fi
find_missing
[[ ${#missing[@]} == 0 ]] || failed "apt-get ended without an error, but ${missing[*]} are missing" "See what it says"
echo "installed $packages packages in $((SECONDS - before)) s"
