#!/usr/bin/env bash
# Debian packages and tarballs of the command line and of the library, in build/release/packages.
set -euo pipefail
cd "$(dirname "$0")/.."
scripts/bootstrap.sh package
scripts/build.sh release
log=build/release/packages.log
rm -rf build/release/packages
(cd build/release && cpack >"../../$log") || {
    cat "$log" >&2
    echo "package: cpack failed; its message is above" >&2
    exit 1
}
ls -sh1 build/release/packages/*.deb build/release/packages/*.tar.gz
echo "Next: apt install ./build/release/packages/isoatlas_*.deb"
