// SPDX-License-Identifier: MIT
#pragma once

// Repairs primitives and scenes so that they can be drawn. Repairs concern indices, normals, tangents,
// weights and equal vertices.

#include <cstdint>
#include <new>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include <estampe/error.hpp>
#include <estampe/scene.hpp>

namespace estampe::gltf {

/// Converts strips, fans and loops to lists of triangles or lines. `mode` is the mode of glTF (0 points ... 6
/// triangle fan). Leaves out triangles of a strip or fan that use a vertex twice, and an incomplete last
/// element.
[[nodiscard]] std::vector<uint32_t> list_indices(int mode, const std::vector<uint32_t>& indices);

/// Replaces the vertices of a primitive by the vertices with the indices `order`, in this order. Every vertex
/// array and every morph target is changed.
void pick_vertices(Primitive& primitive, const std::vector<uint32_t>& order);

/// Removes unused vertices, which no index refers to, if they are the majority.
void drop_unused_vertices(Primitive& primitive);

/// Computes flat normals: every triangle gets its own three vertices with one normal. glTF requires this for
/// files without normals.
void make_flat_normals(Primitive& primitive);

/// Replaces normals that are zero or not finite by the average normal of the adjacent faces, and normalises
/// all normals. Returns the number of replaced normals.
[[nodiscard]] size_t repair_normals(Primitive& primitive);

/// Computes tangents along +u of texture coordinate set `uv_set`, averaged over the faces at each vertex and
/// orthogonal to the vertex normal.
void make_tangents(Primitive& primitive, uint32_t uv_set);

/// Scales the joint weights of each vertex to a sum of one. Joints with weight zero become joint 0. A vertex
/// without usable weights gets full weight for its first joint. Returns the number of vertices without usable
/// weights.
[[nodiscard]] size_t normalise_weights(Primitive& primitive);

} // namespace estampe::gltf

namespace estampe {

/// Repairs a primitive so that it can be drawn. Drops triangles, lines and points whose vertices are missing
/// or not finite, replaces bad normals, computes missing normals, scales weights to a sum of one, and merges
/// equal vertices. Each repair appends a line about `name` to `warnings`. Cost: about 0.4 s for a million
/// triangles.
void mend_primitive(Primitive& primitive, const std::string& name, std::vector<std::string>& warnings);

/// Numbers the distinct positions of the vertices from 0. Vertices at equal positions get the same number.
/// Stores the number of distinct positions in `count`, unless `count` is null. Cost: linear.
[[nodiscard]] std::vector<uint32_t> places_of_vertices(const Primitive& primitive, size_t* count = nullptr);

/// Reverses the winding of a triangle by swapping its last two corners. The edge marks of the triangle are
/// swapped accordingly.
void turn_triangle(Primitive& primitive, size_t triangle);

/// Makes the winding of triangles that share an edge consistent: in each connected piece of the surface,
/// finds the winding with the smaller area and reverses its triangles. An edge of more than two triangles
/// does not connect triangles. A piece that cannot be made consistent, such as a Moebius strip, is not
/// changed. The primitive must consist of triangles with indices in range. Returns the number of reversed
/// triangles. Cost: linear in triangles, and small if all windings are consistent.
size_t agree_winding(Primitive& primitive);

/// Calls agree_winding(), and appends a line about `name` to `warnings` if triangles were reversed.
void agree_winding(Primitive& primitive, const std::string& name, std::vector<std::string>& warnings);

/// Edges sharper than this angle are shaded as creases. The value is 47 degrees, so that a coarse tube with
/// eight sides is still shaded smoothly.
inline constexpr float usual_crease_rad = 0.82F;

/// Computes unit normals of triangles. A normal is the angle-weighted average of the faces that meet at a
/// position, excluding faces across edges sharper than `crease_rad`. Afterwards equal vertices are merged,
/// and vertices are sorted by their first use.
///
/// `groups` holds a smoothing group for each triangle, or is empty. Edges between triangles of one group are
/// smoothed, however sharp they are. Triangles of group 0 are flat. `crease_rad` applies to triangles whose
/// group is `no_index`. Uses a second thread for large meshes, with the same result. Cost: about 0.25 s for a
/// million triangles.
void make_crease_normals(Primitive& primitive, float crease_rad, std::span<const uint32_t> groups = {});

/// Merges vertices whose attributes are all equal.
void share_vertices(Primitive& primitive);

/// Throws Error with `where` as its place if the scene, whose pictures are decoded, has faults().
void check_structure(const Scene& scene, const std::string& where);

/// Repairs all meshes of a scene with mend_primitive(), and removes primitives with nothing to draw.
/// Primitives without a material get the first material, which is added if there is none. Throws Error with
/// `where` as its place when nothing is left to draw.
void mend_meshes(Scene& scene, const std::string& where);

/// The last step of every reader: repairs the meshes, reverses closed pieces of meshes that are inside out,
/// and computes the tangents that normal maps need. Throws Error with `where` as its place when there is
/// nothing to draw.
void finish_import(Scene& scene, const std::string& where);

/// Calls `read`. Throws Error if `read` runs out of memory.
template <typename Read>
Scene within_memory(const std::string& where, Read read)
{
    try {
        return read();
    } catch (const std::bad_alloc&) {
        throw Error("does not fit into memory", where);
    } catch (const std::length_error&) {
        throw Error("does not fit into memory", where);
    }
}

} // namespace estampe
