// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_SUGGESTIVE
#define ESTAMPE_SUGGESTIVE

// Finds where the radial curvature of a surface changes its sign, and where the terrain starts to fall
// steeply along the wind. The results are `precise` (no fused multiply-add), because two shaders must compute
// exactly equal values. Requires before inclusion: VIEW_BENDS_BINDING (two words per vertex, written by
// view_bends.comp and crests.comp) and `constants`, a ChainConstants.

layout(binding = VIEW_BENDS_BINDING) uniform usamplerBuffer view_bend_texels;

// Returns the radial curvature at a vertex, and the strength of a line, which must be positive. For terrain,
// returns two values: how steeply the ground falls along the wind, minus half the slope of a slip face (steep
// lee side); and the position along the wind.
vec2 view_bend_at(uint vertex)
{
    return uintBitsToFloat(texelFetch(view_bend_texels, int(vertex)).xy);
}

bool is_of_ground(uint vertex)
{
    return vertex >= constants.first_crest_vertex;
}

struct BendCrossing {
    uint low; // index of the vertex with the lower number
    uint high;
    float share; // position of the crossing between the vertices `low` (0) and `high` (1)
    float strength;
};

// The point between two vertices where the curvature is zero. Both triangles at the edge compute exactly
// equal points.
BendCrossing bend_crossing(uint i, uint j)
{
    uint low = min(i, j);
    uint high = max(i, j);
    vec2 a = view_bend_at(low);
    vec2 b = view_bend_at(high);
    precise float share = clamp(a.x / (a.x - b.x), 0.0, 1.0);
    precise float strength = a.y + share * (b.y - a.y);
    if (is_of_ground(low)) {
        // The change of slope is positive across a dune's crest and negative at the foot of its slip face
        // (steep lee side).
        precise float turn = b.x - a.x;
        strength = (b.y < a.y ? -turn : turn) - constants.least_turn;
    }
    return BendCrossing(low, high, share, strength);
}

// The two sides of a triangle on which the curvature changes its sign. Each side is stored as the number of
// the corner at which the side starts.
struct BendSides {
    uint down; // corner before the side on which curvature changes from positive to negative
    uint up;
    bool are_there;
};

BendSides bend_sides(uvec4 corners)
{
    bvec3 positive = bvec3(view_bend_at(corners.x).x >= 0.0, view_bend_at(corners.y).x >= 0.0,
                           view_bend_at(corners.z).x >= 0.0);
    bool has_area = corners.x != corners.y && corners.y != corners.z && corners.z != corners.x;
    uint down = positive.x && !positive.y ? 0u : positive.y && !positive.z ? 1u : 2u;
    uint up = !positive.x && positive.y ? 0u : !positive.y && positive.z ? 1u : 2u;
    return BendSides(down, up, has_area && any(positive) && !all(positive));
}

#endif
