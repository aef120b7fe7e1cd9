#!/usr/bin/env bash
# Reads what apt-get writes to APT::Status-Fd and says how far it is: apt_progress.sh PACKAGES DOWNLOAD, e.g. 472 "140 MB" (0 "" for lists).
# On a terminal a line that is rewritten; elsewhere a line for each tenth part, and every ten seconds.
set -euo pipefail
packages=$1
size=${2%% *}
unit=${2##* }
started=$SECONDS

columns=$(tput cols 2>/dev/null || echo 80)
told="" told_at=$SECONDS told_part=""
# say TEXT PART: PART changes when a line is due although ten seconds have not passed.
say() {
    if [[ -t 1 ]]; then
        text="  $1, $((SECONDS - started)) s"
        printf '\r%s\033[K' "${text:0:columns-1}"
    elif [[ $2 != "$told_part" ]] || ((SECONDS - told_at >= 10)); then
        printf '  %s, %d s\n' "$1" $((SECONDS - started))
        told_at=$SECONDS told_part=$2
    fi
    told=$1
}

fetched() {  # PERCENT
    if ((packages == 0)); then
        say "package lists: $1 %" "lists $(($1 / 10))"
        return
    fi
    local done=$((${size%.*} * $1 / 100)) files=$fetching
    if (($1 == 100)); then done=$size files=$packages; fi
    say "fetched $files of $packages packages, $done of $size $unit" "fetched $(($1 / 10))"
}

unpacked=0 installed=0 fetching=0
while true; do
    if IFS=: read -r -t 10 kind name percent what; then
        :
    elif (($? > 128)); then  # silent, but running
        [[ -z $told || -t 1 ]] || say "$told" "$told_part"
        continue
    else
        break
    fi
    percent=${percent%.*}
    case $kind:$what in
        dlstatus:*)
            fetching=$((name - 1))
            if ((fetching > packages)); then fetching=$packages; fi
            fetched "$percent"
            continue
            ;;
        pmstatus:Unpacking*) unpacked=$((unpacked + 1)) ;;
        pmstatus:Installed*) installed=$((installed + 1)) ;;
        *) continue ;;
    esac
    ((packages > 0)) || continue
    say "unpacked $unpacked, set up $installed of $packages packages" "installed $(((unpacked + installed) * 5 / packages))"
done
if [[ -t 1 && -n $told ]]; then echo; fi
