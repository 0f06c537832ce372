#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# The viewer as a person uses it: real keys and pointer on a virtual display, and screenshots that are compared.
# Usage: viewer_test.sh ESTAMPE MAKE_EXAMPLE SOURCES HAND     the program, the one that writes the example scene, the tree,
# the one that drops files
set -euo pipefail
estampe="$(realpath "$1")"
make_example="$(realpath "$2")"
sources="$(realpath "$3")"
here="$(realpath "$(dirname "${BASH_SOURCE[0]}")")"
hand="$(realpath "$4")"
# shellcheck source=tests/support/harness.sh
source "$here/../support/harness.sh"
cd "$folder"

# Without a display it says so.
status=0
env -u DISPLAY -u WAYLAND_DISPLAY "$estampe" view 2>said || status=$?
[[ $status -eq 1 ]] || wrong "no display: $status"
grep -q '^estampe: error: there is no display' said || wrong "no display: $(cat said)"
status=0
"$estampe" view --no-such-option 2>said || status=$?
[[ $status -eq 2 ]] || wrong "wrong usage: $status"

# shellcheck source=tests/support/viewer.sh
source "$here/../support/viewer.sh"

"$make_example" scene.glb >/dev/null
cp "$sources/presets/comic.toml" mine.toml

# The first window of all compiles its shaders quickly, and has them compiled well for the next.
mkdir cache
export XDG_CACHE_HOME="$folder/cache"
unset MESA_SHADER_CACHE_DIR GALLIVM_PERF
open_viewer scene.glb --style mine.toml
grep -q 'compiled quickly' log || wrong "the first window takes its time to compile"
shot quick
for ((i = 0; i < 2400; ++i)); do
    [[ ! -s cache/estampe/compiled-well ]] || break
    sleep 0.05
done
[[ -s cache/estampe/compiled-well ]] || wrong "nothing was compiled for the next window"
close_viewer
status=0
"$estampe" view --warm-up 2>said || status=$?
[[ $status -eq 2 ]] || wrong "nothing to warm up for: $status"

open_viewer scene.glb --style mine.toml
! grep -q 'compiled quickly' log || wrong "the second window compiles anew"
shot first
same quick first

# The picture is that of the program, byte by byte, in the window and in the file.
"$estampe" render scene.glb --style mine.toml --device cpu --size 640x366 -o program.png
skip
xdotool key F12
await 'wrote scene-001.png'
cmp scene-001.png program.png || wrong "a screenshot is another picture than that of estampe render"
same program first

# Pointer and keys
skip
xdotool mousemove --window "$window" 300 180 mousedown 1 mousemove --window "$window" 360 200 mouseup 1
await 'refined'
shot turned
others first turned
key_then_picture Return
shot home
same first home 640x320+0+46
skip
xdotool mousemove --window "$window" 300 180 click 4 click 4
await 'refined'
shot nearer
others first nearer
key_then_picture 7
shot top
others nearer top
xdotool key question
shot keys
others top keys
xdotool key Escape
shot no_keys
same top no_keys 640x320+0+46
key_then_picture Return

# Walking goes on for as long as a key is held.
xdotool key f
skip
xdotool keydown w
await 'picture 0'
await 'picture 0'
xdotool keyup w
await 'refined'
shot flown
others first flown
xdotool key Escape
key_then_picture Return

# Bookmarks beside the scene
xdotool key m
key_then_picture 1
key_then_picture Next
shot bookmark
grep -q '"name": "View 1"' scene.glb.views.json || wrong "no bookmark was written"

