#!/usr/bin/env bash
# A bare Debian 12 (debootstrap, minbase) with the mirrors and the proxy of this machine's apt. Only root can make one.
#   scripts/bare_root.sh root FOLDER                   makes it; kept in ~/.cache/isoatlas, so that the next takes seconds
#   scripts/bare_root.sh run FOLDER COMMAND...         runs a command in it; all that the command leaves running ends with it
#   scripts/bare_root.sh make TARGET [NAME=VALUE...]   `make TARGET` of a clone of the last commit in a new one, as a newcomer runs it;
#                                                      says seconds, packages, megabytes. ISOATLAS_KEEP=1 keeps the folder
# Exit 77: not possible here; the message says why.
set -euo pipefail
release=bookworm

cannot() { echo "bare_root: $1" >&2 && exit 77; }

# URI, suite and component of each Debian archive that apt of this machine uses.
archives() {
    # shellcheck disable=SC2016
    apt-get indextargets --format '$(REPO_URI) $(RELEASE) $(COMPONENT)' | awk -v release="^$release" '$2 ~ release && $3 == "main"' | sort -u
}

# keep_root MIRROR TAR: a new root, as archive.
keep_root() {
    local mirror=$1 kept=$2 work extra=()
    command -v debootstrap >/dev/null || cannot "debootstrap is not installed (apt-get install debootstrap)"
    [[ $mirror != https:* ]] || extra=(--include=ca-certificates)
    work=$(mktemp -d)
    # shellcheck disable=SC2064
    trap "rm -rf --one-file-system '$work'" EXIT
    echo "making a bare Debian 12 (about a minute) ..."
    http_proxy=${http_proxy:-$(apt-config shell proxy Acquire::http::Proxy | sed "s/^proxy='\(.*\)'$/\1/")} \
        debootstrap --variant=minbase "${extra[@]}" $release "$work/root" "$mirror" >"$work/log" 2>&1 || {
        tail -n 20 "$work/log" "$work/root/debootstrap/debootstrap.log" 2>/dev/null >&2
        echo "bare_root: debootstrap failed; its message is above" >&2
        exit 1
    }
    chroot "$work/root" apt-get clean
    mkdir -p "$(dirname "$kept")"
    tar -C "$work/root" -cf - . | gzip -1 >"$kept.$$"
    mv "$kept.$$" "$kept"
    rm -rf --one-file-system "$work"
    trap - EXIT
}

make_root() {
    local folder=$1 kept=${XDG_CACHE_HOME:-$HOME/.cache}/isoatlas/bare_root_$release.tar.gz known mirror asked
    [[ $(id -u) == 0 ]] || cannot "only root can make a bare root"
    command -v apt-get >/dev/null || cannot "there is no apt-get here"
    known=$(archives)
    mirror=$(awk -v release=$release '$2 == release { print $1; exit }' <<<"$known")
    [[ -n $mirror ]] || cannot "apt of this machine knows no archive of Debian 12"
    unshare --mount --pid --fork true 2>/dev/null || cannot "root may not mount anything here"
    asked=$(mktemp -d)
    /usr/lib/apt/apt-helper -q -o Acquire::Retries=0 download-file "${mirror%/}/dists/$release/Release" "$asked/Release" >/dev/null 2>&1 ||
        { rm -r "$asked" && cannot "no network: the archive of Debian does not answer"; }
    rm -r "$asked"
    [[ ! -e $folder ]] || { echo "bare_root: $folder exists; name a new folder" >&2 && exit 2; }
    [[ -s $kept ]] || keep_root "$mirror" "$kept"
    mkdir -p "$folder"
    tar -C "$folder" -xzf "$kept"
    awk '{ print "deb " $0 }' <<<"$known" >"$folder/etc/apt/sources.list"
    apt-config dump | grep -E '^Acquire::(https?|Check)' | grep -v Auto-Detect >"$folder/etc/apt/apt.conf.d/99machine" || true
    cp -L /etc/resolv.conf /etc/hosts "$folder/etc/"
    printf '#!/bin/sh\nexit 101\n' >"$folder/usr/sbin/policy-rc.d"  # packages start no services
    chmod +x "$folder/usr/sbin/policy-rc.d"
}

