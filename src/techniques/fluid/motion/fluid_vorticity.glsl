// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_FLUID_VORTICITY
#define ESTAMPE_FLUID_VORTICITY

// Vorticity confinement in the plane; for volumes see fluid_confine.comp. Needs what fluid_fields.glsl needs,
// is included after it, and needs `velocity`. Source: Steinhoff and Underhill, "Modification of the Euler
// equations for vorticity confinement", Physics of Fluids 6, 1994.

// Vorticity of unit cells at the low corner of a cell.
float vorticity_at(ivec2 corner)
{
    ivec2 size = fluid_size().xy;
    ivec2 kept = ivec2(is_periodic(0) ? corner.x : clamp(corner.x, 0, size.x),
                       is_periodic(1) ? corner.y : clamp(corner.y, 0, size.y));
    vec4 across = plane_nodes(velocity, 0, kept - ivec2(0, 1), 0);
    vec4 up = plane_nodes(velocity, 1, kept - ivec2(1, 0), 1);
    return (up.y - up.x) - (across.z - across.x);
}

// Towards where there is more of it, no longer than 1.
vec2 towards_vortex(vec2 gradient)
{
    return gradient * inversesqrt(dot(gradient, gradient) + 1e-12);
}

// At the faces of a cell towards lower x and lower y, each component on its own.
vec2 confining_force(ivec3 cell)
{
    float at[9];
    for (int i = 0; i < 9; ++i) {
        at[i] = vorticity_at(cell.xy + ivec2(i % 3, i / 3) - 1);
    }
    float here = abs(at[4]);
    float above = abs(at[7]);
    float right = abs(at[5]);
    vec2 on_x = vec2(0.25 * (abs(at[5]) + abs(at[8]) - abs(at[3]) - abs(at[6])), above - here);
    vec2 on_y = vec2(right - here, 0.25 * (abs(at[7]) + abs(at[8]) - abs(at[1]) - abs(at[2])));
    return vec2(towards_vortex(on_x).y * 0.5 * (at[4] + at[7]),
                -towards_vortex(on_y).x * 0.5 * (at[4] + at[5]));
}

#endif
