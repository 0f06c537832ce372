// SPDX-License-Identifier: MIT
#pragma once

// How surfaces bend, and how that changes, at each vertex of an edge mesh; and suggestive contours, which are
// found by that: where a surface would turn away if the eye moved a little.

#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "gpu/graph/graph.hpp"
#include "techniques/contour/chains/chains.glsl.h"
#include "techniques/contour/chains/mesh/edge_mesh.hpp"

namespace estampe::contour {

/// A surface as measured at a vertex. Its third axis is cross(normal, tangent).
struct Bending {
    glm::vec3 normal{0.0F};  ///< unit, outwards; zero where no triangle has an area
    glm::vec3 tangent{0.0F}; ///< unit
    glm::vec3 form{0.0F};    ///< second fundamental form xx, xy, yy in inverse units; positive on a ball
    glm::vec4 change{0.0F};  ///< its derivative xxx, xxy, xyy, yyy, in inverse square units
};

/// An edge mesh as it stands in the rest pose.
struct RestSurface {
    const EdgeMesh& mesh;
    std::span<const glm::vec3> positions; ///< one a vertex
    std::span<const float> sizes;         ///< one a vertex: across the whole object; 0 for what has no lines
    std::span<const uint8_t> runs_clockwise; ///< one a triangle: 1 if its corners do, seen from outside
};

/// Normals from the triangles about each vertex, forms by least squares of the differences of normals along
/// the sides of triangles, smoothed over about 1/130 of the object, and derivatives likewise of the
/// differences of forms. Where shading breaks nothing is taken from beyond, so that what is shaded flat does
/// not bend.
///
/// Cost    linear; about 6 us of processor time a triangle, shared by all threads
/// Source  Rusinkiewicz, "Estimating Curvatures and Their Derivatives on Triangle Meshes", 2004
[[nodiscard]] std::vector<Bending> find_bending(const RestSurface& surface);

/// Greatest and least curvature of a form, with the greatest's direction in its tangent plane.
struct PrincipalCurvatures {
    float greatest = 0.0F;
    float least = 0.0F;
    glm::vec2 direction{1.0F, 0.0F};
};

[[nodiscard]] PrincipalCurvatures principal_curvatures(const glm::vec3& form);

/// The derivative of a form along `way` three times over: how its curvature along `way` grows that way.
[[nodiscard]] float change_along(const glm::vec4& change, const glm::vec2& way);

/// What makes a line of a place where the radial curvature is zero.
struct SuggestiveCut {
    float least_growth = 15.0F;    ///< of curvature towards the eye, both in inverse sizes of the object
    float least_angle_deg = 20.0F; ///< between the normal and the way to the eye
};

/// Bendings in the form of the shaders, in sizes of the object, each in a frame that hangs on a neighbour.
[[nodiscard]] std::vector<shared::VertexBending> vertex_bendings(const RestSurface& surface,
                                                                 std::span<const Bending> bendings);

/// What the view makes of each vertex: radial curvature, and the strength of a line where that is zero.
///
/// Cost    one thread a vertex
/// Source  DeCarlo, Finkelstein, Rusinkiewicz and Santella, "Suggestive Contours for Conveying Shape", 2003
[[nodiscard]] gpu::BufferId add_view_bends(gpu::Graph& graph, gpu::BufferId frame,
                                           gpu::BufferId posed_vertices, gpu::BufferId bendings,
                                           uint32_t vertex_count, const SuggestiveCut& cut);

} // namespace estampe::contour
