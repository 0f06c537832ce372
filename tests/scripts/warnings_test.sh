#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Who builds Estampe to use it is stopped by no warning, of C++ or of shaders; who works on it is.
# Usage: warnings_test.sh CMAKE ESTAMPE_FOLDER
set -euo pipefail
cmake="$1"
root="$2"
# shellcheck source=tests/support/harness.sh
source "$(dirname "${BASH_SOURCE[0]}")/../support/harness.sh"

# configure PRESET [OPTION...]
configure() {
    "$cmake" -S "$root" -B "$folder/build" --fresh --preset "$@" >"$folder/log" 2>&1 || { cat "$folder/log" >&2; exit 1; }
}
# strict: how many kinds of command, of the compiler's and glslc's, treat warnings as errors
strict() {
    local kinds=0
    ! grep -q '^  FLAGS = .* -Werror' "$folder/build/build.ninja" || kinds=$((kinds + 1))
    ! grep -q 'COMMAND = .*glslc.* -Werror' "$folder/build/build.ninja" || kinds=$((kinds + 1))
    echo "$kinds"
}

for preset in release package test; do
    configure "$preset"
    [[ $(strict) -eq 0 ]] || wrong "the preset $preset stops at warnings"
done
for preset in "test -DESTAMPE_WERROR=ON" dev asan tsan; do
    # shellcheck disable=SC2086 # a preset, and an option
    configure $preset
    [[ $(strict) -eq 2 ]] || wrong "$preset: $(strict) of two kinds of warning are errors"
done
configure dev -DCMAKE_CXX_COMPILER_{ID_RUN=1,ID=GNU,VERSION=15.1} -DCMAKE_CXX_{STANDARD_COMPUTED_DEFAULT=17,EXTENSIONS_COMPUTED_DEFAULT=ON} -DCMAKE_EXECUTABLE_FORMAT=ELF
[[ $(strict) -eq 1 ]] || wrong "warnings of a compiler that is not known here are errors"
[[ $failures -eq 0 ]]
