// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_HEIGHT_PROGRAM_GLSL_H
#define ESTAMPE_HEIGHT_PROGRAM_GLSL_H
// A height graph's instructions, as every reader of a program has them.
#ifdef __cplusplus
#include "shaders/shared.hpp"
namespace estampe::shared {
#else
#include "shaders/shared.glsl"
#endif

SHARED_CONSTANT uint height_constant = 0U;
SHARED_CONSTANT uint height_add = 1U;
SHARED_CONSTANT uint height_subtract = 2U;
SHARED_CONSTANT uint height_multiply = 3U;
SHARED_CONSTANT uint height_divide = 4U;
SHARED_CONSTANT uint height_minimum = 5U;
SHARED_CONSTANT uint height_maximum = 6U;
SHARED_CONSTANT uint height_lerp = 7U;
SHARED_CONSTANT uint height_smoothstep = 8U;
SHARED_CONSTANT uint height_power = 9U;
SHARED_CONSTANT uint height_curve = 10U;
SHARED_CONSTANT uint height_sine = 11U;
SHARED_CONSTANT uint height_cosine = 12U;
SHARED_CONSTANT uint height_absolute = 13U;
SHARED_CONSTANT uint height_root = 14U;
SHARED_CONSTANT uint height_radius = 15U;
SHARED_CONSTANT uint height_angle = 16U;
SHARED_CONSTANT uint height_coordinate_u = 17U;
SHARED_CONSTANT uint height_coordinate_v = 18U;
SHARED_CONSTANT uint height_wave = 19U;
SHARED_CONSTANT uint height_noise = 20U;
SHARED_CONSTANT uint height_fbm = 21U;
SHARED_CONSTANT uint height_ridged = 22U;
SHARED_CONSTANT uint height_cellular = 23U;
SHARED_CONSTANT uint height_texture = 24U;
SHARED_CONSTANT uint height_dunes = 25U;

SHARED_CONSTANT uint height_no_register = 0xffffffffU;
SHARED_CONSTANT uint height_register_count = 32U;

// A program in words: places, parameters, four words an instruction.
SHARED_CONSTANT uint height_words_most = 16000U; // within 64 KiB of uniforms
SHARED_CONSTANT uint height_words_a_place = 16U;
SHARED_CONSTANT uint height_place_words = 16U;

// What an instruction does, and where its result goes. Registers `inputs` and `warp`, the last two of which
// are height_no_register where the place is not warped; `parameter` begins the parameters.
struct HeightInstruction {
    uint op;
    uint target;
    uvec3 inputs;
    uvec2 warp;
    uint parameter;
    uint place;
    uint count; // points of a curve
};

#ifdef __cplusplus
} // namespace estampe::shared
#endif

#endif
