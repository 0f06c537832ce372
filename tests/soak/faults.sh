#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Calls that fail, with other numbers of calls in each round.
# Usage: faults.sh BUILD_FOLDER SEED SECONDS
set -euo pipefail
cold=() # of five rounds one compiles all shaders in each run
(($2 % 5 > 0)) || cold=(--cold)
exec python3 "$(dirname "${BASH_SOURCE[0]}")/../cli/faults_test.py" "$1/bin/estampe" "$1/layer" --seed "$2" --seconds "$3" \
    --most 1 "${cold[@]}"
