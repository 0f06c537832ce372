// SPDX-License-Identifier: MIT
#pragma once

#include <estampe/scene.hpp>

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

} // namespace estampe
