// SPDX-License-Identifier: MIT
// 4 numbers are kept.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#define ALL(M) M(sa)

#include "lab_live.glsl"
