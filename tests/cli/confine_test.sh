#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Attacks by scenes, styles, terrains and jobs of strangers: what their references may read, and what messages show.
# Usage: confine_test.sh ESTAMPE MAKE_EXAMPLE     the program, and the one that writes the example scene
set -euo pipefail
estampe="$(realpath "$1")"
make_example="$(realpath "$2")"
# shellcheck source=tests/support/harness.sh
source "$(dirname "${BASH_SOURCE[0]}")/../support/harness.sh"
cd "$folder"

# The folder `in` is the stranger's; the word hunter2 stands only in files beside it.
mkdir -p in/sub secret
"$make_example" in/scene.glb >/dev/null
cp in/scene.glb secret/scene.glb
"$make_example" in/sub/scene.glb >/dev/null
convert -size 64x8 gradient: in/own.png
cp in/own.png secret/own.png
cp in/own.png in/sub/own.png
ln -s ../secret in/linked
ln -s ../secret/own.png in/link.png
ln -s ../secret/scene.glb in/link.glb

# run ARGUMENT...: runs the program, and leaves its exit status in `status` and its messages in `err`
run() {
    status=0
    timeout 60 "$estampe" "$@" >out 2>err || status=$?
}

draw() {
    run render "$1" -o out.png --size 48x32 --device cpu "${@:2}"
}

# refused WORD...: the last run was refused because of --confine, in one line
refused() {
    [[ $status -eq 1 || $status -eq 2 ]] || wrong "$*: status $status: $(cat err)"
    grep -q -- 'outside the folder.*--confine' err || wrong "$*: not refused: $(cat err)"
    [[ "$(grep -c '^estampe: ' err)" -eq "$(wc -l <err)" ]] || wrong "$*: says more than its lines: $(cat err)"
}

# drawn WORD...: the last run succeeded
drawn() {
    [[ $status -eq 0 ]] || wrong "$*: status $status: $(cat err)"
}

# ---- Scenes: the unit tests try all references; here is the way through the commands
draw in/scene.glb --confine
drawn scene
draw in/link.glb --confine
refused scene by a link
draw in/link.glb
drawn scene by a link
cat >in/scene.obj <<'END'
mtllib ../secret/own.mtl
v 0 0 0
v 1 0 0
v 0 1 0
f 1 2 3
END
draw in/scene.obj --confine
refused render OBJ
run info in/scene.obj --confine
refused info OBJ
run info in/scene.obj
drawn info OBJ
run bake in/scene.obj -o out.exr --size 16 --samples 1 --confine
refused bake OBJ
run normalmap in/link.png -o out.png --confine
refused normalmap
run normalmap in/own.png -o out.png --confine
drawn normalmap
run normalmap in/own.obj --from in/scene.obj -o out.png --confine
[[ $status -eq 1 ]] || wrong "normalmap --from of a missing file"
run normalmap in/scene.obj --from in/scene.obj -o out.png --confine
refused normalmap --from
run tam --brush in/link.png -o out.tam --confine
refused tam --brush
run tam --from in/linked -o out.tam --confine
refused tam --from
run view in/scene.obj --warm-up --device cpu --confine
refused view
run graph in/scene.obj -o out.dot --device cpu --confine
refused graph
run render - -o out.png --size 48x32 --device cpu --confine <in/scene.glb
drawn standard input
run info - --input-format obj --confine <<'END'
mtllib in/own.mtl
v 0 0 0
v 1 0 0
v 0 1 0
f 1 2 3
END
drawn standard input names a file beside it
grep -q 'own.mtl' err || wrong "a scene from standard input finds files beside it: $(cat err)"

# ---- Lightmaps and terrains
ln -s ../secret/own.exr in/link.exr
touch secret/own.exr
draw in/scene.glb --lightmap in/link.exr --confine
refused lightmap
terrain() {
    printf '[terrain]\nheight = "2 * texture('"'%s'"', 100)"\n' "$1" >in/ground.toml
}
terrain own.png
draw in/ground.toml --confine
drawn terrain
draw in/scene.glb --terrain in/ground.toml --confine
drawn terrain below a scene
for name in ../secret/own.png link.png linked/own.png sub/../own.png; do
    terrain "$name"
    draw in/ground.toml --confine
    refused "terrain, $name"
    draw in/scene.glb --terrain in/ground.toml --confine
    refused "terrain below a scene, $name"
done
terrain "$PWD/secret/none.png"
draw in/ground.toml
grep -q 'in/none.png: cannot open' err || wrong "an absolute path of a terrain: $(cat err)"
terrain "/elsewhere/own.png"
draw in/ground.toml --confine
drawn a terrain of another machine

