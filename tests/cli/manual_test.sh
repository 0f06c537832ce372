#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# The manual page and the completion of bash have every command and option that the program has. Usage: manual_test.sh ESTAMPE
set -euo pipefail
estampe="$1"
# shellcheck source=tests/support/harness.sh
source "$(dirname "${BASH_SOURCE[0]}")/../support/harness.sh"

"$estampe" --man >"$folder/estampe.1"
groff -man -ww -Tascii -P-bcou "$folder/estampe.1" >"$folder/page" 2>"$folder/warnings"
[[ ! -s "$folder/warnings" ]] || wrong "the manual page: $(cat "$folder/warnings")"
# shellcheck disable=SC1090 # the script under test
source <("$estampe" --completion)

# compopt works only while bash completes
compopt() { :; }
# complete_at WORD...: what bash offers for the last word
complete_at() {
    COMP_WORDS=(estampe "$@")
    COMP_CWORD=$#
    _estampe
    printf '%s\n' ${COMPREPLY[@]+"${COMPREPLY[@]}"} | sort
}
# offers WANTED WORD...
offers() {
    local wanted="$1"
    shift
    complete_at "$@" | grep -qxF -e "$wanted" || wrong "$* is not completed to $wanted but to: $(complete_at "$@" | tr '\n' ' ')"
}
# offers_not UNWANTED WORD...
offers_not() {
    local unwanted="$1"
    shift
    ! complete_at "$@" | grep -qxF -e "$unwanted" || wrong "$* is completed to $unwanted"
}

# names_below TITLE: first words of the indented lines under that title of a help text on stdin
names_below() { awk -v title="$1" '$0 == title ":" { on = 1; next } /^[^ ]/ || NF == 0 { on = 0 } on && /^  [^ ]/ { print $1 }'; }
# check_command WORD...: it and all below it
check_command() {
    local name option help
    help="$("$estampe" "$@" --help)"
    for option in $(awk '/^  -/ { sub(/   .*/, ""); print }' <<<"$help" | grep -oE '(^|[ ,])--?[a-z-]+' | tr -d ' ,'); do
        grep -qE -e "^ +(-., )?$option\b|^ +$option," "$folder/page" || wrong "the manual page lacks $option of estampe $*"
        offers "$option" "$@" "$option"
    done
    for name in $(names_below Commands <<<"$help"); do
        offers "$name" "$@" ""
        grep -qE "^ +estampe( [a-z]+)? $name( |$)" "$folder/page" || wrong "the manual page lacks $name"
        check_command "$@" "$name"
    done
}
check_command

cd "$folder"
mkdir scenes
touch fox.glb house.obj notes.txt mine.toml light.exr
for word in fox.glb house.obj scenes; do offers $word render ""; done
offers_not notes.txt render ""
offers pencil styles pen
offers fox.glb render -o a.png f
offers notes.txt info n
offers pencil render fox.glb --style pen
offers pencil render fox.glb --style = pen
offers comic+no-color render fox.glb --style comic+no
offers_not no-color render fox.glb --style no
offers mine.toml render fox.glb --style ""
offers_not fox.glb render fox.glb --style ""
offers hatch.width_mm= render --set hatch.wid
offers hardware render --raster ""
offers contour render --help-style con
offers all --help-style al
offers -z info --up ""
offers three-quarter render --view t
offers obj bake --input-format o
offers light.exr render --lightmap ""
offers temple render te
offers temple info te
offers_not temple render -o te
offers weather= view temple --world we
offers_not --samples info --
[[ $failures -eq 0 ]]
