// SPDX-License-Identifier: MIT
// What the stages of the hardware path share when many views are drawn at once.

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
