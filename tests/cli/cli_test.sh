#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Runs the built program on good and bad input and checks exit status, messages and what is left on disk.
# Usage: cli_test.sh ESTAMPE MAKE_EXAMPLE     the program, and the one that writes the example scene
set -euo pipefail
estampe="$(realpath "$1")"
make_example="$(realpath "$2")"
# shellcheck source=tests/support/harness.sh
source "$(dirname "${BASH_SOURCE[0]}")/../support/harness.sh"
name="$(basename "$folder")"
trap 'chmod -R u+w "$folder"; rm -rf "$folder" "$folder".out "$folder".err' EXIT
cd "$folder"

# expect_error STATUS PATTERN ARGUMENT...: ends with STATUS, says one line on stderr that matches PATTERN and nothing on
# stdout, and leaves the folder as it was.
expect_error() {
    local wanted="$1" pattern="$2" status=0 before after
    shift 2
    before="$(ls -lAR --time-style=full-iso .)"
    "$estampe" "$@" >../"$name".out 2>../"$name".err || status=$?
    after="$(ls -lAR --time-style=full-iso .)"
    [[ $status -eq $wanted ]] || wrong "estampe $*: status $status instead of $wanted"
    [[ "$(grep -cv '^estampe: warning: ' ../"$name".err)" -eq 1 ]] || wrong "estampe $*: not one line: $(cat ../"$name".err)"
    grep -q "^estampe: error: .*$pattern" ../"$name".err || wrong "estampe $*: no '$pattern' in: $(cat ../"$name".err)"
    [[ ! -s ../"$name".out ]] || wrong "estampe $*: printed on stdout: $(cat ../"$name".out)"
    [[ "$before" == "$after" ]] || wrong "estampe $*: changed files: $after"
}

# expect_success ARGUMENT...: ends with 0 and says no error; stdout goes to ../NAME.out
expect_success() {
    "$estampe" "$@" >../"$name".out 2>../"$name".err || wrong "estampe $*: $(cat ../"$name".err)"
    ! grep -q error ../"$name".err || wrong "estampe $*: $(cat ../"$name".err)"
}

# expect_printed PATTERN: the last success printed a line that matches
expect_printed() {
    grep -q -- "$1" ../"$name".out || wrong "no '$1' in: $(head -20 ../"$name".out)"
}

"$make_example" scene.glb >/dev/null
small=(--size 96x54 --device cpu)

# What it tells without drawing
expect_success --version
expect_printed '^estampe [0-9]'
expect_success --help
expect_printed '^  render '
expect_success --help-all
expect_printed 'Examples:'
expect_success render --help
expect_printed '--samples'
expect_success render --help-all
expect_printed 'Exit status'
expect_printed '^  --set KEY=VALUE  .*may be repeated'
expect_success --help-style
expect_printed 'help-style all'
[[ "$(wc -l <../"$name".out)" -le 40 ]] || wrong "--help-style prints more than a page"
expect_success --help-style all
expect_printed '^  [a-z_]*\.[a-z_]*  *number '
expect_printed '^contour: '
expect_success render --help-style hatch
expect_printed '^  hatch\.width_mm  *number '
! grep -q 'contour\.' ../"$name".out || wrong "--help-style hatch prints other sections"
expect_success render --help-style=hatch
expect_success render scene.glb --help-style
expect_error 2 '--help-style: no section "hach"; did you mean "hatch"' --help-style hach
expect_error 2 '--help-style: no section "zzzzzzz"; sections are' render --help-style zzzzzzz
expect_success styles
expect_printed '^pencil  *Soft grey strokes'
expect_success styles --schema
expect_printed '"margin_mm": {'
expect_success styles --sheet sheet.png --size 48x36 --device cpu scene.glb
[[ "$(head -c 4 sheet.png | tail -c 3)" == PNG ]] || wrong "styles --sheet wrote no PNG"
expect_error 1 'nowhere.glb' styles --sheet out.png nowhere.glb --device cpu
expect_error 2 'must end in .png' styles --sheet out.jpg --device cpu
expect_error 2 '--size requires --sheet' styles comic --size 96x54
expect_error 2 '' styles --sheet out.png --schema
expect_success devices
expect_printed 'raster: hardware'
expect_success devices --json
expect_printed '"compute_raster": true'
expect_success info temple
expect_printed 'camera  *"last hall"'
expect_printed 'world  *A half-buried temple'
expect_printed '--world  *weather=calm|gusts|storm|tornado'
expect_error 1 'no camera "nowhere"; .*"court"' render temple -o out.png --camera nowhere --seed 3 "${small[@]}"
expect_success info
expect_printed '^temple$'
expect_printed '--world  *hour=0..24'
expect_success info --json
expect_printed '"key": "weather"'
expect_success info temple --world seed=3 --json
expect_printed '"name": "temple"'
expect_success info scene.glb
expect_printed 'triangles  *[1-9]'
expect_printed '  light  *its own'
expect_success info scene.glb --json
expect_printed '"triangles": [1-9]'
expect_printed '"default_light": "scene"'