# The style: search, change, undo; the panel takes its place from the picture
skip
xdotool key ctrl+f
await 'refined'
xdotool type --delay 5 'hatch.enabled'
shot panel
skip
xdotool mousemove --window "$window" 448 152 click 1
await 'refined'
shot no_hatch
others panel no_hatch 290x366+0+0
skip
xdotool mousemove --window "$window" 140 300 key ctrl+z
await 'refined'
shot undone
same panel undone 290x300+0+66
skip
xdotool mousemove --window "$window" 400 102 click --repeat 3 1
xdotool type --delay 5 'paper.height'
shot slider
skip
xdotool mousemove --window "$window" 470 152 mousedown 1
for x in 480 500 520; do
    xdotool mousemove --window "$window" $x 152
    await 'picture 0'
done
xdotool mouseup 1
await 'refined'
shot finer
others undone finer 290x300+0+66
skip
xdotool mousemove --window "$window" 140 300 key ctrl+z
await 'refined'
shot undone_drag
same undone undone_drag 290x300+0+66
skip
xdotool key bracketright
await 'refined'
shot other_preset
others panel other_preset 290x300+0+66
skip
xdotool key ctrl+z
await 'refined'
key_then_picture Tab

# A|B: the right half stays
xdotool key b
key_then_picture bracketright
shot compared
same first compared 200x250+420+110
others first compared 300x250+0+110
key_then_picture b
skip
xdotool key ctrl+z
await 'refined'

# Files that change are read again; a broken one keeps the last good and says why.
skip
echo 'this is no style' >mine.toml
await 'style changed'
shot broken
same first broken 300x200+320+120
skip
sed 's/^width_mm = .*/width_mm = 2.0/' "$sources/presets/comic.toml" >mine.toml
await 'refined'
cp scene.glb whole.glb
skip
head -c 5000 whole.glb >scene.glb
await 'failure: .*scene.glb'
skip
mv whole.glb scene.glb
await 'refined'

# What is dropped: a scene, a style, a tonal art map, both at once; what is broken changes nothing.
drop() { "$hand" "$window" drop "$@" || wrong "the window does not take $*"; }
drop_then_picture() {
    skip
    drop "$@"
    await 'refined'
}
"$make_example" statue.glb statue >/dev/null
cp "$sources/presets/pencil.toml" 'my 1st style, 100%.toml'
"$estampe" tam -o pen/ --set tam.size_px=64 --set tam.tones=4
shot square
drop_then_picture statue.glb
shot statue
others square statue
drop_then_picture 'my 1st style, 100%.toml'
shot pencil
others statue pencil
drop_then_picture pen
shot mapped
others pencil mapped
skip
head -c 3000 statue.glb >half.glb
drop half.glb
await 'failure: .*half.glb'
skip
echo 'no scene' >notes.txt
drop notes.txt
await 'failure: .*notes.txt'
echo '[hatch]' >wrong.toml
echo 'widht_mm = 1' >>wrong.toml
drop wrong.toml
shot kept
same mapped kept 640x146+0+220
skip
drop scene.glb mine.toml
await 'shows .*scene.glb'
await 'refined'

# Nothing is drawn for a window that is minimised; what changed meanwhile is there when it comes back.
skip
"$hand" "$window" minimise
sleep 0.3
cp "$sources/presets/pencil.toml" mine.toml
await 'style changed'
sleep 1
! tail -n +$((seen + 1)) log | grep 'picture 0' || wrong "a picture is drawn that nobody sees"
skip
"$hand" "$window" restore
await 'refined'
shot restored
"$estampe" render scene.glb --style mine.toml --device cpu --size 640x366 -o program.png
same program restored

# Sizes
skip
xdotool windowsize "$window" 500 320
await '500 x 286, 100 %.*refined'
close_viewer

# Shaders that are saved are drawn with; the moving view becomes a film; the layers of Vulkan have nothing to say.
mkdir -p tree/src
(cd "$sources" && find src -name '*.comp' -o -name '*.vert' -o -name '*.frag' -o -name '*.glsl' -o -name '*.glsl.h') |
    (cd "$sources" && xargs cp --parents -t "$folder/tree")
