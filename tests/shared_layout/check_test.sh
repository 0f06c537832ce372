#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# The check of shared structs sees a member that C++ puts elsewhere, a struct of another size, and a block in another layout.
# Usage: check_test.sh GLSLC SPIRV_DIS CXX ESTAMPE_FOLDER
set -euo pipefail
check="$(cd "$(dirname "$0")" && pwd)/check"
tree="$(mktemp -d)"
trap 'rm -rf "$tree"' EXIT
mkdir -p "$tree/src/shaders" "$tree/src/techniques/dots"
cp "$4"/src/shaders/shared.{hpp,glsl} "$tree/src/shaders/"

# write_struct MEMBERS: a header whose struct has them
write_struct() {
    cat >"$tree/src/techniques/dots/dots.glsl.h" <<END
#ifndef DOTS_GLSL_H
#define DOTS_GLSL_H
#ifdef __cplusplus
#include "shaders/shared.hpp"
namespace estampe::shared {
#endif

struct Dots {
    $1
};

#ifdef __cplusplus
} // namespace estampe::shared
#endif
#endif
END
}

# write_block LAYOUT: a shader that pushes it
write_block() {
    cat >"$tree/src/techniques/dots/dots.comp" <<END
#version 460
#extension GL_EXT_scalar_block_layout : require
#include "techniques/dots/dots.glsl.h"
layout($1) uniform Constants
{
    Dots dots;
};
void main() {}
END
}

failures=0
# expect_refused WHAT WORDS: the check fails and says so
expect_refused() {
    if bash "$check" "${programs[@]}" "$tree" 2>"$tree/log" || ! grep -qF -- "$2" "$tree/log"; then
        echo "not seen: $1"
        cat "$tree/log"
        failures=1
    fi
}
programs=("$1" "$2" "$3")

write_struct 'vec3 color; float width_px; vec2 place;'
write_block 'push_constant, scalar'
bash "$check" "${programs[@]}" "$tree" || { echo "a right struct was refused"; exit 1; }

write_struct "$(printf 'vec3 color;\n#ifdef __cplusplus\n    float gap;\n#endif\n    float width_px;')"
expect_refused "a member elsewhere" 'offsetof(Dots, width_px) == 12'

write_struct "$(printf 'float width_px;\n#ifdef __cplusplus\n    float gap;\n#endif')"
expect_refused "another size" 'sizeof(Dots) == 4'

write_struct "$(printf '#ifndef __cplusplus\n    float width_px;\n#else\n    double width_px;\n#endif')"
expect_refused "a wider member" 'sizeof(Dots) == 4'

write_struct 'float width_px;'
write_block 'push_constant'
expect_refused "a block that is not scalar" 'dots.comp:6: Dots is in a block that is not scalar'
exit "$failures"