# ---- Styles: each parameter that names a file, and extends
cat >keys <<'END'
contour.brush
contour.outline.brush
wash.shade_texture
particles.sheet
ink.flow_map
hatch.map
END
"$estampe" styles pencil >all.toml
while read -r key; do
    grep -q "^${key#*.} = " all.toml || wrong "there is no parameter $key"
    for name in ../secret/own.png "$PWD/secret/own.png" 'sub/../own.png' '..\\\\secret/own.png'; do
        printf '%s = "%s"\n' "$key" "$name" >in/style.toml
        draw in/scene.glb --style in/style.toml --confine
        refused "$key = $name"
        grep -q 'in/style.toml:1:' err || wrong "$key = $name: no place: $(cat err)"
    done
done <keys
# Links are found when the file is opened
linked() {
    printf '%s\n' "${@:2}" >in/style.toml
    draw in/scene.glb --style "$1" --confine
    refused "${*:2}"
}
linked in/style.toml 'contour.brush = "link.png"'
linked in/style.toml 'contour.outline.brush = "linked/own.png"'
linked in/style.toml 'wash.shade_texture = "link.png"'
linked in/style.toml 'hatch.strokes = "map"' 'hatch.map = "linked"'
linked in/style.toml 'hatch.strokes = "map"' 'hatch.map = "link.png"'
linked in/style.toml 'ink.enabled = true' 'ink.flow_map = "link.png"'
linked in/style.toml 'particles.emitters = "*"' 'particles.sheet = "link.png"'
linked in/style.toml '[object."*".wash]' 'shade_texture = "link.png"'
linked pencil+in/style.toml 'contour.brush = "link.png"'
for base in ../secret/base.toml "$PWD/secret/base.toml" linked/base.toml link.toml sub/../base.toml; do
    cp all.toml secret/base.toml
    cp all.toml in/base.toml
    ln -sf ../secret/base.toml in/link.toml
    printf 'extends = "%s"\n' "$base" >in/style.toml
    draw in/scene.glb --style in/style.toml --confine
    refused "extends = $base"
    run styles in/style.toml --confine
    refused "styles, extends = $base"
done
draw in/scene.glb --style in/link.toml --confine
refused a style by a link
run bake in/scene.glb -o out.exr --size 16 --samples 1 --style in/link.toml --confine
refused bake --style
printf 'extends = "base.toml"\ncontour.brush = "own.png"\n' >in/style.toml
draw in/scene.glb --style in/style.toml --confine
drawn a style of its own
draw in/scene.glb --style in/style.toml --set "contour.brush=$PWD/secret/own.png" --confine
drawn a brush of the command line

# ---- Jobs: all that they name lies below the folder of the jobs file
job() {
    printf '[[job]]\n%s\n' "$1" >in/jobs.toml
    shift
    printf '%s\n' 'size = "48x32"' "$@" >>in/jobs.toml
    (cd in && run batch jobs.toml --device cpu --confine && printf '%s' "$status" >../status)
    status="$(cat status)"
    cp in/err err
    rm -f in/err in/out
}
job 'scene = "sub/scene.glb"' 'output = "out.png"'
drawn a job
for each in 'scene = "../secret/scene.glb"' 'scene = "linked/scene.glb"' 'scene = "link.glb"' \
    "scene = \"$PWD/secret/scene.glb\""; do
    job "$each" 'output = "out.png"'
    refused "job, $each"
done
for each in 'style = "../secret/base.toml"' 'style = "linked/base.toml"' "style = \"$PWD/secret/base.toml\"" \
    'set = ["contour.brush=../secret/own.png"]' 'set = ["contour.brush=linked/own.png"]' \
    "set = [\"contour.brush=$PWD/secret/own.png\"]" 'lightmap = "../secret/own.exr"' 'lightmap = "link.exr"' \
    'terrain = "linked/ground.toml"' 'terrain = "../secret/ground.toml"'; do
    job 'scene = "scene.glb"' "$each" 'output = "out.png"'
    refused "job, $each"
done
ln -s ../secret/new.png in/new.png
for each in '../secret/out.png' 'linked/out.png' 'new.png' "$PWD/secret/out.png" 'linked/none/%04d.png'; do
    job 'scene = "scene.glb"' "output = \"$each\""
    refused "job, output $each"
