// SPDX-License-Identifier: MIT
// Declarations shared by the stages of the hardware path.

#include "techniques/raster/raster.glsl.h"

#define MESH_TEXELS_BINDING 0
#include "shaders/mesh_texels.glsl"

layout(push_constant, scalar) uniform Constants
{
    DrawConstants constants;
};

#define CLIP_FROM_ANCHOR constants.clip_from_anchor
#define PICTURE_PX constants.size_px
#define LEAST_ALPHA constants.least_alpha
#define ALPHA_BELOW constants.alpha_below
