#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Films by the built program: their frames, what stops them, and how they go on.
# Usage: film_test.sh ESTAMPE MAKE_EXAMPLE     the program, and the one that writes the example scene
set -euo pipefail
estampe="$(realpath "$1")"
make_example="$(realpath "$2")"
# shellcheck source=tests/support/harness.sh
source "$(dirname "${BASH_SOURCE[0]}")/../support/harness.sh"
cd "$folder"

# draw ARGUMENT...: a film of the example scene; status in $status, what it says in said
draw() {
    status=0
    "$estampe" render scene.glb --size 96x54 --device cpu --turntable "$@" >printed 2>said || status=$?
}

# says PATTERN: the last run failed with these words
says() {
    [[ $status -ne 0 ]] || wrong "no failure where '$1' was expected"
    grep -q "^estampe: error: .*$1" said || wrong "no '$1' in: $(cat said)"
}

frames_of() {
    ffprobe -v error -count_frames -show_entries stream=nb_read_frames -of csv=p=0 "$1"
}

"$make_example" scene.glb >/dev/null

# A film whole, and in two runs
count=72
draw -o whole.mp4 --frames $count
[[ $status -eq 0 && "$(frames_of whole.mp4)" -eq $count ]] || wrong "whole.mp4: $(cat said)"
[[ ! -e whole.mp4.partial ]] || wrong "frames of a whole film are left"

# stop_after NUMBER ARGUMENT...: sends SIGINT to a film once it has drawn this frame; the last frame drawn in $at
stop_after() {
    local frame
    frame="$(printf '%06d' "$1")"
    draw -o stopped.mp4 --frames $count "${@:2}" &
    while [[ ! -e stopped.mp4.partial/$frame.png ]]; do
        kill -0 $! 2>/dev/null || break
        sleep 0.02
    done
    pkill -INT -P $! || true
    wait $! || true
    at="$(sed -n 's/.*stopped after frame \([0-9]*\) of.*/\1/p' said)"
    [[ "${at:-0}" -ge $1 && "${at:-0}" -lt $count ]] || wrong "was not stopped after $1: $(cat said)"
    [[ "$(frames_of stopped.mp4)" -eq "${at:-0}" ]] || wrong "a film that was stopped has not the frames drawn"
}

stop_after 4
# Wherever the signal comes, what was drawn is gone on with
for _ in 1 2 3; do
    before=$at
    stop_after $((at + 3)) --resume
    grep -q "goes on with frame $((before + 1))" said || wrong "begins anew: $(cat said)"
done
draw -o stopped.mp4 --frames $count --resume --set hatch.width_mm=0.7
says "drew something else"
draw -o stopped.mp4 --frames $((count + 8)) --resume
says "drew something else"
draw -o stopped.mp4 --frames $count --resume
[[ $status -eq 0 ]] || wrong "does not go on: $(cat said)"
grep -q "goes on with frame $((at + 1))" said || wrong "begins anew: $(cat said)"
cmp whole.mp4 stopped.mp4 || wrong "a film in two runs is another"
[[ ! -e stopped.mp4.partial ]] || wrong "frames are left"

# A texture that changes between two runs
printf 'mtllib painted.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nusemtl paint\nf 1/1 2/2 3/3\n' >painted.obj
printf 'newmtl paint\nmap_Kd painted.png\n' >painted.mtl
"$estampe" render scene.glb -o painted.png --size 8x8 >/dev/null 2>&1
paint() { status=0; "$estampe" render painted.obj --turntable --size 64x48 "$@" >said 2>&1 || status=$?; }
paint -o painted.mp4 --frames 4000 &
while [[ ! -e painted.mp4.partial/000002.png ]]; do
    kill -0 $! 2>/dev/null || break
    sleep 0.02
done
pkill -INT -P $! || true
wait $! || true
"$estampe" render scene.glb -o painted.png --size 9x9 >/dev/null 2>&1
paint -o painted.mp4 --frames 4000 --resume
says "drew something else"
rm -rf painted.mp4 painted.mp4.partial

# Numbered pictures, and the same frames wherever a range begins
draw -o 'frames/%03d.png' --frames 3-5
[[ "$(ls frames)" == "003.png"$'\n'"004.png"$'\n'"005.png" ]] || wrong "frames/: $(ls frames)"

# Mistakes
cp painted.png 07.png
sed -i 's/painted.png/07.png/' painted.mtl
paint -o '%02d.png' --frames 7
says "the film would overwrite an input"
draw -o 'none/none/%d.png' --frames 2
says "no such folder"
for range in 0 5-4 x 1- -3 1000001; do
    draw -o film.mp4 --frames=$range
    says "neither a number of frames"
done
draw -o film.mp4 --fps 0
says "fps"
draw -o film.png
says "goes with films alone"
draw -o film.mp4 --repeat 3
says "does not go with films"
"$estampe" render scene.glb -o film.mp4 --camera auto 2>said && wrong "a film without a length"
grep -q "nothing in the scene moves" said || wrong "no word on what does not move: $(cat said)"
PATH="$folder" draw -o film.mp4 --frames 2
says "install"
[[ ! -e film.mp4 && ! -e film.mp4.partial ]] || wrong "a film that failed left something: $(ls)"

[[ $failures -eq 0 ]] || exit 1
