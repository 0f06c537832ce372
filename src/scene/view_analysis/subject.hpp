// SPDX-License-Identifier: MIT
#pragma once

// The subject of a picture: the scene without strays and without a wide floor. Also recognises a figure with
// eyes.

#include <optional>

#include <estampe/scene.hpp>

#include "scene/view_analysis/surface_points.hpp"

namespace estampe {

/// The part of `whole`, the bounds of the scene in `pose`, without strays. Strays are few vertices or a
/// lesser object whose distance is twenty times the size of the rest. A scene whose parts have equal weight,
/// or are near each other, is kept whole. Cost: one to three visits of all vertices and triangles.
[[nodiscard]] Bounds bounds_without_strays(const Scene& scene, const ScenePose& pose, const Bounds& whole);

/// Whether a point lies in the box or on its surface.
[[nodiscard]] inline bool holds(const Bounds& bounds, const glm::dvec3& point)
{
    return glm::all(glm::greaterThanEqual(point, bounds.min)) &&
           glm::all(glm::lessThanEqual(point, bounds.max));
}

/// Bounds, in world space, of what a picture should show: everything, except that a floor much wider than
/// what stands on it is cut to the part below that. The lowest point of what stands is at the floor. Cost:
/// linear in points.
[[nodiscard]] Bounds subject_bounds(const SurfaceCloud& cloud);

/// Replaces `found`, the subject of the cloud, if it is the whole cloud: a small thing in one mesh with a
/// huge floor has no points in the cloud, but it has vertices. Otherwise returns `found`. Cost: linear in
/// vertices.
[[nodiscard]] Bounds subject_by_vertices(const Scene& scene, const ScenePose& pose, const SurfaceCloud& cloud,
                                         const Bounds& found);

/// The points of the cloud that lie inside `subject`.
[[nodiscard]] SurfaceCloud within(const SurfaceCloud& cloud, const Bounds& subject);

/// The height of the eyes, in world space, if the subject is a character or a bust: upright, symmetric left
/// to right, with a head on a neck, or moved by a skeleton. Nothing for other subjects, such as bodies of
/// revolution. `inside` is the cloud within the subject. Cost: linear in points and vertices.
[[nodiscard]] std::optional<double> eye_level(const Scene& scene, const SurfaceCloud& inside);

} // namespace estampe
