#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# The ground in the viewer's hands: typed, saved, dropped and played, by real keys and pointer on a virtual display.
# Usage: ground_test.sh ESTAMPE MAKE_EXAMPLE HAND     the program, the one that writes example scenes, the one that drops files
set -euo pipefail
estampe="$(realpath "$1")"
make_example="$(realpath "$2")"
here="$(realpath "$(dirname "${BASH_SOURCE[0]}")")"
hand="$(realpath "$3")"
# shellcheck source=tests/support/harness.sh
source "$here/../support/harness.sh"
cd "$folder"
# shellcheck source=tests/support/viewer.sh
source "$here/../support/viewer.sh"
size=800x500
camera='eye=0,14,0 target=20,9,20 fov=50'
picture=320x466+0+0 # beside the tab of the ground

# click X Y [TIMES]: in the window
click() {
    xdotool mousemove --window "$window" "$1" "$2"
    sleep 0.1
    xdotool click --repeat "${3:-1}" --delay 60 1
    sleep 0.1
}
type_text() { xdotool type --delay 40 "$1"; }
# written A B: A is or soon becomes what B is
written() {
    for ((i = 0; i < 50; ++i)); do
        cmp -s "$1" "$2" || sleep 0.1
    done
}
# shows FILE [OPTION...]: the window shows, or soon does, what estampe render makes of the file
shows() {
    local file="$1"
    shift
    "$estampe" render "$file" --camera "$camera" --device cpu --size 320x466 "$@" -o drawn.png >/dev/null
    shot window
    same drawn window "$picture"
}

cat >sea.toml <<'END'
# A small sea of sand
[terrain]
height = "swell + great" # in metres

[nodes]
swell = "3 * fbm(120, octaves = 2)"
great = "dunes(30, 4, celerity = 0.5)" # they go

[mesh]
cells = 32
reach_m = 4000
END
open_viewer sea.toml --camera "$camera"
xdotool key Tab
sleep 0.5
click 578 20
await 'refined'
shows sea.toml

# What is typed is drawn, at last as estampe render does.
click 700 153
xdotool key End
skip
type_text ' * 2'
await 'refined'
sed 's/celerity = 0.5)/& * 2/' sea.toml >higher.toml
shows higher.toml

# What makes no sense is said in red, and the last good ground stays. It cannot be saved.
type_text '+ fmb(3)'
sleep 0.3
shot wrong
same drawn wrong "$picture"
red="$(convert wrong.png -crop 320x20+440+144 +repage -fill black +opaque 'srgb(247,204,194)' -fill white \
    -opaque 'srgb(247,204,194)' -format '%[fx:int(mean*w*h)]' info:)"
[[ $red -gt 2000 ]] || wrong "what is wrong is not red: $red pixels"
cp sea.toml before.toml
xdotool key ctrl+s
sleep 5.5 # what is said of it goes
cmp -s sea.toml before.toml || wrong "what makes no sense was saved"

# It is undone, then what made sense; and both are done again.
click 352 68
shows higher.toml
click 352 68
shows before.toml
click 405 68
shows higher.toml

# Saved with its comments, as it is drawn
xdotool key ctrl+s
written sea.toml higher.toml
cmp sea.toml higher.toml || wrong "it was saved as $(cat sea.toml)"

# A part that is called otherwise; one more; one less
click 368 153
xdotool keydown ctrl keydown a
sleep 0.2
xdotool keyup a keyup ctrl
type_text 'big'
shows higher.toml
click 356 178
shows higher.toml
click 778 178
xdotool key ctrl+s
sed -i 's/^great =/big =/; s/swell + great/swell + big/' higher.toml
written sea.toml higher.toml
cmp sea.toml higher.toml || wrong "it was saved as $(cat sea.toml)"

# Saved by others it is read again; broken, it leaves the last.
skip
sed -i 's/120/60/' sea.toml
await 'terrain changed'
shows sea.toml
skip
cp sea.toml good.toml
sed -i 's/fbm/fmb/' sea.toml
await 'terrain changed'
sleep 0.5
shot broken
same drawn broken 320x300+0+166
[[ "$(differing drawn broken 320x150+0+0)" -gt 1000 ]] || wrong "nothing is said of a broken file"
skip
cp good.toml sea.toml
await 'terrain changed'
shows sea.toml

# Triangles are chosen while it is seen.
click 560 233
click 640 258
click 560 303
sed 's/^cells = /method = "grid"\n&/' sea.toml >grid.toml
shows grid.toml
click 352 68
shows sea.toml

# Time goes on, and with it the dunes.
xdotool mousemove --window "$window" 160 300
shot before
skip
xdotool key space
for ((i = 0; i < 10; ++i)); do
    await 'picture 0'
done
skip
xdotool key space
await 'refined'
shot after
[[ "$(differing before after "$picture")" -gt 500 ]] || wrong "the dunes stand still"
close_viewer

# A ground that is dropped is put under the scene.
"$make_example" statue.glb statue >/dev/null
open_viewer statue.glb
skip
"$hand" "$window" drop good.toml || wrong "the window does not take a terrain"
await 'shows statue.glb'
await 'refined'
"$estampe" render statue.glb --terrain good.toml --device cpu --size 800x466 -o drawn.png >/dev/null
shot window
same drawn window 800x466+0+0
close_viewer

if [[ $failures -gt 0 ]]; then
    [[ -z ${ESTAMPE_KEEP:-} ]] || cp -r "$folder" "$ESTAMPE_KEEP"
    exit 1
fi
echo "The ground does what it is asked."
