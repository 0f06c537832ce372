// SPDX-License-Identifier: MIT
// 32 numbers are kept.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#define ALL(M) M(sa) M(sb) M(sc) M(sd) M(se) M(sf) M(sg) M(sh)

#include "lab_live.glsl"
