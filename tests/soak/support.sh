# shellcheck shell=bash disable=SC2034 # what sources this uses them
# SPDX-License-Identifier: MIT
# What the rounds of script/soak share. Each is called with BUILD_FOLDER SEED SECONDS, and ends with status 1 when it has
# found something. To be sourced with these arguments.
bin="$(realpath "$1")/bin"
layer="$(realpath "$1")/layer"
here="$(realpath "$(dirname "${BASH_SOURCE[0]}")")"
# shellcheck source=tests/support/harness.sh
source "$here/../support/harness.sh"
cd "$folder" || exit
estampe="$bin/estampe"
RANDOM=$2
end_s=$((SECONDS + $3))

# one_of WORD...: one of them by chance
one_of() { local words=("$@"); echo "${words[RANDOM % $#]}"; }

# pause_ms MOST: waits, by chance, up to so many milliseconds
pause_ms() {
    local ms=$(((RANDOM * 32768 + RANDOM) % ($1 + 1)))
    sleep "$((ms / 1000)).$(printf '%03d' $((ms % 1000)))"
}

# disturb MOST_MS COMMAND...: runs a command, and after a while of chance ends it by a signal of chance. Its status in
# $status, what it said in said.
disturb() {
    local most_ms="$1" signal
    shift
    signal="$(one_of INT TERM HUP KILL KILL)"
    "$@" >printed 2>said &
    local running=$!
    pause_ms "$most_ms"
    kill -"$signal" $running 2>/dev/null || true
    status=0
    { wait $running || status=$?; } 2>/dev/null # bash names the signal
    # 1: stopped in good order; else by the signal
    [[ $status -eq 0 || $status -eq 1 || $status -eq $((128 + $(kill -l "$signal"))) ]] ||
        wrong "status $status after SIG$signal: $*: $(tail -3 said)"
    [[ $status -ne 1 || $(grep -c '^estampe: error: ' said) -eq 1 ]] || wrong "not one line: $*: $(cat said)"
}

# expect_no_parts FOLDER: nothing temporary is left
expect_no_parts() {
    local left
    left="$(find "$1" -name '.*.part-*' -o -name '.estampe-*')"
    [[ -z $left ]] || wrong "left: $left"
}

# expect_same A B LABEL: two folders hold the same files
expect_same() { diff -r "$1" "$2" >differences || wrong "$3: $(head -5 differences)"; }

# memory_kib PROCESS, files_of PROCESS: resident memory, and open files
memory_kib() { awk '/^VmRSS:/ { print $2 }' "/proc/$1/status"; }
files_of() { find "/proc/$1/fd" -mindepth 1 2>/dev/null | wc -l; }
