# shellcheck shell=bash
# For scripts that make calls, sourced: paths as the user who called make means them (CALLER is where that was).

[[ -d ${CALLER:-} ]] || CALLER=$PWD
# as_meant PATH: absolute; ~ replaced where the shell left it (NAME=~/x, in all but bash).
as_meant() {
    local path=$1
    # shellcheck disable=SC2088
    if [[ $path == "~" || $path == "~/"* ]]; then path=$HOME${path:1}; fi
    [[ $path == /* ]] || path=$CALLER/$path
    printf '%s\n' "$path"
}
