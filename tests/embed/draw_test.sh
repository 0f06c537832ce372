#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# The example of embedding draws a picture, and says what is wrong. Usage: draw_test.sh EMBED MAKE_EXAMPLE
set -euo pipefail
embed="$1"
folder="$(mktemp -d)"
trap 'rm -rf "$folder"' EXIT
"$2" "$folder/scene.glb" >/dev/null

"$embed" "$folder/scene.glb" "$folder/picture.png"
[[ "$(head -c 4 "$folder/picture.png" | tail -c 3)" == PNG ]] || { echo "FAILED: picture.png is no PNG" >&2; exit 1; }

status=0
"$embed" "$folder/missing.glb" "$folder/none.png" 2>"$folder/err" || status=$?
if [[ $status -ne 1 || -e "$folder/none.png" ]] || ! grep -q 'missing.glb' "$folder/err"; then
    echo "FAILED: status $status for a missing scene: $(cat "$folder/err")" >&2
    exit 1
fi
