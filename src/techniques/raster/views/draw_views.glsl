// SPDX-License-Identifier: MIT
// What the stages of the hardware path share when many views are drawn at once.

#include "techniques/raster/raster.glsl.h"

#define MESH_TEXELS_BINDING 0
#include "shaders/mesh_texels.glsl"

layout(scalar, binding = 2) readonly buffer Views
{
    RasterView views[];
};

layout(scalar, binding = 3) readonly buffer List
{
    ClusterInView list[];
};

layout(push_constant, scalar) uniform Constants
{
    ViewsConstants constants;
};
