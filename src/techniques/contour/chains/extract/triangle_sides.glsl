// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_TRIANGLE_SIDES
#define ESTAMPE_TRIANGLE_SIDES

// Sides of triangles, and which triangles face the eye, after all windings of a shell (connected surface) are
// made consistent. Requires before inclusion: `frame`, mesh_texels.glsl, silhouette.glsl, facing.glsl, and
// `along_edges`, which is true if outlines run only along edges of the mesh.

uint next_corner(uint corner)
{
    return corner == 2u ? 0u : corner + 1u;
}

// Whether the corners of a triangle are clockwise as seen from the front of the triangle's surface.
bool is_reversed(uint triangle)
{
    bool is_turned = (texelFetch(neighbor_texels, int(triangle)).w & neighbor_is_turned) != 0u;
    return is_turned != ((triangle_at(triangle).w & triangle_mirrored) != 0u);
}

// The corners at the start and the end of a side, ordered so that front-facing surface lies on the left.
uvec2 ends_of(uint side)
{
    uint first = side & 3u;
    bool reversed = is_reversed(side >> 2);
    return reversed ? uvec2(next_corner(first), first) : uvec2(first, next_corner(first));
}

// Whether the vertex normals around a triangle point to the back of its shell (connected surface).
bool is_inside_out(uint triangle)
{
    return (texelFetch(neighbor_texels, int(triangle)).w & neighbor_is_inside_out) != 0u;
}

// Whether a triangle belongs to a flat face, whatever its vertex normals say.
bool is_flat(uint triangle)
{
    return (triangle_at(triangle).w & triangle_is_flat) != 0u;
}

// Whether the surface of a triangle faces the eye at one corner of the triangle.
bool is_front_at(uint triangle, uint corner)
{
    if (along_edges || is_flat(triangle)) {
        return is_front(triangle);
    }
    bool faces = facing_at(posed_vertex_at(triangle_at(triangle)[corner])) >= 0.0;
    return faces != is_inside_out(triangle);
}

#endif
