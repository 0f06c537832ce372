// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_INK_CUBE
#define ESTAMPE_INK_CUBE

// A cube around the eye: face 0 is +x, then -x, +y, -y, +z, -z. On a face `at` runs from -1 to 1, and beyond
// that in its gutters.

struct FacePlace {
    uint face;
    vec2 at;
};

vec3 face_direction(uint face, vec2 at)
{
    float side = (face & 1u) == 0u ? 1.0f : -1.0f;
    return face < 2u ? vec3(side, at.x, at.y) : face < 4u ? vec3(at.y, side, at.x) : vec3(at.x, at.y, side);
}

FacePlace face_place(vec3 direction)
{
    vec3 size = abs(direction);
    if (size.x >= size.y && size.x >= size.z) {
        return FacePlace(direction.x > 0.0f ? 0u : 1u, vec2(direction.y, direction.z) / size.x);
    }
    if (size.y >= size.z) {
        return FacePlace(direction.y > 0.0f ? 2u : 3u, vec2(direction.z, direction.x) / size.y);
    }
    return FacePlace(direction.z > 0.0f ? 4u : 5u, vec2(direction.x, direction.y) / size.z);
}

#endif
