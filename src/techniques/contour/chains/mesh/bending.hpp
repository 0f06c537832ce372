// SPDX-License-Identifier: MIT
#pragma once

// Curvature, and the derivative of curvature, at each vertex of an edge mesh. Suggestive contours are
// computed from both: lines where a surface would turn away if the eye moved a little.

#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "gpu/graph/graph.hpp"
#include "techniques/contour/chains/chains.glsl.h"
#include "techniques/contour/chains/mesh/edge_mesh.hpp"

namespace estampe::contour {

/// Curvature of the surface at a vertex. The axes of the curvature's coordinate frame are the tangent,
/// cross(normal, tangent) and the normal.
struct Bending {
    /// Unit vector, points outwards; zero if all triangles at the vertex have no area.
    glm::vec3 normal{0.0F};
    glm::vec3 tangent{0.0F}; ///< unit vector in the tangent plane: the x axis of the frame
    glm::vec3 form{0.0F};    ///< second fundamental form (xx, xy, yy) in 1/length; positive on a sphere
    glm::vec4 change{0.0F};  ///< derivative of `form`: (xxx, xxy, xyy, yyy), in 1/length^2
};

/// An edge mesh in the rest pose (the pose without animation).
struct RestSurface {
    const EdgeMesh& mesh;
    std::span<const glm::vec3> positions; ///< position of each vertex
    /// For each vertex: size of the object to which the vertex belongs; 0 if the object has no lines.
    std::span<const float> sizes;
    /// For each triangle: 1 if the triangle's corners are clockwise as seen from outside.
    std::span<const uint8_t> runs_clockwise;
};

/// Computes the curvature at each vertex. Normals come from the triangles around the vertex. The second
/// fundamental forms are fitted by least squares to the differences of normals along the sides of triangles,
/// and smoothed over about 1/130 of the object's size. Derivatives are fitted by least squares to the
/// differences of second fundamental forms. Values never pass edges where the shading breaks, so flat-shaded
/// surfaces have no curvature.
///
/// Cost    linear; about 6 us of CPU time per triangle, shared by all threads
/// Source  Rusinkiewicz, "Estimating Curvatures and Their Derivatives on Triangle Meshes", 2004
[[nodiscard]] std::vector<Bending> find_bending(const RestSurface& surface);

/// The principal curvatures of a second fundamental form, and the direction of the greatest curvature in the
/// tangent plane.
struct PrincipalCurvatures {
    float greatest = 0.0F;
    float least = 0.0F;
    glm::vec2 direction{1.0F, 0.0F};
};

[[nodiscard]] PrincipalCurvatures principal_curvatures(const glm::vec3& form);

/// Third directional derivative of a surface: how the curvature along `way` changes in the direction `way`.
[[nodiscard]] float change_along(const glm::vec4& change, const glm::vec2& way);

/// Conditions for drawing a suggestive contour where the radial curvature is zero.
struct SuggestiveCut {
    /// Smallest growth of the radial curvature towards the eye, in 1/size^2 of the object.
    float least_growth = 15.0F;
    float least_angle_deg = 20.0F; ///< smallest angle between the surface normal and the direction to the eye
};

/// Converts curvatures to the format of the shaders: in units of the object's size, each in a frame whose x
/// axis points to a neighbouring vertex.
[[nodiscard]] std::vector<shared::VertexBending> vertex_bendings(const RestSurface& surface,
                                                                 std::span<const Bending> bendings);

/// Computes, for each vertex in the current view, the radial curvature and the strength that a suggestive
/// contour would have where the radial curvature is zero.
///
/// Cost    one thread per vertex
/// Source  DeCarlo, Finkelstein, Rusinkiewicz and Santella, "Suggestive Contours for Conveying Shape", 2003
[[nodiscard]] gpu::BufferId add_view_bends(gpu::Graph& graph, gpu::BufferId frame,
                                           gpu::BufferId posed_vertices, gpu::BufferId bendings,
                                           uint32_t vertex_count, const SuggestiveCut& cut);

} // namespace estampe::contour
