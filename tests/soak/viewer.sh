#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# A viewer in which keys, pointer, sizes and dropped files come in any order, for as long as the round lasts: it stays,
# and neither its memory nor its open files grow.
# Usage: viewer.sh BUILD_FOLDER SEED SECONDS
set -euo pipefail
# shellcheck source=tests/soak/support.sh
source "$(dirname "${BASH_SOURCE[0]}")/support.sh"
# shellcheck source=tests/support/viewer.sh
source "$here/../support/viewer.sh"

most_growth_kib=98304
most_more_files=8
"$bin/estampe_example_square" scene.glb >/dev/null
"$bin/estampe_example_square" statue.glb statue >/dev/null
cp "$here/../../presets/comic.toml" "$here/../../presets/pencil.toml" .

# act: something that a hand does
act() {
    local x=$((RANDOM % 600 + 20)) y=$((RANDOM % 300 + 60))
    case $((RANDOM % 10)) in
    0) xdotool key "$(one_of Return 1 3 7 9 5 bracketright bracketleft Tab b ctrl+z m Next Up t u)" ;;
    1) xdotool mousemove --window "$window" $x $y mousedown 1 mousemove --window "$window" $((x / 2 + 90)) $y mouseup 1 ;;
    2) xdotool mousemove --window "$window" $x $y click "$(one_of 4 5)" ;;
    3) xdotool windowsize "$window" $((RANDOM % 400 + 330)) $((RANDOM % 300 + 210)) ;;
    4) "$bin/estampe_window_hand" "$window" drop "$(one_of scene.glb statue.glb)" || true ;;
    5) "$bin/estampe_window_hand" "$window" drop "$(one_of comic.toml pencil.toml)" || true ;;
    6) xdotool key f keydown w && pause_ms 200 && xdotool keyup w key f ;;
    7) touch scene.glb comic.toml ;;
    8) pause_ms 300 ;;
    9) xdotool key question key question ;;
    esac
}

# settle: the first scene and style at the first size
settle() {
    xdotool windowsize "$window" 640 400
    sleep 1
    skip
    "$bin/estampe_window_hand" "$window" drop scene.glb comic.toml || wrong "the window does not take the scene"
    await 'shows .*scene.glb'
    await 'refined'
    sleep 1
}

open_viewer scene.glb --style comic.toml
# Pictures of other sizes lie elsewhere in the blocks of device memory, each 64 MiB, until all pages of these blocks are
# resident; that takes about a hundred sizes, and is no leak.
for ((i = 0; i < 120; ++i)); do
    xdotool windowsize "$window" $((RANDOM % 400 + 330)) $((RANDOM % 300 + 210))
    sleep 0.15
done
memory=() # after each turn; the first two turns fill caches of scenes, styles and pipelines
first_files=0
# least_kib FIRST COUNT: the least memory after some of the turns. What a picture needs comes and goes; what leaks raises
# the least.
least_kib() { printf '%s\n' "${memory[@]:$1:$2}" | sort --numeric-sort | head -n 1; }
for ((turn = 0; (SECONDS < end_s || turn < 4) && failures == 0; ++turn)); do
    for ((i = 0; i < 25; ++i)); do
        act || true # a window that has ended is found below
    done
    settle
    kill -0 "$viewer" 2>/dev/null || { wrong "the viewer has ended: $(tail -5 log)"; break; }
    memory+=("$(memory_kib "$viewer")")
    now_files="$(files_of "$viewer")"
    ((turn > 1)) || first_files=$now_files
    ((now_files <= first_files + most_more_files)) || wrong "open files grow from $first_files to $now_files"
done
half=$(((${#memory[@]} - 2) / 2))
if ((half > 0 && failures == 0)); then
    first_kib="$(least_kib 2 $half)"
    last_kib="$(least_kib $((2 + half)) $half)"
    ((last_kib <= first_kib + most_growth_kib)) || wrong "memory grows from $first_kib to $last_kib KiB: ${memory[*]}"
fi
! grep -i 'bad_alloc\|terminate' log || wrong "the viewer says so"
# Escape closes what is open, one after the other, and then the viewer.
for ((i = 0; i < 40; ++i)); do
    kill -0 "$viewer" 2>/dev/null || break
    xdotool key Escape
    sleep 0.25
done
kill -0 "$viewer" 2>/dev/null && wrong "the viewer does not close"
status=0
wait "$viewer" || status=$?
viewer=
[[ $status -eq 0 ]] || wrong "the viewer ends with $status: $(tail -5 log)"
expect_no_parts .
echo "viewer: $turn turns, memory ${first_kib:-0} to ${last_kib:-0} KiB, open files $first_files to ${now_files:-0}"
[[ $failures -eq 0 ]]
