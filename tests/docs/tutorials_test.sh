#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Runs the tutorials: all blocks that are marked "sh" of each page of docs/tutorials, and of docs/how-to/methods.md, in
# their order, in an empty folder per page. A command of estampe has to succeed and to leave the file that it names with -o.
# Blocks that are marked "sh-build" are not run: what builds a program is tested by tests/embed and tests/install, and the
# others need a display, a file of the reader's or much time.
# Usage: tutorials_test.sh ESTAMPE_FOLDER ESTAMPE MAKE_EXAMPLE
set -euo pipefail
docs="$1/docs"
program="$(realpath "$2")"
make_example="$(realpath "$3")"
# shellcheck source=tests/support/harness.sh
source "$(dirname "${BASH_SOURCE[0]}")/../support/harness.sh"

# The program as the pages call it, on the processor on every machine.
estampe() {
    local device=()
    [[ $1 != render ]] || device=(--device cpu)
    "$program" "$@" "${device[@]}" || { echo "status $?: estampe $*"; return 1; }
    while [[ $# -gt 1 ]]; do
        [[ $1 != -o || -s ${2/'%04d'/0001} ]] || { echo "estampe left no $2"; return 1; }
        shift
    done
}
estampe_example_square() {
    "$make_example" "$@"
}
export program make_example
export -f estampe estampe_example_square

for page in "$docs"/tutorials/*.md "$docs"/how-to/methods.md; do
    name="$(basename "$page" .md)"
    mkdir "$folder/$name"
    awk '/^```/ { inside = !inside; run = inside && $0 == "```sh"; next } run' "$page" >"$folder/$name.sh"
    [[ -s "$folder/$name.sh" ]] || grep -q '^```sh-build$' "$page" || wrong "$name has no commands"
    (cd "$folder/$name" && bash -eu "../$name.sh") >"$folder/$name.log" 2>&1 || wrong "$name: $(tail -5 "$folder/$name.log")"
done
[[ $failures -eq 0 ]] || exit 1
echo "$(cat "$folder"/*.sh | grep -c "^estampe") commands of the tutorials ran."
