// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_SUGGESTIVE
#define ESTAMPE_SUGGESTIVE

// Where the radial curvature of a surface changes its sign, or the terrain starts to fall steeply along the
// wind. Results on which two shaders must agree are computed without contraction. Requires before inclusion:
// VIEW_BENDS_BINDING (two words per vertex, written by view_bends.comp and crests.comp) and `constants`, of
// ChainConstants.

layout(binding = VIEW_BENDS_BINDING) uniform usamplerBuffer view_bend_texels;

// Radial curvature, and a strength that must be positive for a line. For terrain: how much steeper than half
// a slip face it falls along the wind, and its position along the wind.
vec2 view_bend_at(uint vertex)
{
    return uintBitsToFloat(texelFetch(view_bend_texels, int(vertex)).xy);
}

bool is_of_ground(uint vertex)
{
    return vertex >= constants.first_crest_vertex;
}

struct BendCrossing {
    uint low; // vertices
    uint high;
    float share; // position from low to high
    float strength;
};

// The zero between two vertices of opposite sign; equal for both triangles.
BendCrossing bend_crossing(uint i, uint j)
{
    uint low = min(i, j);
    uint high = max(i, j);
    vec2 a = view_bend_at(low);
    vec2 b = view_bend_at(high);
    precise float share = clamp(a.x / (a.x - b.x), 0.0, 1.0);
    precise float strength = a.y + share * (b.y - a.y);
    if (is_of_ground(low)) {
        precise float turn = b.x - a.x; // positive across a crest, negative at the end of a slip face
        strength = (b.y < a.y ? -turn : turn) - constants.least_turn;
    }
    return BendCrossing(low, high, share, strength);
}

// Corners at the start of the sides on which the sign changes.
struct BendSides {
    uint down; // from positive curvature to negative
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
