// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_INK_CUBE
#define ESTAMPE_INK_CUBE

// A cube map of ink around the eye. The order of faces is +x, -x, +y, -y, +z, -z. The position `at` runs from
// -1 to 1 over a face, and beyond that range in the face's gutters (extra cells beyond the edges).

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
    uint axis = size.x >= size.y && size.x >= size.z ? 0u : size.y >= size.z ? 1u : 2u;
    float along = axis == 0u ? direction.x : axis == 1u ? direction.y : direction.z;
    vec2 across = axis == 0u   ? vec2(direction.y, direction.z)
                  : axis == 1u ? vec2(direction.z, direction.x)
                               : vec2(direction.x, direction.y);
    FacePlace place;
    place.face = 2u * axis + (along > 0.0f ? 0u : 1u);
    place.at = across / abs(along);
    return place;
}

#endif
