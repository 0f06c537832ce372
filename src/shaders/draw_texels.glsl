// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_DRAW_TEXELS
#define ESTAMPE_DRAW_TEXELS

// Reads draw records (one per draw call) as texels of four 32-bit words. Requires DRAW_TEXELS_BINDING.

#include "shaders/scene.glsl.h"

layout(binding = DRAW_TEXELS_BINDING) uniform usamplerBuffer draw_texels;

// The fields of a DrawRecord that shading reads.
struct DrawPart {
    uint first_posed_vertex;
    uint first_rest_vertex;
    uint material;
    uint object;
};

DrawPart draw_at(uint draw)
{
    uvec4 words = texelFetch(draw_texels, int(7u * draw + 4u));
    return DrawPart(words.x, words.y, words.z, words.w);
}

// The fields of a DrawRecord that are read to pose its vertices.
struct DrawPose {
    mat4 anchor_from_object;
    uint vertex_count;
    uint first_skin_vertex;
    uint first_joint;
    uint first_morph_offset;
    uint morph_target_count;
    uint first_morph_weight;
};

DrawPose draw_pose_at(uint draw)
{
    int first = int(7u * draw);
    mat4 place;
    for (int column = 0; column < 4; ++column) {
        place[column] = uintBitsToFloat(texelFetch(draw_texels, first + column));
    }
    uvec4 lists = texelFetch(draw_texels, first + 5);
    uvec2 morph = texelFetch(draw_texels, first + 6).xy;
    return DrawPose(place, lists.x, lists.y, lists.z, lists.w, morph.x, morph.y);
}

// The fields of a DrawRecord that link it to lights.
struct DrawLinks {
    uint flags;
    uint groups;
};

DrawLinks draw_links_at(uint draw)
{
    uvec4 words = texelFetch(draw_texels, int(7u * draw + 6u));
    return DrawLinks(words.z, words.w);
}

#endif
