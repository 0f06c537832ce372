// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_OUTLINE_EDGE
#define ESTAMPE_OUTLINE_EDGE

// Edges at which shading breaks. Such an edge is outline where the surface on the one side faces the eye and
// that on the other does not, each by its own normals. With the outline through triangles these parts close
// around all that faces the eye. Wanted before: `frame`, mesh_texels.glsl, silhouette.glsl, facing.glsl, and
// whether outlines run `along_edges` of the mesh only.

uint next_corner(uint corner)
{
    return corner == 2u ? 0u : corner + 1u;
}

// Whether a triangle's corners run clockwise as seen from its front.
bool is_reversed(uint triangle)
{
    bool is_turned = (texelFetch(neighbor_texels, int(triangle)).w & NEIGHBOR_IS_TURNED) != 0u;
    return is_turned != ((triangle_at(triangle).w & TRIANGLE_MIRRORED) != 0u);
}

// Whether a triangle's normals point to its back, as those of triangles that a file has turned over do.
bool is_inside_out(uint triangle)
{
    uvec4 corners = triangle_at(triangle);
    PosedVertex a = posed_vertex_at(corners.x);
    PosedVertex b = posed_vertex_at(corners.y);
    PosedVertex c = posed_vertex_at(corners.z);
    precise vec3 u = b.position - a.position;
    precise vec3 v = c.position - a.position;
    precise vec3 n = vec3(u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x);
    precise vec3 mean = normal_direction(a.normal) + normal_direction(b.normal) + normal_direction(c.normal);
    float agrees = exact_dot(n, mean);
    return is_reversed(triangle) ? agrees > 0.0 : agrees < 0.0;
}

// Whether the surface at each corner of a triangle faces the eye.
bvec3 fronts_of(uint triangle)
{
    if (along_edges) {
        return bvec3(is_front(triangle));
    }
    uvec4 corners = triangle_at(triangle);
    bvec3 face =
        bvec3(facing_at(posed_vertex_at(corners.x)) >= 0.0, facing_at(posed_vertex_at(corners.y)) >= 0.0,
              facing_at(posed_vertex_at(corners.z)) >= 0.0);
    return is_inside_out(triangle) ? not(face) : face;
}

// The corners where a side starts and ends, with fronts on its left.
uvec2 ends_of(uint side)
{
    uint first = side & 3u;
    bool reversed = is_reversed(side >> 2);
    return reversed ? uvec2(next_corner(first), first) : uvec2(first, next_corner(first));
}

// What faces the eye at both ends of an edge: of its first side where that starts and where it ends, and of
// the second at the same two places.
struct EdgeFronts {
    bvec2 first;
    bvec2 second;
};

EdgeFronts fronts_along(uvec2 sides)
{
    uvec2 x = ends_of(sides.x);
    uvec2 y = ends_of(sides.y);
    bvec3 x_fronts = fronts_of(sides.x >> 2);
    bvec3 y_fronts = fronts_of(sides.y >> 2);
    return EdgeFronts(bvec2(x_fronts[x.x], x_fronts[x.y]), bvec2(y_fronts[y.y], y_fronts[y.x]));
}

// Whether some part of an edge is outline. Where two parts are, at both ends and not between, none counts.
bool has_outline(EdgeFronts fronts)
{
    bvec2 differs = bvec2(fronts.first.x != fronts.second.x, fronts.first.y != fronts.second.y);
    bvec2 turns = bvec2(fronts.first.x != fronts.first.y, fronts.second.x != fronts.second.y);
    return (any(differs) || any(turns)) && !(all(turns) && all(differs));
}

#endif
