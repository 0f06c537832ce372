// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_TRIANGLE_SIDES
#define ESTAMPE_TRIANGLE_SIDES

// Sides and fronts of triangles, in the orientation of their shell. Requires before inclusion: `frame`,
// mesh_texels.glsl, silhouette.glsl, facing.glsl, and `along_edges`, which says whether outlines run only
// along edges of the mesh.

uint next_corner(uint corner)
{
    return corner == 2u ? 0u : corner + 1u;
}

// Whether a triangle's winding is clockwise as seen from its front.
bool is_reversed(uint triangle)
{
    bool is_turned = (texelFetch(neighbor_texels, int(triangle)).w & neighbor_is_turned) != 0u;
    return is_turned != ((triangle_at(triangle).w & triangle_mirrored) != 0u);
}

// The corners at the start and end of a side, with fronts on its left.
uvec2 ends_of(uint side)
{
    uint first = side & 3u;
    bool reversed = is_reversed(side >> 2);
    return reversed ? uvec2(next_corner(first), first) : uvec2(first, next_corner(first));
}

// Whether the normals of a triangle's smooth piece point to its back.
bool is_inside_out(uint triangle)
{
    return (texelFetch(neighbor_texels, int(triangle)).w & neighbor_is_inside_out) != 0u;
}

// Whether the surface of a triangle faces the eye at one of its corners.
bool is_front_at(uint triangle, uint corner)
{
    if (along_edges) {
        return is_front(triangle);
    }
    bool faces = facing_at(posed_vertex_at(triangle_at(triangle)[corner])) >= 0.0;
    return faces != is_inside_out(triangle);
}

#endif
