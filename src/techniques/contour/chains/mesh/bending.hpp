// SPDX-License-Identifier: MIT
#pragma once

// Curvature and its derivative at each vertex of an edge mesh, and suggestive contours, which are found from
// them: where a surface would turn away if the eye moved a little.

#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "gpu/graph/graph.hpp"
#include "techniques/contour/chains/chains.glsl.h"
#include "techniques/contour/chains/mesh/edge_mesh.hpp"

namespace estampe::contour {

/// Curvature measured at a vertex. The third axis of its frame is cross(normal, tangent).
struct Bending {
    glm::vec3 normal{0.0F};  ///< unit, outwards; zero if no triangle at the vertex has an area
    glm::vec3 tangent{0.0F}; ///< unit
    glm::vec3 form{0.0F};    ///< second fundamental form xx, xy, yy in inverse units; positive on a sphere
    glm::vec4 change{0.0F};  ///< derivative of `form`, xxx, xxy, xyy, yyy, in inverse square units
};

/// An edge mesh in the rest pose.
struct RestSurface {
    const EdgeMesh& mesh;
    std::span<const glm::vec3> positions; ///< one per vertex
    std::span<const float> sizes;         ///< one per vertex: size of the whole object; 0 if it has no lines
    std::span<const uint8_t> runs_clockwise; ///< one per triangle: 1 if clockwise, seen from outside
};

/// Computes curvature. Normals come from the triangles around each vertex. Forms are fitted by least squares
/// to the differences of normals along the sides of triangles, and smoothed over about 1/130 of the object.
/// Derivatives are fitted likewise to the differences of forms. Nothing is taken across edges where shading
/// breaks, so that flat-shaded surfaces have no curvature.
///
/// Cost    linear; about 6 us of CPU time per triangle, shared by all threads
/// Source  Rusinkiewicz, "Estimating Curvatures and Their Derivatives on Triangle Meshes", 2004
[[nodiscard]] std::vector<Bending> find_bending(const RestSurface& surface);

/// Greatest and least curvature of a form, and the direction of the greatest in the tangent plane.
struct PrincipalCurvatures {
    float greatest = 0.0F;
    float least = 0.0F;
    glm::vec2 direction{1.0F, 0.0F};
};

[[nodiscard]] PrincipalCurvatures principal_curvatures(const glm::vec3& form);

/// Third directional derivative: how the curvature along `way` changes in the direction `way`.
[[nodiscard]] float change_along(const glm::vec4& change, const glm::vec2& way);

/// Conditions for drawing a line where the radial curvature is zero.
struct SuggestiveCut {
    float least_growth = 15.0F; ///< growth of curvature towards the eye, both in inverse sizes of the object
    float least_angle_deg = 20.0F; ///< between the normal and the direction to the eye
};

/// Bendings in the format of the shaders, in units of the object's size, each in a frame that depends on a
/// neighbour vertex.
[[nodiscard]] std::vector<shared::VertexBending> vertex_bendings(const RestSurface& surface,
                                                                 std::span<const Bending> bendings);

/// Computes for each vertex and view the radial curvature, and the strength of a line where that is zero.
///
/// Cost    one thread per vertex
/// Source  DeCarlo, Finkelstein, Rusinkiewicz and Santella, "Suggestive Contours for Conveying Shape", 2003
[[nodiscard]] gpu::BufferId add_view_bends(gpu::Graph& graph, gpu::BufferId frame,
                                           gpu::BufferId posed_vertices, gpu::BufferId bendings,
                                           uint32_t vertex_count, const SuggestiveCut& cut);

} // namespace estampe::contour
