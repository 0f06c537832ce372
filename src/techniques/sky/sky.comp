// SPDX-License-Identifier: MIT
// One thread paints one pixel of the background: a wash from the horizon to the zenith, and long level
// strokes that thin out towards the light.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/camera.glsl"
#include "shaders/line_ink.glsl"
#include "techniques/sky/sky.glsl.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(scalar, binding = 0) uniform Frame
{
    FrameGlobals frame;
};

layout(binding = 1, rgba16f) writeonly uniform image2D out_wash;
layout(binding = 2, r16f) writeonly uniform image2D out_ink;

layout(push_constant, scalar) uniform Constants
{
    SkyConstants constants;
};

// By a point far off: of one near the eye, what the two places have in common would use up the digits.
vec3 direction_at(vec2 position_px)
{
    return -towards_eye(frame, anchor_at(frame, position_px, 1e-5));
}

// Height above the horizon, bent so that the strokes bow like a vault.
vec2 vault(vec3 d)
{
    return vec2(atan(d.x, -d.z), d.y / (0.35 + length(d.xz)));
}

// Along the strokes: the bearing, which must jump by a turn somewhere. It does so behind, at a place of its
// own for each height, so that no two strokes break at the same bearing.
float along_strokes(vec2 here)
{
    float middle = 1.2 * sin(53.0 * here.y);
    return here.x + 6.2831853 * round((middle - here.x) / 6.2831853);
}

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(uvec2(pixel), frame.size_px))) {
        return;
    }
    vec2 position = vec2(pixel) + 0.5;
    vec3 d = direction_at(position);
    float height = clamp(d.y * 1.9, 0.0, 1.0);
    vec3 wash = mix(constants.horizon_color, constants.zenith_color, smoothstep(0.0, 1.0, sqrt(height)));
    vec2 here = vault(d);
    vec2 right = vault(direction_at(position + vec2(1.0, 0.0))) - here;
    vec2 down = vault(direction_at(position + vec2(0.0, 1.0))) - here;
    right.x -= 6.2831853 * round(right.x / 6.2831853);
    down.x -= 6.2831853 * round(down.x / 6.2831853);
    vec2 gradient = vec2(right.y, down.y);
    LineField field;
    field.v = here.y;
    field.v_per_px = length(gradient);
    vec2 along = vec2(-gradient.y, gradient.x) / max(field.v_per_px, 1e-12);
    field.u = along_strokes(here);
    field.u_per_px = abs(right.x * along.x + down.x * along.y);
    field.wander = vec2(field.u, here.y);
    field.wraps = false;
    float towards_light =
        0.5 + 0.5 * dot(normalize(vec3(d.x, 0.0, d.z) + 1e-6),
                        normalize(vec3(constants.towards_sun.x, 0.0, constants.towards_sun.z) + 1e-6));
    float dark = constants.darkness * smoothstep(0.04, 0.55, height) * mix(1.0, 0.25, towards_light);
    float pen = constants.stroke_width_px;
    float ink =
        line_ink(field, LineLook(pen, 0.9 * pen, 26.0 * pen, 40.0 * pen, 190.0 * pen, 0.35, 0.0), dark, 77u);
    imageStore(out_wash, pixel, vec4(wash, 1.0));
    imageStore(out_ink, pixel, vec4(ink));
}