done
job 'scene = "scene.glb"' 'output = "out.png"' 'layers = "linked/layers"'
refused job, layers
job 'scene = "scene.glb"' 'output = "out.png"' 'motion = "../secret/motion.exr"'
refused job, motion
mkdir -p in/film
ln -s ../secret in/film.mp4.partial
ln -s ../../secret/new.png in/film/0001.png
for each in film.mp4 film/%04d.png; do
    job 'scene = "scene.glb"' "output = \"$each\"" 'frames = "1-2"' 'turntable = true'
    refused "job, film $each"
done
[[ -z "$(find secret -newer keys -name 'out*' -o -newer keys -name 'new*' -o -newer keys -name '0*' -o -newer keys -name 'film*')" ]] || wrong "a job wrote into secret"
cp in/jobs.toml secret/jobs.toml
ln -s ../secret/jobs.toml in/linked_jobs.toml
run batch in/linked_jobs.toml --device cpu --confine
refused jobs by a link

# ---- Messages show no content of files that are not what their role says, also without --confine
silent() {
    ! grep -q hunter2 out err || wrong "$*: shows a secret: $(grep -h hunter2 out err | head -3)"
}
number=0
for text in 'hunter2:x:0:0:hunter2:/hunter2:/bin/sh' 'hunter2 = "hunter2"' '[hunter2]' 'hunter2' \
    '{"hunter2": hunter2}' '{"asset": {"version": "hunter2"}, "hunter2": ["hunter2"]}' '"hunter2' \
    'PASSWORD=hunter2' '[hatch]
hunter2 = 3' '[hatch]
width_mm = "hunter2"' 'extends = "hunter2"' '[terrain]
height = "hunter2(3)"' 'v hunter2' 'newmtl hunter2
Kd hunter2 hunter2
hunter2 hunter2' 'ply hunter2' 'ply
format hunter2 1.0' 'solid hunter2
facet hunter2' '<hunter2>' '<COLLADA><hunter2' '; FBX 7.4.0 project file
hunter2: hunter2 {' 'Kaydara FBX Binary  hunter2' 'P3 hunter2' 'GIF89ahunter2' '%PDF hunter2' \
    'size_px = "hunter2"' 'darkness = ["hunter2"]'; do
    number=$((number + 1))
    printf '%s\n' "$text" >secret/text
    printf 'extends = "../secret/text"\n' >in/style.toml
    run styles in/style.toml
    silent "extends, $text"
    printf 'extends = "style.toml"\n' >in/upper.toml
    run styles in/upper.toml
    silent "extends of extends, $text"
    mkdir -p in/map
    cp in/own.png in/map/tone1.png
    ln -sf ../../secret/text in/map/tam.toml
    jobs=()
    for extension in gltf glb obj ply stl dae fbx toml exr; do
        ln -sf ../secret/text "in/text.$extension"
        [[ $extension == exr ]] || jobs+=("scene = \"in/text.$extension\"")
    done
    jobs+=('style = "secret/text"' 'style = "in/text.toml"' 'style = "in/style.toml"' 'terrain = "in/text.toml"'
        'lightmap = "in/text.exr"' 'set = ["contour.brush=secret/text"]'
        'set = ["wash.shade_texture=secret/text"]' 'set = ["hatch.strokes=map", "hatch.map=secret/text"]'
        'set = ["hatch.strokes=map", "hatch.map=in/map"]')
    for i in "${!jobs[@]}"; do
        printf '[[job]]\n%s\noutput = "out%s.png"\nsize = "48x32"\n' "${jobs[i]}" "$i"
        [[ ${jobs[i]} == scene* ]] || echo 'scene = "in/scene.glb"'
    done >jobs.toml
    run batch jobs.toml --device cpu
    silent "jobs, $text"
    ! grep -q hunter2 jobs.report.json || wrong "jobs, $text: shows $(grep -m 3 hunter2 jobs.report.json)"
    grep -q "${#jobs[@]} of ${#jobs[@]} jobs failed" err || wrong "jobs, $text: $(cat err)"
    printf 'mtllib ../secret/text\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl m\nf 1 2 3\n' >in/scene.obj
    run info in/scene.obj
    silent "mtllib, $text"
    printf 'mtllib own.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl m\nf 1 2 3\n' >in/scene.obj
    printf 'newmtl m\nmap_Kd ../secret/text\n' >in/own.mtl
    run info in/scene.obj
    silent "map_Kd, $text"
    terrain ../secret/text
    run info in/ground.toml
    silent "terrain texture, $text"
done
[[ $number -eq 26 ]] || wrong "only $number texts were tried"

[[ $failures -eq 0 ]]