# A glTF with variants and a hidden node, and the same triangle lying on the ground of a z-up program
cat >variants.gltf <<'END'
{"asset": {"version": "2.0"}, "scenes": [{"nodes": [0, 1]}],
 "nodes": [{"mesh": 0}, {"mesh": 0, "extensions": {"KHR_node_visibility": {"visible": false}}}],
 "extensionsUsed": ["KHR_materials_variants", "KHR_node_visibility"],
 "extensions": {"KHR_materials_variants": {"variants": [{"name": "night"}, {"name": "storm"}]}},
 "materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}, {}],
 "textures": [{"source": 0}], "images": [{"uri": "oak.png"}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "material": 0,
   "extensions": {"KHR_materials_variants": {"mappings": [{"material": 1, "variants": [1]}]}}}]}],
 "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}],
 "bufferViews": [{"buffer": 0, "byteLength": 36}],
 "buffers": [{"byteLength": 36, "uri": "data:;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]}
END
cat >wedge.obj <<'END'
v 5 5 0
v 7 5 0
v 5 7 0
v 5 5 3
f 1 3 2
f 1 2 4
f 2 3 4
f 3 1 4
END
expect_success info variants.gltf
expect_printed 'variants  *night, storm'
expect_printed 'missing files  *oak.png'
expect_printed 'hidden nodes  *1'
expect_printed 'unit  *1 m'
expect_printed 'triangles drawn  *1$'
expect_success info variants.gltf --json
expect_printed '"up_axis_guess": null'
expect_printed '"storm"'
expect_error 1 'no variant "dusk"; variants of the scene: 0 "night", 1 "storm"' render variants.gltf -o a.png --variant dusk
expect_error 1 'the scene has no material variants' render wedge.obj -o a.png --variant night
expect_error 1 'the scene has no material variants' render temple -o a.png --variant night
expect_error 2 '--variant: is empty' render variants.gltf -o a.png --variant ''
expect_success render variants.gltf -o by-default.png "${small[@]}"
expect_success render variants.gltf -o storm.png --variant storm "${small[@]}"
expect_success info wedge.obj
expect_printed 'up axis  *y, as read; the box looks z-up: draw with --up z'
expect_success render wedge.obj -o wedge.png "${small[@]}"
[[ "$(grep -c 'note: wedge.obj: its box looks z-up.*--up z' ../"$name".err)" -eq 1 ]] || wrong "no note of z-up: $(cat ../"$name".err)"
rm by-default.png storm.png wedge.png variants.gltf wedge.obj

# The command line
expect_error 2 'a command is missing'
expect_error 2 'rendr' rendr
expect_error 2 'SCENE is required' render
expect_error 2 'output is required' render scene.glb
expect_error 2 'bogus' render scene.glb -o a.png --bogus
for size in 0x0 banana 65536x1 1x 10x10x10 -1x5 99999999999x1 '' 3.5x2 '1 x 1'; do
    expect_error 2 '--size: ' render scene.glb -o a.png --size "$size"
done
expect_error 2 '--samples' render scene.glb -o a.png --samples 0
expect_error 2 '--samples' render scene.glb -o a.png --samples many
expect_error 2 '--repeat' render scene.glb -o a.png --repeat 0
expect_error 2 '--time' render scene.glb -o a.png --time nan
expect_error 2 '--time' render scene.glb -o a.png --time soon
expect_error 2 '--device' render scene.glb -o a.png --device fast
expect_error 2 '--device' render scene.glb -o a.png --device -1
expect_error 2 '--raster' render scene.glb -o a.png --raster software
expect_error 2 '--raster' graph scene.glb -o a.dot --raster ''
expect_error 2 '--camera' render scene.glb -o a.png --camera ''
for option in --time --samples --style --animation --set; do
    expect_error 2 "$option: is empty" render scene.glb -o a.png "$option" ''
done
expect_error 2 '--camera' render scene.glb -o a.png --camera 'eye=1,2 target=0,0,0'
expect_error 2 '--camera' render scene.glb -o a.png --camera 'eye=1,2,3 target=1,2,3'
expect_error 2 '--camera' render scene.glb -o a.png --camera 'eye=nan,2,3 target=1,2,3'
expect_error 2 '--camera' render scene.glb -o a.png --camera 'eye=1,2,3 fov=0'
expect_error 2 '--camera' render scene.glb -o a.png --camera 'fov=30'
expect_error 2 '--camera.* "1e30" is not a number up to 1e12' render scene.glb -o a.png --camera 'eye=1e30,0,0'
expect_error 2 '--camera.*same point' render scene.glb -o a.png --camera 'eye=1,2,3 target=1,2,3.0000000000001'
expect_error 2 '--camera.*up must not be' render scene.glb -o a.png --camera 'eye=0,9,0 target=0,0,0 up=0,1,0'
expect_error 2 '--camera.*"azimuth" is missing; write "azimuth=degrees elevation=degrees", such as' render scene.glb -o a.png --camera 'distance=3'
expect_error 2 '--camera.*such as "eye=2,1,3 target=0,0.5,0 fov=35"' render scene.glb -o a.png --camera 'eye=1,2'
expect_error 2 '--view: there is no view "side"; allowed: front, back, left' render scene.glb -o a.png --view side
expect_error 2 '--view: takes the place of --camera' render scene.glb -o a.png --view front --camera auto
expect_error 2 '--up: "w" is no axis; write x, y, z, -x, -y or -z' render scene.glb -o a.png --up w
expect_error 2 '--up: is for files of scenes' render temple -o a.png --up z
expect_error 2 '--world: the world has no option "wether"; its options: seed, weather, hour' render temple -o a.png --world wether=calm
expect_error 2 '--world: there is no weather "rain"; allowed: calm, gusts, storm, tornado' render temple -o a.png --world weather=rain
expect_error 2 '--world: hour=25: 25 is out of range; allowed: 0 to 24' view temple --world hour=25
expect_error 2 '--world: works only with a world; "scene.glb" is not one; the worlds: temple' render scene.glb -o a.png --world hour=9
expect_error 2 '--seed: works only with a world' render scene.glb -o a.png --seed 2
expect_error 2 'not expected: .*--weather; write --world weather=storm' render temple -o a.png --weather storm
expect_error 2 'not expected: --hour=18; write --world hour=18' render temple -o a.png --hour=18
expect_error 2 '--film: works only with a world .*worlds with a film: temple' render scene.glb -o a.mp4 --film
expect_error 1 'tempel: is neither a file nor a world; did you mean the world temple' render tempel -o a.png
expect_error 2 '--input-format: "blend" is no format' render - -o a.png --input-format blend
expect_error 2 '--set takes one value: write --set drawing.seed=2' render scene.glb -o a.png --set hatch.layers=1 drawing.seed=2
expect_error 2 '--set: unknown key .*--help-style' render scene.glb -o a.png --set nosuch.key=1
expect_error 2 '--set: .* is not an assignment' render scene.glb -o a.png --set nothing
expect_error 2 'as ".bmp"; the name must end in .png, .jpg, .jpeg, .webp, .exr, .ora, in .svg' render scene.glb -o a.bmp
expect_error 2 '--depth: goes with single pictures alone' render scene.glb -o 'frames/%d.png' --depth 16
expect_error 2 '--layers: goes with single pictures alone' render scene.glb -o a.mp4 --layers layers
expect_error 2 'tells no format; the name must end in .png' render scene.glb -o a
expect_error 2 '--format: goes with -o - alone' render scene.glb -o a.png --format png
expect_error 2 '--format: .*as "gif"; allowed: png, jpg, webp, exr, ora, svg' render scene.glb -o - --format gif
expect_error 2 '--depth: 16 is no depth of JPEG' render scene.glb -o a.jpg --depth 16
expect_error 2 '--depth: 8 is no depth of OpenEXR' render scene.glb -o a.exr --depth 8
expect_error 2 '--depth: 0 is no depth of SVG' render scene.glb -o a.svg --depth 0
expect_error 2 '--quality: goes with JPEG and WebP alone' render scene.glb -o a.png --quality 90
expect_error 2 '--quality: 0 is out of range; of JPEG it is 1 to 100' render scene.glb -o a.jpg --quality 0
expect_error 2 '--quality: 101 is out of range' render scene.glb -o a.webp --quality 101
expect_error 2 'JPEG has no alpha channel .*; write PNG, WebP, OpenEXR or OpenRaster' render scene.glb -o a.jpg --transparent
expect_error 2 'JPEG has no alpha channel' render scene.glb -o - --format jpg --set paper.transparent=paper
expect_error 2 'H.264 .*; write .webm, .gif or numbered frames' render scene.glb -o a.mp4 --frames 2 --transparent=paper
expect_error 2 '--transparent: cannot make "sky" transparent; allowed: background, paper' render scene.glb -o a.png --transparent=sky
# Pages
expect_error 2 '--page: "A9" is not a page' render scene.glb -o a.png --page A9
expect_error 2 '--page: 2x3mm is out of range' render scene.glb -o a.png --page 2x3mm
expect_error 2 '--page: does not go with --size' render scene.glb -o a.png --page A4 --size 10x10
expect_error 2 '--dpi: goes with --page alone' render scene.glb -o a.png --dpi 300
expect_error 2 '--dpi: A0 has .* each side may have 1 to 65535' render scene.glb -o a.png --page A0 --dpi 9000
expect_error 2 '--page: says itself how high' render scene.glb -o a.png --page A4 --set paper.height_mm=100
expect_error 2 '--tile: 5 is out of range' render scene.glb -o a.png --tile 5
expect_error 2 '--tile: does not go with films' render scene.glb -o a.mp4 --turntable --tile 100
expect_error 1 'cannot be drawn in one go; .* draws from' render scene.glb -o a.exr --size 20000x10 --device cpu
expect_success render scene.glb -o page.png --page 20x30mm --landscape --dpi 72 --device cpu
[[ "$(od -An -tx1 -j16 -N8 page.png | tr -d ' ')" == 0000005500000039 ]] || wrong "a page of 30 x 20 mm is not 85 x 57 pixels"
dots_at=$(($(grep -obUam1 pHYs page.png | cut -d: -f1) + 4))
[[ "$(od -An -tx1 -j"$dots_at" -N4 page.png | tr -d ' ')" == 00000b13 ]] || wrong "no 2835 dots a metre in page.png"
expect_success render scene.glb -o tiled.png --page 30x20mm --dpi 72 --tile 72 --device cpu
[[ -s tiled.png ]] || wrong "no page in tiles"
expect_success render scene.glb -o page.svg --page A5 --dpi 72 --device cpu
grep -q 'width="148mm" height="210mm" viewBox="0 0 148 210"' page.svg || wrong "page.svg is not as large as A5: $(sed -n 4p page.svg)"
for dpi in 50 73 151; do
    expect_success render scene.glb -o page.svg --page A4 --landscape --dpi $dpi --device cpu
    grep -q 'width="297mm" height="210mm" viewBox="0 0 297 210"' page.svg || wrong "page.svg at $dpi dpi is not A4: $(sed -n 4p page.svg)"
done
# Grouped tones need the most memory for each pixel; no buffer may grow beyond what a driver binds.
expect_success render scene.glb -o page.png --page A4 --dpi 300 --style comic --device cpu
rm -f page.png tiled.png page.svg
# Sides, and the axis that points up
for side in front back left right top bottom isometric three-quarter; do
    expect_success render scene.glb -o "$side.png" "${small[@]}" --view $side --ortho
done
[[ "$(md5sum front.png back.png left.png right.png top.png bottom.png isometric.png three-quarter.png | cut -d' ' -f1 | sort -u | wc -l)" -eq 8 ]] ||
    wrong "two sides look the same"
expect_success render scene.glb -o bearing.png "${small[@]}" --camera 'azimuth=90 elevation=0 ortho'
cmp right.png bearing.png || wrong "a bearing of 90 degrees is not the right side"
rm -f ./*.png
printf 'v 0 0 0\nv 1 0 0\nv 1 0 3\nv 0 2 3\nf 1 2 3\nf 1 3 4\n' >z.obj
expect_success info z.obj
expect_printed 'bounds  *(0, 0, 0) to (1, 2, 3) m'
expect_success info z.obj --up z
expect_printed 'bounds  *(0, 0, -2) to (1, 3, -\{0,1\}0) m'
expect_success info z.obj --up -x
expect_printed 'bounds  *(-\{0,1\}0, -1, 0) to (2, -\{0,1\}0, 3) m'
# Through a pipe
expect_success info - --input-format obj <z.obj
expect_printed '(0, 0, 0) to (1, 2, 3)'
expect_success info - <z.obj
expect_printed '(0, 0, 0) to (1, 2, 3)'
expect_error 1 'standard input: does not tell its format; give --input-format' info - <<<'OFF'
expect_error 1 'standard input: is empty' info - </dev/null
expect_error 1 '--input-format is for scenes that come through a pipe' info z.obj --input-format obj
expect_success info - <scene.glb
expect_success info /dev/stdin < <(cat scene.glb)
expect_success info /dev/stdin <scene.glb
expect_success render <(cat scene.glb) -o piped.png "${small[@]}"
expect_success render scene.glb -o file.png "${small[@]}"
cmp piped.png file.png || wrong "a scene through a pipe is drawn otherwise"
mkdir temporary
TMPDIR="$PWD/temporary" expect_success info - --input-format obj <z.obj
rmdir temporary || wrong "a scene through a pipe leaves files"
rm -f piped.png file.png z.obj
expect_error 2 '--size: WebP holds no side of more than 16383 pixels' render scene.glb -o a.webp --size 16384x1
expect_error 2 'SVG does not hold a layer alone' render scene.glb -o a.svg --layer lines
expect_error 2 '--layer: goes with single pictures alone' render scene.glb -o a.mp4 --layer lines
expect_error 2 '--layers: goes with pictures alone' render scene.glb -o a.svg --layers layers
expect_error 2 '--layers: needs a place of its own' render scene.glb -o a.exr --layers a.exr
expect_error 2 '--layers: needs a place of its own' render scene.glb -o a.png --layers -
expect_error 2 '--motion: needs a file of its own' render scene.glb -o a.exr --motion a.exr
expect_error 2 '--plotter: goes with strokes alone' render scene.glb -o a.png --plotter
expect_error 2 '--hidden: goes with strokes alone' render scene.glb -o a.png --hidden
expect_error 2 '--samples: goes with pictures alone' render scene.glb -o a.svg --samples 2

# A draft is coarser, and what is set goes over it
expect_success render scene.glb -o fine.png --style engraving --size 64x48 --device cpu
expect_success render scene.glb -o draft.png --style engraving --size 64x48 --device cpu --draft
expect_success render scene.glb -o set.png --style engraving --size 64x48 --device cpu --draft --set hatch.layers=3
! cmp -s fine.png draft.png || wrong "a draft is no coarser"
! cmp -s set.png draft.png || wrong "what is set does not go over a draft"
rm -f fine.png draft.png set.png

# A typing mistake in a key that there is gets the right one suggested
key="$("$estampe" --help-style all | awk '$1 ~ /\./ && !found { print $1; found = 1 }')"
expect_error 2 "did you mean \"$key\"" render scene.glb -o a.png --set "${key}x=1"

# Files
echo 'no scene' >text.gltf
head -c 100 scene.glb >truncated.glb
printf '[nosuch]\n' >unknown.toml
printf 'not toml' >broken.toml
mkdir folder.png
expect_error 1 'missing.glb' render missing.glb -o a.png
expect_error 1 'text.gltf' render text.gltf -o a.png
expect_error 1 'truncated.glb' render truncated.glb -o a.png
expect_error 1 'missing.glb' info missing.glb
expect_error 1 'truncated.glb' info truncated.glb --json
expect_error 1 'unknown.toml:1:' render scene.glb -o a.png --style unknown.toml
expect_error 1 'broken.toml:1:' render scene.glb -o a.png --style broken.toml
expect_error 1 'nosuchpreset' render scene.glb -o a.png --style nosuchpreset
expect_error 1 'nosuchcamera' render scene.glb -o a.png --camera nosuchcamera
expect_error 1 'nosuchanimation' render scene.glb -o a.png --animation nosuchanimation
expect_error 1 'no such folder' render scene.glb -o nowhere/a.png
expect_error 1 'not a regular file' render scene.glb -o folder.png
expect_error 1 'cannot write into this folder' render scene.glb -o /proc/a.png
expect_error 1 'overwrite an input' graph scene.glb -o scene.glb
printf '[hatch]\nink = "\xf7\xbf\xbf\xbf"\n' >beyond.toml
expect_error 1 'beyond.toml:2:8: not TOML: byte 0xf7 begins no character of UTF-8' render scene.glb -o a.png --style beyond.toml
for size in 1e20 1e-20; do
    printf 'v 0 0 0\nv %s 0 0\nv 0 1e-20 0\nf 1 2 3\n' $size >extent.obj
    expect_error 1 'extent.*: ' render extent.obj -o a.png "${small[@]}"
done
mkfifo pipe pipe.obj
printf 'mtllib pipe\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n' >beside-a-pipe.obj
timeout 60 "$estampe" info beside-a-pipe.obj >/dev/null 2>&1 || wrong "a pipe beside a scene is waited for"
tail -n +2 beside-a-pipe.obj >pipe.obj &
expect_success info pipe.obj --input-format obj
wait
rm pipe pipe.obj
ln scene.glb scene.png
expect_error 1 'overwrite an input' render scene.glb -o scene.png
rm scene.png
# Files that a scene or a style names are inputs, too
expect_success render scene.glb -o wood.png "${small[@]}"
printf 'mtllib wood.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nusemtl wood\nf 1/1 2/1 3/1\n' >wood.obj
printf 'newmtl wood\nmap_Kd wood.png\n' >wood.mtl
cp wood.png wood-before.png
expect_error 1 'wood.png: the output would overwrite an input' render wood.obj -o wood.png "${small[@]}"
expect_error 1 'wood.png: the output would overwrite an input' render scene.glb -o wood.png "${small[@]}" --set ink.flow_map=wood.png
cmp wood.png wood-before.png || wrong "a scene's texture was overwritten"
# A film of more frames than a film may have
printf '{"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],"buffers":[{"byteLength":68,"uri":"data:application/octet-stream;base64,%s"}],"bufferViews":[{"buffer":0,"byteLength":68}],"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]},{"bufferView":0,"byteOffset":36,"componentType":5126,"count":2,"type":"SCALAR","min":[0],"max":[300000000]},{"bufferView":0,"byteOffset":44,"componentType":5126,"count":2,"type":"VEC3"}],"animations":[{"channels":[{"sampler":0,"target":{"node":0,"path":"translation"}}],"samplers":[{"input":1,"output":2}]}]}' \
    "$(printf '\0\0\0\0\0\0\0\0\0\0\0\0\0\0\200\77\0\0\0\0\0\0\0\0\0\0\0\0\0\0\200\77\0\0\0\0\0\0\0\0\243\30\217\115\0\0\0\0\0\0\0\0\0\0\0\0\0\0\200\77\0\0\0\0\0\0\0\0' | base64 -w0)" >long.gltf
expect_error 1 '300094560 s long, 7202269440 frames; a film has at most 1000000' render long.gltf -o long-%d.png "${small[@]}"
rm wood.* wood-before.png long.gltf
expect_error 1 'no such folder' render scene.glb -o a.png --layers nowhere/layers
expect_error 1 'exists and is no empty folder' render scene.glb -o a.png --layers text.gltf
mkdir locked
chmod a-w locked
if [[ $(id -u) -ne 0 ]]; then
    expect_error 1 'cannot write into this folder' render scene.glb -o locked/a.png
fi
expect_error 1 '' render scene.glb -o a.png --device 4000000000
expect_error 1 'hatch.strokes: .*no paths' render scene.glb -o a.svg "${small[@]}" --set hatch.strokes=map
expect_error 1 'contour.lines: .*no paths' render scene.glb -o a.svg "${small[@]}" --set contour.lines=page

# Control characters of names do not reach the terminal
expect_error 1 'red.glb' info $'\e[31mred.glb'
! grep -q $'\e' ../"$name".err || wrong "an escape character reached stderr"

# A name that no one can read to its end is cut
expect_error 1 'File name too long' info "$(printf 'x%.0s' {1..50000}).glb"
[[ "$(wc -c <../"$name".err)" -lt 3000 ]] || wrong "a long name makes a long message"

# Drawing
expect_success render scene.glb -o a.png "${small[@]}"
[[ ! -s ../"$name".out ]] || wrong "render printed on stdout"
expect_success render scene.glb -o b.png "${small[@]}"
cmp a.png b.png || wrong "the same command gave other bytes"
GALLIVM_PERF='' expect_success render scene.glb -o b.png "${small[@]}"
cmp a.png b.png || wrong "shaders compiled well and quickly draw other bytes"
[[ "$(head -c 4 a.png | tail -c 3)" == PNG ]] || wrong "a.png is no PNG"
expect_success render scene.glb -o B.PNG "${small[@]}" --samples 2 --timings --repeat 3
expect_printed 'GPU ms'
expect_printed 'median later frame'
expect_success render scene.glb -o b.png "${small[@]}" --raster compute --json
expect_printed '"raster": "compute"'
expect_success render scene.glb -o b.png "${small[@]}" --raster hardware --json
expect_printed '"raster": "hardware"'
expect_printed '"gpu_ms": '
expect_success render scene.glb -o a.svg "${small[@]}"
expect_success render scene.glb -o b.svg "${small[@]}"
cmp a.svg b.svg || wrong "the same command gave other strokes"
grep -q '<path ' a.svg || wrong "a.svg has no strokes"
expect_success render scene.glb -o b.svg "${small[@]}" --hidden
grep -q 'stroke-dasharray' b.svg || wrong "b.svg has no hidden lines"
expect_success render scene.glb -o b.svg "${small[@]}" --plotter
expect_printed 'pen up .* before .* after'
expect_success render scene.glb -o b.png "${small[@]}" --camera auto
expect_success render scene.glb -o b.png "${small[@]}" --camera 'eye=0,50,0 target=0,0,0 fov=40'
! grep -q 'sees nothing' ../"$name".err || wrong "a camera above the scene sees it: $(cat ../"$name".err)"
expect_success render scene.glb -o b.png "${small[@]}" --camera 'eye=0,50,0 target=0,90,0 fov=40'
grep -q '^estampe: warning: .*sees nothing of the scene; --camera auto' ../"$name".err || wrong "nothing said of an empty view"
expect_success render scene.glb -o b.png "${small[@]}" --camera 'eye=-1.6,0.3,-11.5 target=0,9,-11.5 fov=10'
grep -q '^estampe: warning: .*stands inside "drum", whose one-sided' ../"$name".err || wrong "nothing said of a view from inside"
expect_success graph scene.glb -o frame.dot "${small[@]}"
grep -q digraph frame.dot || wrong "frame.dot is no graph"
"$estampe" styles | awk 'NF == 0 { exit } { print $1 }' | while read -r preset; do
    "$estampe" styles "$preset" >"$preset".toml
    "$estampe" styles "$preset".toml | cmp - "$preset".toml || exit 1
done || wrong "a preset does not read back equal"

# Styles put together
expect_success styles
expect_printed '^Additions'
expect_printed '^no-color  *Black, white'
expect_success styles comic+no-color
expect_printed '^saturation = 0$'
expect_success render scene.glb -o plus.png "${small[@]}" --style comic+no-color
expect_success render scene.glb -o set.png "${small[@]}" --style comic
! cmp -s plus.png set.png || wrong "an addition changes nothing"
expect_error 1 'no preset or style file "no-colour"; did you mean "no-color"' render scene.glb -o none.png --style comic+no-colour
expect_error 2 'JPEG has no alpha' render scene.glb -o none.jpg "${small[@]}" --style comic+transparent

# Formats of pictures
# starts_with FILE HEX: the bytes that a kind of file begins with
starts_with() {
    [[ "$(od -An -tx1 -v "$1" | head -1 | tr -d ' ')" == $2* ]] || wrong "$1 begins with $(od -An -tx1 "$1" | head -1)"
}
for file in form.png form.jpg form.jpeg form.webp form.exr form.ora; do
    expect_success render scene.glb -o "$file" "${small[@]}"
    [[ ! -s ../"$name".out ]] || wrong "render -o $file printed on stdout"
done
starts_with form.jpg ffd8ff
cmp form.jpg form.jpeg || wrong "one format has two kinds of bytes"
starts_with form.webp 52494646
starts_with form.exr 762f3101
starts_with form.ora 504b0304
[[ "$(head -c 54 form.ora | tail -c 24)" == mimetypeimage/openraster ]] || wrong "form.ora does not say what it is"
expect_success render scene.glb -o small.jpg "${small[@]}" --quality 30
[[ $(wc -c <small.jpg) -lt $(wc -c <form.jpg) ]] || wrong "--quality changes nothing"
expect_success render scene.glb -o deep.png "${small[@]}" --depth 16
[[ "$(od -An -tu1 -j24 -N1 deep.png | tr -d ' ')" == 16 ]] || wrong "deep.png is not of 16 bits"
expect_success render scene.glb -o float.exr "${small[@]}" --depth 32
[[ $(wc -c <float.exr) -gt $(wc -c <form.exr) ]] || wrong "floats are no longer than halves"

# Transparent paper
for file in clear.png clear.webp clear.exr clear.ora; do
    expect_success render scene.glb -o "$file" "${small[@]}" --transparent
done
starts_with clear.webp 52494646
expect_success render scene.glb -o same.png "${small[@]}" --set paper.transparent=background
cmp clear.png same.png || wrong "--transparent is not paper.transparent"
! cmp -s clear.png form.png || wrong "--transparent changes nothing"
expect_success render scene.glb -o ink.png "${small[@]}" --transparent=paper
! cmp -s clear.png ink.png || wrong "--transparent=paper is --transparent"
expect_success render scene.glb -o opaque.png "${small[@]}" --transparent --set paper.transparent=none
cmp opaque.png form.png || wrong "--set does not go over --transparent"
expect_success render scene.glb -o deep.png "${small[@]}" --depth 16 --transparent
[[ "$(od -An -tu1 -j25 -N1 deep.png | tr -d ' ')" == 6 ]] || wrong "deep.png has no alpha channel"
expect_success render scene.glb -o clear.svg "${small[@]}" --transparent
! grep -q 'id="paper"' clear.svg || wrong "clear.svg has paper"

# Standard output carries the picture alone
for format in png jpg webp exr ora svg; do
    expect_success render scene.glb -o - "${small[@]}" --format "$format"
    cp ../"$name".out piped
    expect_success render scene.glb -o "named.$format" "${small[@]}"
    cmp piped "named.$format" || wrong "-o - --format $format writes other bytes than a file"
done
expect_success render scene.glb -o - "${small[@]}" --timings
cmp ../"$name".out form.png || wrong "timings went to stdout"
grep -q 'GPU ms' ../"$name".err || wrong "timings went nowhere"
expect_success render scene.glb -o - "${small[@]}" --format svg --plotter
[[ "$(tail -c 7 ../"$name".out)" == '</svg>' ]] || wrong "the plotter's work went to stdout"
if "$estampe" render scene.glb -o - "${small[@]}" >/dev/full 2>../"$name".err; then
    wrong "a full stdout went unnoticed"
fi
grep -q 'standard output cannot be written' ../"$name".err || wrong "a full stdout: $(cat ../"$name".err)"

# Layers
expect_success render scene.glb -o plain.png "${small[@]}"
expect_success render scene.glb -o with.png "${small[@]}" --layers layers
cmp plain.png with.png || wrong "--layers changes the picture"
for layer in 00-paper 01-wash hatch lines; do
    compgen -G "layers/*$layer.png" >/dev/null || wrong "there is no layer $layer"
done
grep -q '"blend": "multiply"' layers/layers.json || wrong "layers.json does not say how layers blend"
expect_error 1 'exists and is no empty folder' render scene.glb -o with.png "${small[@]}" --layers layers/
mkdir empty
expect_success render scene.glb -o deep.png "${small[@]}" --depth 16 --layers empty/
[[ "$(od -An -tu1 -j24 -N1 empty/00-paper.png | tr -d ' ')" == 16 ]] || wrong "layers of a deep PNG are not deep"
expect_success render scene.glb -o with.ora "${small[@]}" --layers layers.exr
cmp with.ora form.ora || wrong "--layers changes the OpenRaster file"
grep -q 'paper\.R' layers.exr || wrong "layers.exr has no paper"

# One of them alone
expect_success render scene.glb -o lines.png "${small[@]}" --layer lines
! cmp -s plain.png lines.png || wrong "--layer draws the whole picture"
expect_success render scene.glb -o occlusion.png "${small[@]}" --set occlusion.enabled=true --layer occlusion
expect_error 1 '--layer: no layer or object is named "hach"; did you mean "hatch"' render scene.glb -o none.png --device 99 --layer hach
expect_error 1 '--layer: .* "zzzzzzzz"; layers are paper, wash' render scene.glb -o none.png "${small[@]}" --layer zzzzzzzz
expect_error 1 'has no layer "occlusion"' render scene.glb -o none.png "${small[@]}" --layer occlusion
[[ ! -e none.png ]] || wrong "a layer that is not there was written"

# Normal maps
expect_success normalmap plain.png -o normal.png --relief 0.01
[[ ! -s ../"$name".out ]] || wrong "normalmap printed on stdout"
expect_success normalmap plain.png -o other.png --relief 0.01 --green down --edges clamp
! cmp -s normal.png other.png || wrong "--green and --edges change nothing"
expect_success normalmap plain.png -o steep.png --relief 5
grep -q 'note: .*the map shows terraces' ../"$name".err || wrong "nothing said of terraces"
expect_error 2 'must end in .png' normalmap plain.png -o normal.jpg
expect_error 2 '--relief: 11 is out of range' normalmap plain.png -o normal.png --relief 11
expect_error 2 '--edges: "mirror" is not one of its choices' normalmap plain.png -o normal.png --edges mirror
expect_error 1 'nothing.png' normalmap nothing.png -o normal.png
expect_error 1 'plain.png' normalmap plain.png -o plain.png

# Normal maps of detailed meshes
cat >flat.obj <<'OBJ'
v 0 0 0
v 1 0 0
v 1 1 0
v 0 1 0
vt 0 0
vt 1 0
vt 1 1
vt 0 1
g left
f 1/1 2/2 3/3 4/4
OBJ
sed 's/^v \([01]\)/v 3\1/; s/left/right/; s#\([1-4]\)/[1-4]#\1#g' flat.obj >bare.obj
awk 'BEGIN {
  for (j = 0; j <= 40; j++) for (i = 0; i <= 40; i++) print "v", i / 40, j / 40, 0.02 * sin(i / 3) * sin(j / 3)
  for (j = 0; j < 40; j++) for (i = 1; i <= 40; i++) print "f", 41 * j + i, 41 * j + i + 1, 41 * j + i + 42, 41 * j + i + 41
}' >waves.obj
expect_success normalmap --help-all
expect_printed '--from-object'
baking=(normalmap flat.obj --from waves.obj --size 64)
expect_success "${baking[@]}" -o baked.png --distance 0.1
grep -q 'note: 4096 texels of 64 x 64 are covered; rays reached 0.1 m' ../"$name".err || wrong "nothing said of the texels"
! grep -q 'found no detail\|warning' ../"$name".err || wrong "lost something of waves: $(cat ../"$name".err)"
expect_success "${baking[@]}" -o other.png --distance 0.1 --samples 1 --border 0 --tangents vertices --green down
! cmp -s baked.png other.png || wrong "--green changes nothing of a baked map"
expect_success "${baking[@]}" -o other.png --distance 0.01
grep -q 'note: .* of the covered texels found no detail and are flat' ../"$name".err || wrong "nothing said of misses"
{ cat flat.obj; sed 's/left/right/' flat.obj; cat bare.obj; } >several.obj
expect_success normalmap several.obj --from waves.obj -o other.png --size 64 --distance 0.1
grep -q 'warning: several.obj: 2 of 6 triangles get no part of the map: they have no UVs' ../"$name".err || wrong "nothing said of missing UVs"
grep -q 'warning: several.obj: triangles share 100 % of the covered map' ../"$name".err || wrong "nothing said of overlaps"
expect_success normalmap several.obj --from waves.obj -o other.png --size 64 --distance 0.1 --object left
cmp -s baked.png other.png || wrong "--object does not choose a mesh"
printf 'newmtl wall\nKd 1 1 1\nnorm baked.png\n' >wall.mtl
{ printf 'mtllib wall.mtl\nusemtl wall\n'; cat flat.obj; } >mapped.obj
expect_success render flat.obj -o flat.png --view front "${small[@]}"
expect_success render mapped.obj -o mapped.png --view front "${small[@]}"
! cmp -s flat.png mapped.png || wrong "a baked map changes nothing"
expect_error 1 'bare.obj: has no UVs' normalmap bare.obj --from waves.obj -o other.png
expect_error 1 'no second set of UVs' "${baking[@]}" -o other.png --uv 1
expect_error 1 'no object has the name "roof"' "${baking[@]}" -o other.png --object roof
expect_error 1 'no object has the name "roof"' "${baking[@]}" -o other.png --from-object roof
expect_error 1 'no material has the name "wood"' "${baking[@]}" -o other.png --material wood
expect_error 1 'nothing.obj' normalmap flat.obj --from nothing.obj -o other.png
expect_error 2 '--size: 8 is out of range' normalmap flat.obj --from waves.obj -o other.png --size 8
expect_error 2 '--distance: -1 is out of range' "${baking[@]}" -o other.png --distance -1
expect_error 2 '--tangents: "faces" is not one of its choices' "${baking[@]}" -o other.png --tangents faces
expect_error 2 '--size.*--from' normalmap plain.png -o other.png --size 64
expect_error 2 '--from.*--relief\|--relief.*--from' "${baking[@]}" -o other.png --relief 0.1

# Tonal art maps
tiny=(--set tam.size_px=64 --set tam.tones=4 --set tam.candidates=8)
expect_success tam --help-all
expect_printed '--preview'
expect_success tam -o a.tam "${tiny[@]}" --preview sheet.png
[[ ! -s ../"$name".out ]] || wrong "tam printed on stdout"
expect_success tam tam-charcoal -o b.tam "${tiny[@]}"
expect_success tam -o c.tam "${tiny[@]}"
cmp -s a.tam c.tam || wrong "the same map has other bytes"
! cmp -s a.tam b.tam || wrong "charcoal is no other than a pen"
expect_success tam --from a.tam -o painted/
expect_success tam --from painted -o a.dds
expect_success tam --from a.dds -o d.tam
mkdir alone
for tone in 1 2 3 4; do cp painted/tone${tone}_level0.png alone/tone$tone.png; done
expect_success tam --from alone -o e.tam
grep -q 'warning: levels of 32 px and less were derived' ../"$name".err || wrong "nothing said of derived levels"
expect_success tam -o f.tam "${tiny[@]}" --brush painted/tone4_level0.png
expect_error 2 'output is required' tam
expect_error 2 'must end in .tam' tam -o a.png
expect_error 2 '--preview .*must end in .png' tam -o a.tam --preview a.jpg
expect_error 2 'leave out --brush and --set' tam --from a.tam -o b.tam --set drawing.seed=2
expect_error 2 '--set: tam.tones = 3 is out of range' tam -o a.tam --set tam.tones=3
expect_error 1 'tam.size_px = 100 is not a power of two' tam -o a.tam --set tam.size_px=100
expect_error 1 'nosuchpreset' tam nosuchpreset -o a.tam
expect_error 1 'missing.tam' tam --from missing.tam -o a.tam
expect_error 1 'scene.glb: is no tonal art map' tam --from scene.glb -o a.tam
expect_error 1 'overwrite an input' tam --from a.tam -o a.tam
expect_error 1 'is not empty' tam --from a.tam -o painted/
expect_error 1 'no such folder' tam -o nowhere/a.tam
expect_error 1 'sheet.png' tam -o a.tam --brush missing-sheet.png
head -c 2000 a.tam >truncated.tam
expect_error 1 'truncated.tam' tam --from truncated.tam -o g.tam

# Pipelines that are not kept
expect_success render scene.glb -o kept.png --size 64x36 --device cpu --no-cache

# Lightmaps
quick=(--size 512 --samples 1 --bounces 1)
expect_success bake --help-all
expect_printed 'Ctrl-C keeps what is done'
expect_success bake scene.glb -o a.exr "${quick[@]}"
grep -q 'texels of 512 x 512' ../"$name".err || wrong "bake said nothing of its texels"
[[ ! -e a.exr.partial ]] || wrong "a finished bake left its partial file"
expect_success bake scene.glb -o b.exr "${quick[@]}"
cmp -s a.exr b.exr || wrong "the same bake has other bytes"
expect_success bake scene.glb -o c.exr "${quick[@]}" --seed 2 --direct sun,point --sky 0.5 --set light.ambient=0.3
! cmp -s a.exr c.exr || wrong "settings of a bake change nothing"
expect_success render scene.glb -o dark.png "${small[@]}"
expect_success render scene.glb -o lit.png "${small[@]}" --lightmap a.exr
! cmp -s dark.png lit.png || wrong "a lightmap changes nothing"
status=0
timeout --foreground -s INT 4 "$estampe" bake scene.glb -o d.exr --size 512 --samples 60000 2>../"$name".err || status=$?
[[ $status -ne 0 && -s d.exr.partial && ! -e d.exr ]] || wrong "a stopped bake did not keep its work"
grep -q '^estampe: error: d.exr: stopped at ' ../"$name".err || wrong "a stopped bake said: $(cat ../"$name".err)"
rm -f d.exr.partial
expect_error 2 'output is required' bake scene.glb
expect_error 2 'must end in .exr' bake scene.glb -o a.png
expect_error 2 '--size: 8 is out of range' bake scene.glb -o d.exr --size 8
expect_error 2 '--samples: 0 is out of range' bake scene.glb -o d.exr --samples 0
expect_error 2 '--bounces: 99 is out of range' bake scene.glb -o d.exr --bounces 99
expect_error 2 '--direct: "moon" is no kind of light' bake scene.glb -o d.exr --direct sun,moon
expect_error 1 'missing.glb' bake missing.glb -o d.exr
expect_error 1 'no such folder' bake scene.glb -o nowhere/d.exr
expect_error 1 'charts do not fit' bake scene.glb -o d.exr --size 16
expect_error 1 'missing.exr' render scene.glb -o d.png "${small[@]}" --lightmap missing.exr
expect_error 1 'scene.glb: is not an OpenEXR picture' render scene.glb -o d.png "${small[@]}" --lightmap scene.glb
head -c 3000 a.exr >truncated.exr
expect_error 1 'truncated.exr: is damaged' render scene.glb -o d.png "${small[@]}" --lightmap truncated.exr
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n' >other.obj
expect_error 1 'was made for another scene' render other.obj -o d.png "${small[@]}" --lightmap a.exr


# Lightmaps that the file names itself
cat >panel.gltf <<'JSON'
{"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
 "nodes": [{"mesh": 0, "extras": {"estampe": {"lightmap": {"uri": "panel.png", "texCoord": 0}}}}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 1}}]}],
 "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]},
               {"bufferView": 1, "componentType": 5126, "count": 3, "type": "VEC2"}],
 "bufferViews": [{"buffer": 0, "byteLength": 36}, {"buffer": 0, "byteOffset": 36, "byteLength": 24}],
 "buffers": [{"byteLength": 60, "uri": "panel.bin"}]}
JSON
printf '%b' '\0\0\0\0\0\0\0\0\0\0\0\0\0\0\x80\x3f\0\0\0\0\0\0\0\0\0\0\0\0\0\0\x80\x3f\0\0\0\0' >panel.bin
head -c 24 /dev/zero >>panel.bin
cp dark.png panel.png
sed 's/, "extras": .*/}],/' panel.gltf >plain.gltf
expect_success render panel.gltf -o worn.png "${small[@]}"
expect_success render plain.gltf -o plain.png "${small[@]}"
! cmp -s worn.png plain.png || wrong "a lightmap that the file names changes nothing"
rm panel.png
expect_error 1 'panel.gltf#/nodes/0/extras/estampe/lightmap/uri: names a lightmap that cannot be read' render panel.gltf -o d.png "${small[@]}"

