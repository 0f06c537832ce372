// SPDX-License-Identifier: MIT
// Declarations shared by the stages of the hardware path when it draws many views at once.

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
