// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_SHADED_ROUND
#define ESTAMPE_SHADED_ROUND

// Whether the shading of a surface goes around the bends of a line along edges of the mesh. Requires before
// inclusion: mesh_texels.glsl, shaders/unit.glsl, `neighbor_texels`.

const float one_normal_cosine = 0.99;      // between normals that count as one
const float least_bend_along_normal = 0.5; // a line that bends within its surface has a corner there
const float straight_bend = 0.01;          // a smaller bend, in radians, is none

// Normal by the shading of the surface beside an edge of the mesh, at the end of the edge that lies at
// `place`.
vec3 shading_normal(uint side, vec3 place)
{
    uvec4 corners = triangle_at(side >> 2);
    PosedVertex a = posed_vertex_at(corners[side & 3u]);
    PosedVertex b = posed_vertex_at(corners[(side + 1u & 3u) % 3u]);
    vec3 to_a = a.position - place;
    vec3 to_b = b.position - place;
    return unpack_normal(dot(to_a, to_a) <= dot(to_b, to_b) ? a.normal : b.normal);
}

// Whether the shading of a surface goes around the bend between two edges of a line. Along the rim of a
// cylinder, the two edges have a common normal of the cylinder's side at the point where they meet, and the
// bend is towards it. `bend` is the unit vector to which the line turns.
bool is_shaded_round(uvec2 sides, vec3 place, vec3 bend)
{
    // Normals of the surfaces on both sides of each edge.
    vec3 normals[4];
    for (int k = 0; k < 2; ++k) {
        uint own = sides[k];
        uint beyond = texelFetch(neighbor_texels, int(own >> 2))[own & 3u];
        normals[2 * k] = shading_normal(own, place);
        normals[2 * k + 1] = shading_normal(beyond != no_side ? beyond : own, place);
    }
    bool is_round = false;
    for (int i = 0; i < 4; ++i) {
        vec3 arriving = normals[i & 1];
        vec3 leaving = normals[2 + (i >> 1)];
        is_round = is_round || (dot(arriving, leaving) > one_normal_cosine &&
                                abs(dot(arriving, bend)) > least_bend_along_normal);
    }
    return is_round;
}

// Whether a line is round where one of its pieces goes over into the next. `sources` are the members `source`
// of both pieces, `from`, `place` and `to` the positions where they begin, meet and end. Lines within
// triangles are round.
bool is_round_at(uvec2 sources, vec3 from, vec3 place, vec3 to)
{
    bvec2 crosses = equal(sources & 3u, uvec2(3u));
    vec3 bend = unit(to - place) - unit(place - from);
    float turn = size_of(bend);
    if (any(crosses) || turn < straight_bend) {
        return crosses.x == crosses.y;
    }
    return is_shaded_round(sources & 0x0fffffffu, place, bend / turn);
}

#endif