# Motion
sed 's/, "extras": .*/}], "animations": [{"channels": [{"sampler": 0, "target": {"node": 0, "path": "translation"}}],\
 "samplers": [{"input": 2, "output": 3}]}],/
s/"type": "VEC2"}],/"type": "VEC2"},\
 {"bufferView": 2, "componentType": 5126, "count": 2, "type": "SCALAR", "min": [0], "max": [1]},\
 {"bufferView": 3, "componentType": 5126, "count": 2, "type": "VEC3"}],/
s/"byteLength": 24}],/"byteLength": 24}, {"buffer": 0, "byteOffset": 60, "byteLength": 8},\
 {"buffer": 0, "byteOffset": 68, "byteLength": 24}],/
s/"byteLength": 60, "uri": "panel.bin"/"byteLength": 92, "uri": "moving.bin"/' panel.gltf >moving.gltf
{ cat panel.bin; printf '%b' '\0\0\0\0\0\0\x80\x3f'; head -c 12 /dev/zero; printf '%b' '\0\0\x80\x3f'; head -c 8 /dev/zero; } >moving.bin
expect_success render moving.gltf -o moved.png "${small[@]}" --time 0.5 --motion moved.exr
expect_success render moving.gltf -o still.png "${small[@]}" --time 0.5
cmp -s moved.png still.png || wrong "motion changes the picture"
expect_success render moving.gltf -o still.png "${small[@]}" --time 0.5 --motion still.exr --since 0.5
! cmp -s moved.exr still.exr || wrong "--since changes nothing"
expect_error 2 '--motion m.png: motion is written as OpenEXR' render scene.glb -o d.png --motion m.png
expect_error 2 '--since: goes with --motion alone' render scene.glb -o d.png --since 1
expect_error 2 '--since: is not a finite number' render scene.glb -o d.png --motion m.exr --since nan
expect_error 2 '--motion: goes with pictures alone' render scene.glb -o d.svg --motion m.exr
expect_error 1 'no such folder' render scene.glb -o d.png --motion nowhere/m.exr

# A failure keeps the picture that was there
expect_error 1 'truncated.glb' render truncated.glb -o a.png

# Output that goes nowhere is a failure
if "$estampe" --help-style all >/dev/full 2>../"$name".err; then
    wrong "a full disk went unnoticed"
fi
left="$(find . -name '.*' -type f -o -name '*.tmp*')"
[[ -z "$left" ]] || wrong "left over: $left"

[[ $failures -eq 0 ]] || exit 1
echo "All is as it should be."
