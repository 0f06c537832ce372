// SPDX-License-Identifier: MIT
// Vertex shader of the triangles that make up the viewer's panels.
#version 460

layout(location = 0) in vec2 place_px;
layout(location = 1) in vec2 uv;
layout(location = 2) in vec4 color;
layout(location = 0) out vec4 out_color;
layout(location = 1) out vec2 out_uv;

layout(push_constant) uniform Constants
{
    vec2 clip_from_px;
    vec2 origin_px;
};

void main()
{
    out_color = color;
    out_uv = uv;
    gl_Position = vec4((place_px - origin_px) * clip_from_px - 1.0, 0.0, 1.0);
}
