#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# A project that adds Estampe needs nothing that only tests and the program need, and is compiled with the public headers'
# wants alone: no warnings of ours, no folder of src/. Usage: configure_test.sh CMAKE ESTAMPE_FOLDER
set -euo pipefail
cmake="$1"
root="$2"
build="$(mktemp -d)"
trap 'rm -rf "$build"' EXIT

without=()
for package in GTest embree; do
    without+=("-DCMAKE_DISABLE_FIND_PACKAGE_$package=ON")
done
"$cmake" -S "$root/examples/embed" -B "$build" -G Ninja -DCMAKE_EXPORT_COMPILE_COMMANDS=ON "${without[@]}" >"$build/log" 2>&1 ||
    { cat "$build/log"; exit 1; }

failures=0
wrong() {
    echo "FAILED: $*" >&2
    failures=$((failures + 1))
}
command="$(grep '"command".*embed/main\.cpp' "$build/compile_commands.json" || true)"
[[ "$command" == *"-I$root/include"* ]] || wrong "the public headers are not found: $command"
[[ "$command" == *std=*++20* ]] || wrong "it is not C++20: $command"
[[ "$command" == *-DGLM_FORCE_DEPTH_ZERO_TO_ONE* ]] || wrong "GLM is set up otherwise than in the library: $command"
for unwanted in -Werror -Wconversion "-I$root/src" "$build/estampe/src" ccache; do
    [[ "$command" != *"$unwanted"* ]] || wrong "$unwanted reaches a project that adds Estampe: $command"
done
for target in estampe_unit_tests estampe_example_square bin/estampe estampe_python; do
    ! grep -q "$target" "$build/build.ninja" || wrong "$target is built for a project that adds Estampe"
done
! grep -q estampe_baking "$build/build.ninja" || wrong "baking is built for a project that did not ask for it"
"$cmake" -S "$root/examples/embed" -B "$build/baking" -G Ninja -DESTAMPE_BAKE=ON >"$build/log" 2>&1 || { cat "$build/log"; exit 1; }
grep -q estampe_baking "$build/baking/build.ninja" || wrong "baking is not built for a project that asked for it"
[[ $failures -eq 0 ]]
