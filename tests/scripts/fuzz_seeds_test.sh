#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# What fuzzing starts from are files that can be read, for each target, or it would come no further than their first lines.
# Usage: fuzz_seeds_test.sh ESTAMPE_FOLDER ESTAMPE
set -euo pipefail
root="$1"
estampe="$2"
# shellcheck source=tests/support/harness.sh
source "$(dirname "${BASH_SOURCE[0]}")/../support/harness.sh"

bash "$root/tests/fuzz/make_corpus.sh" "$folder/seeds"
for source in "$root"/tests/fuzz/*_fuzz.cpp; do
    target="$(basename "$source" .cpp)"
    [[ -n "$(ls "$folder/seeds/$target" 2>/dev/null)" ]] || wrong "$target has no file to start from"
done
for kind in fbx dae; do
    tail --bytes +2 "$folder/seeds/assimp_fuzz/triangle.$kind" >"$folder/triangle.$kind"
done
convert -size 2x2 xc:red "$folder/seeds/obj_fuzz/faces.png"
for scene in "$folder"/seeds/{gltf,ply,stl}_fuzz/* "$folder"/seeds/obj_fuzz/*.obj "$folder"/triangle.*; do
    if ! "$estampe" info "$scene" >/dev/null 2>"$folder/err" || [[ -s "$folder/err" ]]; then
        wrong "$(basename "$scene"): $(cat "$folder/err")"
    fi
done
[[ $failures -eq 0 ]]
