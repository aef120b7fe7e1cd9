#!/usr/bin/env bash
# Builds and installs to PREFIX (default /usr/local), below DESTDIR if that is set.
set -euo pipefail
cd "$(dirname "$0")/.."
. scripts/caller.sh

prefix=$(as_meant "${PREFIX:-/usr/local}")
# Where nothing can be written is known before the build.
folder=${DESTDIR:-}$prefix
while [[ ! -e $folder ]]; do folder=$(dirname "$folder"); done
if [[ ! -d $folder || ! -w $folder ]]; then
    echo "install: user $(id -un) may not write to $prefix ($folder is not a folder of theirs). Next: make install PREFIX=~/.local, or as root" >&2
    exit 2
fi
scripts/bootstrap.sh demo
scripts/build.sh release
log=build/release/install.log
cmake --install build/release --prefix "$prefix" >"$log" 2>&1 || {
    tail -n 5 "$log" >&2
    echo "install: the message of cmake is above. Next: if it may not write there, make install PREFIX=~/.local, or as root" >&2
    exit 2
}
echo "installed: ${DESTDIR:-}$prefix/bin/isoatlas, manual pages, completions, libraries and headers; all files are named in $PWD/build/release/install_manifest.txt"
case :$PATH: in
    *:"$prefix/bin":*) echo "Next: isoatlas --help" ;;
    *) echo "Next: $prefix/bin/isoatlas --help; export PATH=$prefix/bin:\$PATH for the short name" ;;
esac
case $prefix in
    /usr | /usr/local) ;;
    *) echo "      programs that use the library: cmake -DCMAKE_PREFIX_PATH=$prefix" ;;
esac
