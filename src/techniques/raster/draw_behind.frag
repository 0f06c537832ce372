// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#define RASTER_MASKED
#define RASTER_BEHIND
#include "techniques/raster/draw_fragment.glsl"
