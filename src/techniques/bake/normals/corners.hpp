// SPDX-License-Identifier: MIT
#pragma once

// Triangles of a scene as lists of corners, and the tangent frames in which normal maps store normals.

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include <glm/glm.hpp>

#include <estampe/normal_map.hpp>
#include <estampe/scene.hpp>

#include "scene/pose.hpp"

namespace estampe::bake {

/// Triangles of a scene in its rest pose: each list has three entries per triangle. The corners of a triangle
/// are counter-clockwise seen from its front.
struct Corners {
    std::vector<glm::vec3> positions; ///< relative to the anchor, in metres
    std::vector<glm::vec3> normals;   ///< unit normals for shading
    std::vector<glm::vec2> uvs;
    std::vector<Index> materials; ///< material of each triangle

    [[nodiscard]] size_t count() const { return materials.size(); }
};

/// Chooses the set of texture coordinates of a primitive; nothing leaves the primitive out.
using UvSetOf = std::function<std::optional<uint32_t>(const PosedPrimitive& posed)>;

/// Returns the triangles of the visible primitives that `uv_set_of` does not leave out. Skins and morph
/// targets are applied. A primitive without the chosen set gets UVs of 0. Cost: linear in vertices and
/// triangles.
[[nodiscard]] Corners corners_of(const Scene& scene, const ScenePose& pose, const glm::dvec3& anchor,
                                 const UvSetOf& uv_set_of);

/// Returns a smooth unit normal for each corner: the mean of the normals of all corners at the same position,
/// weighted by the angles of the triangles at their corners. Cost: sorts the corners.
[[nodiscard]] std::vector<glm::vec3> smooth_normals(const Corners& corners);

/// Returns the tangent of each corner as in Primitive::tangents: the mean over the triangles that are
/// connected by shared edges around the corner, and have the same position, normal, UVs and orientation of
/// UVs there. The triangles are weighted by their angles at the corner. Cost: sorts the corners twice.
///
/// Source  Mikkelsen, "Simulation of Wrinkled Surfaces Revisited", 2008 (MikkTSpace)
[[nodiscard]] std::vector<glm::vec4> vertex_tangents(const Corners& corners);

/// Returns the value of `list` at a point of a triangle. The weights are those of the three corners.
template <class T>
[[nodiscard]] glm::vec<T::length(), double> between(const std::vector<T>& list, size_t triangle,
                                                    const glm::dvec3& weights)
{
    using Wide = glm::vec<T::length(), double>;
    const T* corner = &list[3 * triangle];
    return weights.x * Wide(corner[0]) + weights.y * Wide(corner[1]) + weights.z * Wide(corner[2]);
}

/// Returns the axes of red, green and blue of a normal map at a point of a triangle with the unit normal
/// `normal`, as the technique `surface` draws them: red and green are the directions in which u grows and v
/// falls, divided by the length of the longer of the two. If the UVs have no area, all of the frame but its
/// normal is zero.
[[nodiscard]] glm::dmat3 triangle_frame(const Corners& corners, size_t triangle, const glm::dvec3& normal);

/// Returns the axes of red, green and blue at a point with an interpolated vertex tangent.
[[nodiscard]] glm::dmat3 vertex_frame(const glm::dvec4& tangent, const glm::dvec3& normal);

/// Expresses a unit normal in a frame, as a unit vector. Returns (0, 0, 1) if the axes of the frame lie in
/// one plane.
[[nodiscard]] glm::dvec3 in_frame(const glm::dmat3& frame, const glm::dvec3& normal);

} // namespace estampe::bake
