#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Films that are killed at any moment and go on with --resume have the bytes of films that are not.
# Usage: films.sh BUILD_FOLDER SEED SECONDS
set -euo pipefail
# shellcheck source=tests/soak/support.sh
source "$(dirname "${BASH_SOURCE[0]}")/support.sh"

"$bin/estampe_example_square" scene.glb >/dev/null
while ((SECONDS < end_s && failures == 0)); do
    style="$(one_of comic pencil flowing-ink wash manga)"
    to="$(one_of film.gif film.mp4 '%03d.png')"
    film=("$estampe" render ../scene.glb -o "$to" --turntable --frames "$((RANDOM % 10 + 4))" --style "$style"
        --size "$((RANDOM % 60 + 40))x$((RANDOM % 40 + 30))" --device cpu)
    rm -rf whole stopped
    mkdir whole stopped
    (cd whole && "${film[@]}") >printed 2>said || wrong "${film[*]}: $(tail -3 said)"
    status=137
    for ((try = 0; try < 12 && status != 0 && failures == 0; ++try)); do
        cd stopped
        disturb 4000 "${film[@]}" --resume
        mv printed said ..
        cd ..
    done
    sleep 2.5 # what a killed program has left is removed by the next once it is older than 2 s
    (cd stopped && "${film[@]}" --resume) >printed 2>said || wrong "does not go on: ${film[*]}: $(tail -3 said)"
    expect_no_parts stopped
    expect_same whole stopped "a film that was stopped is another: ${film[*]}"
done
[[ $failures -eq 0 ]]
