// SPDX-License-Identifier: MIT
#pragma once

// What of a scene a picture is about: without strays, without a wide floor; and whether it is a figure with
// eyes.

#include <optional>

#include <estampe/scene.hpp>

#include "scene/view_analysis/surface_points.hpp"

namespace estampe {

/// The part of `whole`, the bounds of the scene in `pose`, that a picture of the scene is about: without
/// strays, which are few vertices or a lesser object, twenty times as far away as the rest is large. A scene
/// whose parts are of equal weight, or near each other, is kept whole. Cost: one to three visits of all
/// vertices and triangles.
[[nodiscard]] Bounds bounds_without_strays(const Scene& scene, const ScenePose& pose, const Bounds& whole);

/// Whether a point lies in the box, its surface included.
[[nodiscard]] inline bool holds(const Bounds& bounds, const glm::dvec3& point)
{
    return glm::all(glm::greaterThanEqual(point, bounds.min)) &&
           glm::all(glm::lessThanEqual(point, bounds.max));
}

/// What a picture of the scene should show: all of it, but of a floor much wider than what stands on it only
/// the part below that. In world space; the lowest point of what stands is at the floor. Cost: linear in
/// points.
[[nodiscard]] Bounds subject_bounds(const SurfaceCloud& cloud);

/// The subject where `found`, that of the cloud, is the whole cloud: a small thing that is one mesh with a
/// huge floor has no points in the cloud, but it has vertices. Else `found`. Cost: linear in vertices.
[[nodiscard]] Bounds subject_by_vertices(const Scene& scene, const ScenePose& pose, const SurfaceCloud& cloud,
                                         const Bounds& found);

/// The cloud without what lies outside of `subject`.
[[nodiscard]] SurfaceCloud within(const SurfaceCloud& cloud, const Bounds& subject);

/// The height of the eyes, in world space, of a subject that is a character or a bust: upright, alike on the
/// left and on the right, with a head on a neck, or moved by a skeleton. Nothing for all other things, such
/// as bodies of revolution. `inside` is the cloud within the subject. Cost: linear in points and vertices.
[[nodiscard]] std::optional<double> eye_level(const Scene& scene, const SurfaceCloud& inside);

} // namespace estampe
