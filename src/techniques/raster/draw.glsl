// SPDX-License-Identifier: MIT
// What the stages of the hardware path share.

#include "techniques/raster/raster.glsl.h"
#include "shaders/mesh.glsl.h"

layout(scalar, binding = 0) readonly buffer Triangles
{
    uvec4 triangles[];
};

layout(scalar, binding = 1) readonly buffer PosedVertices
{
    PosedVertex posed_vertices[];
};

layout(push_constant, scalar) uniform Constants
{
    DrawConstants constants;
};

#define CLIP_FROM_ANCHOR constants.clip_from_anchor
#define PICTURE_PX constants.size_px
