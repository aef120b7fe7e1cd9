#!/usr/bin/env bash
# Run by CTest: the Debian package on a bare Debian 12, where it is installed, used and removed without a trace.
#   package_on_bare_root.sh SOURCE BUILD WORK PACKAGES     PACKAGES: the folder with isoatlas_*.deb
# ISOATLAS_BARE_ROOT=full: also libisoatlas-dev, with a program that finds it (300 MB of packages: compiler, cmake, libraries).
set -euo pipefail
source=$1 build=$2 work=$3 packages=$4
bare=$source/scripts/bare_root.sh

rm -rf --one-file-system "$work"
mkdir -p "$work"
trap 'rm -rf --one-file-system "$work"' EXIT
root=$work/root
started=$SECONDS
"$bare" root "$root" >"$work/said" 2>&1 || {
    code=$?
    cat "$work/said"
    [[ $code == 77 ]] || exit 1
    echo "SKIPPED: $(sed -n '$s/^bare_root: //p' "$work/said")"
    exit 0
}
step() { echo "$1: $((SECONDS - started)) s"; started=$SECONDS; }
inside() { "$bare" run "$root" "$@"; }
# install PACKAGES: with what apt install brings by default; says how much that was.
installed=""
install() {
    inside sh -c "cd /packages && DEBIAN_FRONTEND=noninteractive apt-get -q install --yes $1" >"$work/said" 2>&1 || { tail -n 40 "$work/said"; exit 1; }
    installed+=" $(sed -E 's|\./([a-z-]*)_\S*|\1|g' <<<"$1")"
    sed -nE 's/^[0-9]+ upgraded, ([0-9]+) newly.*/  \1 packages/p; s|^Need to get ([^/]*/)?(.* of archives).*|  \2|p; s/^After this operation, (.*) of additional.*/  \1 on the disk/p' "$work/said"
    step "apt install $1"
}
fail() { echo "$1" && exit 1; }
# All that lies in the root but what dpkg, apt, ldconfig and debconf remember of any package.
files() {
    (cd "$root" && find . -xdev ! -path './proc/*' ! -path './dev/*' ! -path './packages*' ! -path './var/lib/dpkg/*' ! -path './var/lib/apt/*' \
        ! -path './var/cache/apt/*' ! -path './var/cache/debconf/*' ! -path './var/cache/ldconfig/*' ! -path './var/log/apt/*' \
        ! -path './var/log/dpkg.log' ! -path './var/log/alternatives.log' -printf '%y %p\n' | sort)
}
step "a bare root"

echo force-unsafe-io >"$root/etc/dpkg/dpkg.cfg.d/unsafe-io"  # a root for some seconds needs no flushed files
# What is there is up to date, so that nothing but the package brings other files.
inside sh -c 'apt-get -q update && DEBIAN_FRONTEND=noninteractive apt-get -q upgrade --yes' >"$work/said" 2>&1 ||
    { tail -n 40 "$work/said" && fail "apt-get update or upgrade failed"; }
step "package lists, upgrades"
mkdir "$root/packages"
cp "$packages"/isoatlas_*.deb "$root/packages/"
files >"$work/before"
install "./isoatlas_*.deb"

# What the program keeps for its user (the link of a viewer) is the user's and stays: here that is in /packages too.
# shellcheck disable=SC2016
inside env HOME=/packages bash -euo pipefail -c '
cd /packages
said() { "$@" 2>errors || { cat errors >&2 && exit 1; }; }
said isoatlas phantom demo --size 40 -o demo.nrrd >/dev/null
said isoatlas demo.nrrd --top 2 >/dev/null
test -s demo.atlas.html
said isoatlas objects demo.nrrd | grep -q largest
said isoatlas extract demo.nrrd --object 1 -o surface.ply >/dev/null
said isoatlas verify surface.ply | grep -q "all 8 guarantees hold"
grep -q "^.SH NAME" /usr/share/man/man1/isoatlas.1
source /usr/share/bash-completion/completions/isoatlas
complete -p isoatlas >/dev/null
test -s /usr/share/zsh/vendor-completions/_isoatlas
test -s /usr/share/fish/vendor_completions.d/isoatlas.fish
# The viewer: its page, asked by hand; then Ctrl-C.
set -m
: >viewer
isoatlas view demo.atlas --no-browser --json >viewer 2>viewer.errors &
viewer=$!  # %1 is forgotten as soon as the shell has said that it is done, a number is not
port=""
while [[ -z $port ]] && kill -0 $viewer 2>/dev/null; do
    sleep 0.1
    port=$(sed -nE "s/.*\"port\": ?([0-9]+).*/\1/p" viewer)
done
[[ -n $port ]] || { cat viewer viewer.errors && exit 1; }
said isoatlas ask $port /api/atlas >answer
grep -q isovalue answer
kill -INT $viewer
wait $viewer
' 2>&1 || fail "the installed program does not do what it should; its last words are above"
step "a page, a table, a surface, the viewer"

if [[ ${ISOATLAS_BARE_ROOT:-} == full ]]; then
    (cd "$work" && cpack --config "$build/CPackConfig.cmake" -G DEB -B "$work/development" \
        -D CPACK_COMPONENTS_ALL="core;formats;store;measures;render;server;phantom;verify;methods;umbrella;package") >"$work/said" 2>&1 || { tail -n 40 "$work/said"; exit 1; }
    cp "$work"/development/libisoatlas-dev_*.deb "$root/packages/"
    cp -r "$source/tests/install/consumer" "$root/packages/"
    step "libisoatlas-dev made"
    install "./libisoatlas-dev_*.deb g++ cmake make"
    inside sh -euc 'cmake -S /packages/consumer -B /packages/built && cmake --build /packages/built && cd /packages && built/consumer /packages/demo.nrrd' \
        >"$work/said" 2>&1 || { tail -n 40 "$work/said"; fail "find_package(isoatlas) of the installed package does not work"; }
    tail -n 1 "$work/said"
    step "a program that finds the library"
fi

# Also what only a package of the bare system recommends (apt: ca-certificates).
inside sh -c "export DEBIAN_FRONTEND=noninteractive; apt-get -q purge --yes $installed && \
    apt-get -q -o APT::AutoRemove::RecommendsImportant=false autoremove --purge --yes" >"$work/said" 2>&1 ||
    { tail -n 40 "$work/said"; fail "the package cannot be removed"; }
files | diff "$work/before" - >"$work/left" || { head -n 60 "$work/left"; fail "apt purge and autoremove left this behind (>) or took it away (<)"; }
step "removed without a trace"
