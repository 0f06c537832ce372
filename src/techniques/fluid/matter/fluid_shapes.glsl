// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_FLUID_SHAPES
#define ESTAMPE_FLUID_SHAPES

// Obstacles and sources of a fluid as distance functions. Requires `shape_list`, a buffer of FluidShape, and
// `shapes`, a FluidShapes. Include after fluid_fields.glsl. In 2D z is ignored.

vec3 centre_of(FluidShape shape)
{
    return shape.centre_m + shapes.age_s * shape.speed;
}

// Distance of a place from the surface of an obstacle or a source; negative inside.
float distance_to(FluidShape shape, vec3 place_m)
{
    float angle = shape.angle_rad + shapes.age_s * shape.spin;
    vec3 off = place_m - centre_of(shape);
    vec3 turned =
        vec3(cos(angle) * off.x + sin(angle) * off.y, cos(angle) * off.y - sin(angle) * off.x, off.z);
    vec3 beyond = abs(turned) - shape.half_m;
    beyond.z = is_volume() ? beyond.z : min(beyond.x, beyond.y);
    vec3 outside = is_volume() ? max(beyond, 0.0) : vec3(max(beyond.xy, 0.0), 0.0);
    return length(outside) + min(max(beyond.x, max(beyond.y, beyond.z)), 0.0) - shape.radius_m;
}

vec3 speed_of(FluidShape shape, vec3 place_m)
{
    vec3 off = place_m - centre_of(shape);
    return shape.speed + shape.spin * vec3(-off.y, off.x, 0.0);
}

// Share of a cell that a source covers.
float cover_of(FluidShape shape, vec3 place_m)
{
    return clamp(0.5 - distance_to(shape, place_m) / shapes.cell_m, 0.0, 1.0);
}

#endif
