#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# On a device of the application that embeds it Estampe draws the picture that the program draws, and the validation layer
# has nothing to say. Usage: host_device_test.sh HOST_DEVICE MAKE_EXAMPLE ESTAMPE
set -euo pipefail
host_device="$1"
estampe="$3"
folder="$(mktemp -d)"
trap 'rm -rf "$folder"' EXIT
"$2" "$folder/scene.glb" >/dev/null

VK_INSTANCE_LAYERS=VK_LAYER_KHRONOS_validation \
    VK_LAYER_ENABLES=VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT \
    "$host_device" "$folder/scene.glb" "$folder/picture.png" >"$folder/said" 2>&1
[[ ! -s "$folder/said" ]] || { echo "FAILED: $(head -5 "$folder/said")" >&2; exit 1; }

"$estampe" render "$folder/scene.glb" --style comic --camera auto --size 320x180 -o "$folder/program.png"
cmp "$folder/picture.png" "$folder/program.png" || { echo "FAILED: another picture than the program's" >&2; exit 1; }
