#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Small valid files for the libFuzzer targets to start from, in a folder for each below CORPUS.
# Usage: tests/fuzz/make_corpus.sh CORPUS
set -euo pipefail
root="$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)"
[[ $# -eq 1 ]] || { echo "Usage: tests/fuzz/make_corpus.sh CORPUS" >&2; exit 1; }
mkdir -p "$1"/{gltf,obj,ply,stl,assimp,scene,style,tam,image,terrain}_fuzz
cd "$1"

# floats N...: as a file has them, least byte first, of whole numbers from -1 to 2
floats() {
    local number
    for number; do
        case $number in
            -1) printf '\0\0\200\277' ;;
            0) printf '\0\0\0\0' ;;
            1) printf '\0\0\200\077' ;;
            2) printf '\0\0\0\100' ;;
        esac
    done
}
# integer BITS N
integer() {
    local bit
    for ((bit = 0; bit < $1; bit += 8)); do
        # shellcheck disable=SC2059 # the format is the byte
        printf "\\x$(printf %02x $(($2 >> bit & 255)))"
    done
}
uint32() { integer 32 "$1"; }

# Pictures, also for what follows.
picture=(convert -size 32x32 'gradient:black-white')
for kind in png jpg webp tiff tga bmp gif psd; do
    "${picture[@]}" "image_fuzz/gradient.$kind"
done
"${picture[@]}" -depth 16 -alpha set image_fuzz/deep.png
"${picture[@]}" -depth 16 -compress Zip image_fuzz/deep.tiff
"${picture[@]}" -resize 4x4 -colors 4 image_fuzz/palette.gif
# attribute NAME TYPE BYTES, with the value on standard input
attribute() { printf '%s\0%s\0' "$1" "$2"; uint32 "$3"; cat; }
{
    printf '\166\057\061\001\002\0\0\0'
    for channel in B G R; do
        printf '%s\0\1\0\0\0\0\0\0\0\1\0\0\0\1\0\0\0' "$channel" # of half floats
    done | { cat; printf '\0'; } | attribute channels chlist 55
    printf '\0' | attribute compression compression 1
    for window in dataWindow displayWindow; do
        floats 0 0 0 0 | attribute "$window" box2i 16
    done
    printf '\0' | attribute lineOrder lineOrder 1
    floats 1 | attribute pixelAspectRatio float 4
    floats 0 0 | attribute screenWindowCenter v2f 8
    floats 1 | attribute screenWindowWidth float 4
    printf '\0'
} >header
{ cat header; uint32 $(($(wc -c <header) + 8)); uint32 0; uint32 0; uint32 6; printf '\0\074\0\070\0\064'; } >image_fuzz/pixel.exr
rm header

# Meshes.
triangle="$({ floats 0 0 0 1 0 0 0 1 0 0 0 0 2 2 2; floats 0 1; } | base64 --wrap 0)"
cat >gltf_fuzz/triangle.gltf <<EOF
{"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 1, 2]}],
 "nodes": [{"mesh": 0, "name": "a"}, {"camera": 0, "translation": [0, 0, 3]},
           {"extensions": {"KHR_lights_punctual": {"light": 0}}, "rotation": [0, 0.6, 0, 0.8]}],
 "cameras": [{"type": "perspective", "perspective": {"yfov": 0.8, "znear": 0.1}}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "material": 0}]}],
 "materials": [{"pbrMetallicRoughness": {"baseColorFactor": [1, 0, 0, 1], "baseColorTexture": {"index": 0}}, "doubleSided": true}],
 "textures": [{"source": 0}],
 "images": [{"uri": "data:image/png;base64,$(convert -size 2x2 xc:red png:- | base64 --wrap 0)"}],
 "animations": [{"channels": [{"sampler": 0, "target": {"node": 0, "path": "translation"}}], "samplers": [{"input": 2, "output": 1}]}],
 "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]},
               {"bufferView": 0, "byteOffset": 36, "componentType": 5126, "count": 2, "type": "VEC3"},
               {"bufferView": 0, "byteOffset": 60, "componentType": 5126, "count": 2, "type": "SCALAR", "min": [0], "max": [1]}],
 "bufferViews": [{"buffer": 0, "byteLength": 68}],
 "buffers": [{"byteLength": 68, "uri": "data:application/octet-stream;base64,$triangle"}],
 "extensions": {"KHR_lights_punctual": {"lights": [{"type": "spot", "intensity": 2, "spot": {"outerConeAngle": 0.5}}]}},
 "extensionsUsed": ["KHR_lights_punctual"]}
