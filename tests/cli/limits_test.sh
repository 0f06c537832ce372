#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# The options --max-memory and --max-seconds: what is refused or stopped, in which words, and what is left on disk.
# Usage: limits_test.sh ESTAMPE MAKE_EXAMPLE     the program, and the one that writes the example scene
set -euo pipefail
estampe="$(realpath "$1")"
make_example="$(realpath "$2")"
# shellcheck source=tests/support/harness.sh
source "$(dirname "${BASH_SOURCE[0]}")/../support/harness.sh"
cd "$folder"
"$make_example" scene.glb >/dev/null

there() { find . -mindepth 1 -maxdepth 1 ! -name out ! -name err ! -name before -printf '%f\n' | sort; }

# expect STATUS PATTERN ARGUMENT...: the program ends with STATUS, the last line of stderr matches, and the only new files
# are those that `left` names
expect() {
    local wanted="$1" pattern="$2" status=0
    shift 2
    there >before
    timeout 120 "$estampe" "$@" >out 2>err || status=$?
    [[ $status -eq $wanted ]] || wrong "$*: status $status instead of $wanted: $(cat err)"
    [[ -z $pattern ]] || tail -1 err | grep -q -- "$pattern" || wrong "$*: no '$pattern' in: $(cat err)"
    left="$(comm -13 before <(there))"
}
nothing_left() { [[ -z $left ]] || wrong "$*: left $left"; }
draw=(render scene.glb -o a.png --size 64x48 --device cpu)

# Words that are no limit
for each in x 0 -1 1X M '' 1e30G; do
    expect 2 '' "${draw[@]}" "--max-memory=$each"
done
for each in x 0 -1 nan; do
    expect 2 '' "${draw[@]}" "--max-seconds=$each"
done

# Enough of both
for each in 16G 16384M 16GiB 17179869184; do
    expect 0 '' "${draw[@]}" --max-memory "$each" --max-seconds 100
    rm -f a.png
done

# Memory: the file, its textures, the page, the lightmap
expect 1 'needs .* of memory beside the .* in use, more than 1 MiB, the limit of --max-memory' \
    "${draw[@]}" --max-memory 1M
nothing_left a small limit
expect 1 'drawing 8000 x 6000 pixels at once needs 7.2 GiB .*--max-memory; draw a smaller picture, or smaller tiles' \
    render scene.glb -o a.png --size 8000x6000 --tile 8000 --device cpu --max-memory 3G
nothing_left a large page
expect 1 'a lightmap of 4096 x 4096 texels needs 2.0 GiB' \
    bake scene.glb -o a.exr --size 4096 --samples 1 --max-memory 1G
nothing_left a large lightmap
# A picture of one bit a pixel, which is small as a file
python3 - <<'END'
import struct, zlib
def chunk(name, data):
    return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))
rows = zlib.compress(bytes(1 + 8000 // 8) * 8000)
with open("wide.png", "wb") as file:
    file.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", 8000, 8000, 1, 0, 0, 0, 0)))
    file.write(chunk(b"IDAT", rows) + chunk(b"IEND", b""))
END
printf 'newmtl m\nmap_Kd wide.png\n' >wide.mtl
printf 'mtllib wide.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nusemtl m\nf 1/1 2/1 3/1\n' >wide.obj
expect 0 '' bake wide.obj -o a.exr --size 16 --samples 1 --max-memory 250M
grep -q 'texture left white: ./wide.png.*--max-memory' err || wrong "a large texture: $(cat err)"
rm -f a.exr

# Time: a picture, a film that goes on, a batch, a lightmap that goes on
expect 1 'the work is not done after 0.001 s, the limit of --max-seconds; raise the limit' \
    "${draw[@]}" --samples 64 --max-seconds 0.001
nothing_left a picture
film=(render scene.glb --turntable --size 64x48 --device cpu -o)
expect 1 'a.mp4: stopped after frame [0-9]* of 5000: the time of --max-seconds is over; .*--resume' \
    "${film[@]}" a.mp4 --frames 5000 --max-seconds 4
[[ $left == a.mp4.partial ]] || wrong "a film left $left"
at="$(sed -n 's/.*stopped after frame \([0-9]*\) .*/\1/p' err)"
expect 1 'stopped after frame' "${film[@]}" a.mp4 --frames 5000 --max-seconds 4 --resume
grep -q "goes on with frame $((at + 1)) of 5000" err || wrong "a film does not go on: $(cat err)"
rm -rf a.mp4.partial
for i in 1 2 3 4 5 6 7 8; do
    printf '[[job]]\nscene = "scene.glb"\noutput = "job%s.png"\nsize = "640x480"\nsamples = 100\n' "$i"
done >jobs.toml
expect 1 'jobs.toml: stopped with [0-9] of 8 jobs not begun: the time of --max-seconds is over; jobs.report.json' \
    batch jobs.toml --device cpu --max-seconds 2
grep -q 'the limit of --max-seconds' jobs.report.json || wrong "no job was stopped: $(cat jobs.report.json)"
grep -q '"failed": 1' jobs.report.json || wrong "more than one job was stopped: $(cat jobs.report.json)"
[[ ! -e job8.png ]] || wrong "the last job was drawn"
rm -f job*
expect 1 'a.exr: stopped at .* %: the time of --max-seconds is over; the same command goes on from there' \
    bake scene.glb -o a.exr --size 1024 --samples 4096 --max-seconds 2
[[ $left == a.exr.partial ]] || wrong "a lightmap left $left"
expect 1 'stopped at' bake scene.glb -o a.exr --size 1024 --samples 4096 --max-seconds 2
grep -q 'goes on from' err || wrong "a lightmap does not go on: $(cat err)"

[[ $failures -eq 0 ]]
