#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Batches that are killed at any moment leave whole pictures alone, and the next run draws all of them.
# Usage: batches.sh BUILD_FOLDER SEED SECONDS
set -euo pipefail
# shellcheck source=tests/soak/support.sh
source "$(dirname "${BASH_SOURCE[0]}")/support.sh"

"$bin/estampe_example_square" square.glb >/dev/null
"$bin/estampe_example_square" statue.glb statue >/dev/null
while ((SECONDS < end_s && failures == 0)); do
    rm -rf whole stopped
    mkdir -p whole/out stopped/out
    {
        printf '[defaults]\nsize = "%sx%s"\n' $((RANDOM % 100 + 40)) $((RANDOM % 60 + 30))
        printf '[[job]]\nscene = ["../square.glb", "../statue.glb"]\nstyle = ["%s", "%s"]\n' \
            "$(one_of comic pencil)" "$(one_of wash manga engraving)"
        printf 'output = "out/{scene}-{style}.%s"\n' "$(one_of png jpg exr ora)"
        printf '[[job]]\nscene = "../statue.glb"\nstyle = "pen-sketch"\noutput = "out/last.svg"\n'
    } | tee whole/jobs.toml >stopped/jobs.toml
    batch=("$estampe" batch jobs.toml --device cpu)
    (cd whole && "${batch[@]}") >printed 2>said || wrong "$(cat whole/jobs.toml): $(tail -3 said)"
    for ((try = 0; try < 3 && failures == 0; ++try)); do
        cd stopped
        disturb 6000 "${batch[@]}"
        mv printed said ..
        cd ..
        while read -r name; do
            cmp "whole/out/$name" "stopped/out/$name" || wrong "$name is not whole: $(cat whole/jobs.toml)"
        done < <(find stopped/out -name '.*' -prune -o -type f -printf '%f\n')
    done
    sleep 2.5
    (cd stopped && "${batch[@]}") >printed 2>said || wrong "does not end well: $(tail -3 said)"
    expect_no_parts stopped
    expect_same whole/out stopped/out "a batch that was stopped draws other pictures: $(cat whole/jobs.toml)"
done
[[ $failures -eq 0 ]]