EOF
text="$(tr -d '\n' <gltf_fuzz/triangle.gltf)"
while ((${#text} % 4)); do
    text+=' '
done
{ printf glTF; uint32 2; uint32 $((20 + ${#text})); uint32 ${#text}; printf 'JSON%s' "$text"; } >gltf_fuzz/triangle.glb
cp "$root/examples/clouds/works.gltf" gltf_fuzz

cat >obj_fuzz/faces.obj <<'EOF'
mtllib faces.mtl
o a
v 0 0 0
v 1 0 0 1 0 0
v 1 1 0
v 0 1 0
vt 0 0
vt 1 1
vn 0 0 1
s 1
g b
usemtl red
f 1/1/1 2/2/1 3/2/1 -1/1/1
f 1//1 2//1 4//1
l 1 2 3
p 4
EOF
cat >obj_fuzz/faces.mtl <<'EOF'
newmtl red
Kd 1 0 0
Ke 0 0.5 0
d 0.5
Ns 10
Pr 0.3
map_Kd -s 2 2 1 -clamp on faces.png
EOF
cat >ply_fuzz/text.ply <<'EOF'
ply
format ascii 1.0
comment a square
element vertex 4
property float x
property float y
property float z
property uchar red
property uchar green
property uchar blue
element face 1
property list uchar int vertex_indices
end_header
0 0 0 255 0 0
1 0 0 255 0 0
1 1 0 0 255 0
0 1 0 0 0 255
4 0 1 2 3
EOF
{
    printf 'ply\nformat binary_little_endian 1.0\nelement vertex 3\n'
    printf 'property float %s\n' x y z
    printf 'element face 1\nproperty list uchar int vertex_indices\nend_header\n'
    floats 0 0 0 1 0 0 0 1 0
    printf '\3'
    uint32 0
    uint32 1
    uint32 2
} >ply_fuzz/binary.ply
cat >stl_fuzz/text.stl <<'EOF'
solid a
facet normal 0 0 1
outer loop
vertex 0 0 0
vertex 1 0 0
vertex 0 1 0
endloop
endfacet
endsolid a
EOF
{ printf '%-80s' a; uint32 1; floats 0 0 1 0 0 0 1 0 0 0 1 0; printf '\0\0'; } >stl_fuzz/binary.stl

# A byte before them tells what these are: FBX, DAE, or what the process that reads them sends.
printf '\1%s' '<?xml version="1.0"?><COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1"><library_geometries>
<geometry id="g"><mesh><source id="p"><float_array id="f" count="9">0 0 0 1 0 0 0 1 0</float_array><technique_common>
<accessor source="#f" count="3" stride="3"><param name="X" type="float"/><param name="Y" type="float"/><param name="Z" type="float"/>
</accessor></technique_common></source><vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<triangles count="1"><input semantic="VERTEX" source="#v" offset="0"/><p>0 1 2</p></triangles></mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="s"><node id="n"><instance_geometry url="#g"/></node></visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#s"/></scene></COLLADA>' >assimp_fuzz/triangle.dae
printf '\0%s' '; FBX 7.3.0 project file
FBXHeaderExtension:  { FBXVersion: 7300 }
GlobalSettings:  { Version: 1000 }
Objects:  {
    Geometry: 1, "Geometry::a", "Mesh" { Vertices: *9 { a: 0,0,0,1,0,0,0,1,0 } PolygonVertexIndex: *3 { a: 0,1,-3 } }
    Model: 2, "Model::a", "Mesh" { Version: 232 }
}
Connections:  { C: "OO",2,0
    C: "OO",1,2
}' >assimp_fuzz/triangle.fbx
{ printf '\2'; head --bytes 256 /dev/zero; } >assimp_fuzz/sent

# Numbers that scenes are made of.
for start in 0 64 128; do
    # shellcheck disable=SC2059 # the format is the bytes
    printf "$(printf '\\x%02x' $(seq $start $((start + 127))))" >"scene_fuzz/$start"
done

# Styles, terrains.
cp "$root"/presets/*.toml style_fuzz
printf '!hatch.width_mm=0.5\nline.color=#336699\npaper.grain=0\n' >style_fuzz/set
cp "$root"/examples/{dunes,water,clouds}/*.toml terrain_fuzz

# Tonal art maps, which have a byte before them too: archive, DDS, manifest, PNG files behind their lengths.
printf '[map]\nversion = 1\nsize_px = 32\nthresholds = false\n[darkness]\ntone1 = 0.5\n' >tam.toml
entries=(tam.toml)
for level in 0 1 2 3 4 5; do
    "${picture[@]}" -resize $((32 >> level))x$((32 >> level))! "tone1_level$level.png"
    entries+=("tone1_level$level.png")
done
cmake -E tar cf map.zip --format=zip "${entries[@]}"
"${picture[@]}" -define dds:compression=none -define dds:mipmaps=0 map.dds
{ printf '\0'; cat map.zip; } >tam_fuzz/archive
{ printf '\1'; cat map.dds; } >tam_fuzz/dds
{ printf '\2'; cat tam.toml; } >tam_fuzz/manifest
{ printf '\3'; integer 16 "$(wc -c <tone1_level0.png)"; cat tone1_level0.png; } >tam_fuzz/folder
rm map.zip map.dds "${entries[@]}"
