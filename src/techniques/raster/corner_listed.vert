// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#define LISTED_BINDING 2
#include "techniques/raster/corner_listed.glsl"
