#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# One long film: neither its memory nor its open files grow from frame to frame.
# Usage: memory.sh BUILD_FOLDER SEED SECONDS
set -euo pipefail
# shellcheck source=tests/soak/support.sh
source "$(dirname "${BASH_SOURCE[0]}")/support.sh"

most_growth_kib=32768
most_more_files=2
"$bin/estampe_example_square" scene.glb >/dev/null
mkdir frames
style="$(one_of comic flowing-ink pencil wash)"
"$estampe" render scene.glb -o 'frames/%d.png' --turntable --frames 100000 --style "$style" --size 96x64 --device cpu \
    >printed 2>said &
film=$!
first_kib=0
first_files=0
peak_kib=0
# The film is watched from its 20th frame on, when all caches are full; the median of several looks, because pictures
# that wait to be written come and go.
median_of() { sort --numeric-sort | awk '{ all[NR] = $1 } END { print all[int((NR + 1) / 2)] }'; }
look() {
    for ((i = 0; i < 9; ++i)); do
        "$1" $film
        sleep 0.1
    done | median_of
}
while [[ ! -e frames/20.png ]] && kill -0 $film 2>/dev/null; do sleep 0.1; done
if kill -0 $film 2>/dev/null; then
    first_kib="$(look memory_kib)"
    first_files="$(look files_of)"
fi
turns=0
while { ((SECONDS < end_s)) || ((turns < 2)); } && ((failures == 0)); do
    sleep 3
    kill -0 $film 2>/dev/null || { wrong "the film has ended: $(tail -3 said)"; break; }
    turns=$((turns + 1))
    now_kib="$(look memory_kib)"
    now_files="$(look files_of)"
    peak_kib="$(awk '/^VmHWM:/ { print $2 }' /proc/$film/status)"
    ((now_kib <= first_kib + most_growth_kib)) || wrong "memory grows from $first_kib to $now_kib KiB ($style)"
    ((now_files <= first_files + most_more_files)) || wrong "open files grow from $first_files to $now_files"
done
frames="$(find frames -name '*.png' | wc -l)"
kill -INT $film 2>/dev/null || true
status=0
wait $film || status=$?
[[ $status -eq 1 ]] || wrong "a film that is stopped ends with $status: $(tail -3 said)"
expect_no_parts frames
echo "memory: $frames frames in $style, memory $first_kib to ${now_kib:-0} KiB, peak $peak_kib KiB"
[[ $failures -eq 0 ]]
