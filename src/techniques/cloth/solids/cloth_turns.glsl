// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_CLOTH_TURNS
#define ESTAMPE_CLOTH_TURNS

// Rotates a vector by a quaternion with the scalar last.
vec3 turned(vec4 rotation, vec3 v)
{
    return v + 2.0 * cross(rotation.xyz, cross(rotation.xyz, v) + rotation.w * v);
}

vec3 turned_back(vec4 rotation, vec3 v)
{
    return turned(vec4(-rotation.x, -rotation.y, -rotation.z, rotation.w), v);
}

#endif
