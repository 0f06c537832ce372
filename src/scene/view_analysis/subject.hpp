// SPDX-License-Identifier: MIT
#pragma once

// Finds the subject of a picture, which is the scene without strays (small, far parts) and without a wide
// floor. Also recognises characters, and finds the height of their eyes.

#include <optional>

#include <estampe/scene.hpp>

#include "scene/view_analysis/surface_points.hpp"

namespace estampe {

/// Returns the bounds of the scene without strays. `whole` are the bounds of the scene in `pose`. Strays are
/// a few vertices or a smaller object at a distance of twenty times the size of the rest. If the parts of a
/// scene have equal weight or are near each other, there are no strays. Cost: one to three visits of all
/// vertices and triangles.
[[nodiscard]] Bounds bounds_without_strays(const Scene& scene, const ScenePose& pose, const Bounds& whole);

/// Returns whether a point is inside the box or on its surface.
[[nodiscard]] inline bool holds(const Bounds& bounds, const glm::dvec3& point)
{
    return glm::all(glm::greaterThanEqual(point, bounds.min)) &&
           glm::all(glm::lessThanEqual(point, bounds.max));
}

/// Returns the bounds, in world space, of the part of the scene that a picture should show. If the floor is
/// much wider than the objects on it, the part shown is everything except the floor beyond the objects. If
/// there is no wide floor, the part shown is the whole scene. Cost: linear in points.
[[nodiscard]] Bounds subject_bounds(const SurfaceCloud& cloud);

/// Corrects the result `found` of subject_bounds(), if `found` is the whole cloud. In this case a small
/// object in the same mesh as a huge floor may have no sample points, but it has vertices. If `found` is not
/// the whole cloud, returns `found`. Cost: linear in vertices.
[[nodiscard]] Bounds subject_by_vertices(const Scene& scene, const ScenePose& pose, const SurfaceCloud& cloud,
                                         const Bounds& found);

/// Returns the part of the cloud whose points are inside `subject`.
[[nodiscard]] SurfaceCloud within(const SurfaceCloud& cloud, const Bounds& subject);

/// Returns the height of the eyes, in world space, if the subject is a character or a bust. A character is
/// upright, and has a head on a neck or is moved by a skeleton. Returns nothing for a subject that is not a
/// character, such as a vase. `inside` is the part of the cloud within the subject. Cost: linear in points
/// and vertices.
[[nodiscard]] std::optional<double> eye_level(const Scene& scene, const SurfaceCloud& inside);

} // namespace estampe