# What is mounted is mounted for these processes only, which end with the first.
run_in() {
    local folder=$1 settings=(HOME=/root "TERM=${TERM:-dumb}" LC_ALL=C.UTF-8 PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin) name
    shift
    for name in http_proxy https_proxy no_proxy HTTP_PROXY HTTPS_PROXY NO_PROXY CI ISOATLAS_YES npm_config_registry NODE_EXTRA_CA_CERTS; do
        [[ -z ${!name:-} ]] || settings+=("$name=${!name}")
    done
    # shellcheck disable=SC2016
    unshare --mount --pid --fork --kill-child env -i "${settings[@]}" sh -c '
        mount -t proc proc "$0/proc" && mount -t devpts -o newinstance,ptmxmode=0666 devpts "$0/dev/pts" &&
        mount -t tmpfs tmpfs "$0/dev/shm" && exec chroot "$0" "$@"' "$folder" "$@"
}

megabytes() { du -scmx "$@" 2>/dev/null | tail -n 1 | cut -f1; }
packages_in() { chroot "$1" dpkg-query -W -f '.\n' | wc -l; }

make_target() {
    local here folder code=0 before packages
    here=$(cd "$(dirname "$0")/.." && pwd)
    folder=$(mktemp -d)/root
    make_root "$folder"
    # shellcheck disable=SC2064
    [[ -n ${ISOATLAS_KEEP:-} ]] || trap "rm -rf --one-file-system '$(dirname "$folder")'" EXIT
    if command -v npm >/dev/null; then
        npm_config_registry=${npm_config_registry:-$(npm config get registry)}
    fi
    if [[ -r ${NODE_EXTRA_CA_CERTS:-} ]]; then
        cp -L "$NODE_EXTRA_CA_CERTS" "$folder/etc/machine.crt"
        export NODE_EXTRA_CA_CERTS=/etc/machine.crt
    fi
    git clone --quiet --no-local "$here" "$folder/isoatlas"
    before=$SECONDS packages=$(packages_in "$folder")
    local disk
    disk=$(megabytes "$folder")
    echo "== apt-get install git make ca-certificates"
    run_in "$folder" sh -c 'apt-get -q update && DEBIAN_FRONTEND=noninteractive apt-get -q install --yes git make ca-certificates' >"$folder/begin.log" 2>&1 ||
        { cat "$folder/begin.log" >&2 && exit 1; }
    local start=$((SECONDS - before))
    echo "== git and make: $start s, $(($(packages_in "$folder") - packages)) packages"
    echo "== make $*"
    before=$SECONDS packages=$(packages_in "$folder")
    run_in "$folder" make -C /isoatlas "$@" || code=$?
    echo "== make $*: exit code $code, $((SECONDS - before)) s on $(nproc) processors (load $(cut -d ' ' -f 1-3 /proc/loadavg))"
    echo "   $(($(packages_in "$folder") - packages)) more packages; downloaded: packages $(megabytes "$folder"/var/cache/apt/archives) MB," \
        "lists of packages $(megabytes "$folder"/var/lib/apt/lists) MB unpacked, npm $(megabytes "$folder"/root/.npm) MB"
    echo "   disk: $(megabytes "$folder") MB, of that bare Debian and clone $disk MB, build $(megabytes "$folder"/isoatlas/build) MB," \
        "downloads that may go $(megabytes "$folder"/var/cache/apt "$folder"/root/.npm) MB"
    [[ -z ${ISOATLAS_KEEP:-} ]] || echo "   kept: $folder"
    return $code
}

action=${1:-}
[[ $# -ge 2 ]] || { sed -n '2,8s/^# \{0,1\}//p' "$0" && exit 2; }
shift
case $action in
    root) make_root "$1" ;;
    run) run_in "$@" ;;
    make) make_target "$@" ;;
    *) echo "bare_root: '$action' is none of root, run, make" >&2 && exit 2 ;;
esac