export VK_INSTANCE_LAYERS=VK_LAYER_KHRONOS_validation
export VK_LAYER_ENABLES=VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT
open_viewer scene.glb --shaders tree
unset VK_INSTANCE_LAYERS VK_LAYER_ENABLES
shot before
# A storm of sizes ends in the last one.
for ((i = 0; i < 60; ++i)); do
    xdotool windowsize "$window" $((330 + i * 37 % 500)) $((210 + i * 53 % 300))
done
skip
xdotool windowsize "$window" 620 390
await '620 x 356, 100 %.*refined'
skip
xdotool windowsize "$window" 640 400
await '640 x 366, 100 %.*refined'
shot after
same before after
shader=tree/src/techniques/paper/compose.comp
cp "$shader" kept
skip
echo 'broken' >>"$shader"
await 'shader compose_comp: .*compose.comp:[0-9]'
skip
sed '$d; ' kept >"$shader"
sed -i 's/^void main()/void main_of_before()/' "$shader"
tail -n 1 kept >>"$shader"
cat >>"$shader" <<'END'

void main() { main_of_before(); }
END
await 'shader compose_comp compiled'
await 'refined'
skip
xdotool key F10 mousemove --window "$window" 300 180 mousedown 1 mousemove --window "$window" 340 180
await 'picture 0'
xdotool mouseup 1 key F10
await 'wrote scene-001.mp4'
[[ "$(ffprobe -v error -show_entries stream=width,height -of csv=p=0 scene-001.mp4)" == 640,366 ]] ||
    wrong "the film has another size"
close_viewer
! grep -i 'validation\|VUID\|SYNC-' log || wrong "the validation layers have something to say"

# What takes long to read can be cancelled, and the window closed meanwhile.
awk 'BEGIN { n = 900
    for (i = 0; i <= n; ++i) for (j = 0; j <= n; ++j) print "v", i / n, 0.01 * (i * j % 7), j / n
    for (i = 0; i < n; ++i) for (j = 1; j <= n; ++j) { a = i * (n + 1) + j; b = a + n + 1
        print "f", a, a + 1, b + 1; print "f", a, b + 1, b } }' >large.obj
for way in cancel close; do
    : >log
    seen=0
    "$estampe" view large.obj --size 640x400 --device cpu --verbose >printed 2>log &
    viewer=$!
    await 'reads large.obj'
    window="$(xdotool search --sync --onlyvisible --name Estampe | head -1)"
    xdotool windowfocus --sync "$window"
    if [[ $way == cancel ]]; then
        xdotool key Escape
        await 'cancelled'
    fi
    close_viewer
    ! grep -q 'shows' log || wrong "what was cancelled is shown"
done

# A picture of many samples, which takes minutes, is given up for another and for the end; the other is seen quickly
# at first, even where one sample takes longer than a hand rests.
: >log
seen=0
"$estampe" view statue.glb --style engraving --set occlusion.enabled=true --size 1000x680 --samples 2000 --device cpu \
    --verbose >printed 2>log &
viewer=$!
await 'window with a picture'
window="$(xdotool search --sync --onlyvisible --name Estampe | head -1)"
xdotool windowfocus --sync "$window"
sleep 0.5
skip
begun=$SECONDS
xdotool key 7
await 'picture 0 of view 2'
close_viewer
((SECONDS - begun < 15)) || wrong "a picture of many samples holds up the next: $((SECONDS - begun)) s"

# A scene that cannot be read ends it before it begins.
status=0
"$estampe" view nowhere.glb --device cpu 2>said || status=$?
[[ $status -eq 1 ]] || wrong "a missing scene: $status"
grep -q 'nowhere.glb' said || wrong "a missing scene: $(cat said)"

if [[ $failures -gt 0 ]]; then
    [[ -z ${ESTAMPE_KEEP:-} ]] || cp -r "$folder" "$ESTAMPE_KEEP"
    exit 1
fi
echo "The viewer does what it is asked."
