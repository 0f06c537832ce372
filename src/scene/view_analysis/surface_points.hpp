// SPDX-License-Identifier: MIT
#pragma once

// A scene as a cloud of points on its surfaces: enough to judge a view, a room or a shadow in a millisecond,
// however many triangles there are.

#include <cstdint>
#include <vector>

#include <estampe/scene.hpp>

namespace estampe {

/// One of many points on a surface.
struct SurfacePoint {
    glm::vec3 position{0.0F}; ///< relative to the cloud's origin
    glm::vec3 normal{0.0F};   ///< by the winding, towards the side that is seen
    float detail = 0.0F;      ///< how finely the surface is meshed: 1 / length of a triangle's side
    float area_m2 = 0.0F;     ///< that it stands for
    bool two_sided = false;
    bool glows = false; ///< its material emits light
};

struct SurfaceCloud {
    glm::dvec3 origin{0.0}; ///< in the world; the centre of the bounds
    Bounds bounds;          ///< of all vertices, in the world
    std::vector<SurfacePoint> points;
};

/// Puts about `count` points on the triangles of `scene`, the same ones every time: half of them evenly by
/// area, half in equal parts to every primitive, so that a vast floor does not take them all. Cost: two
/// visits of all vertices and triangles.
[[nodiscard]] SurfaceCloud surface_cloud(const Scene& scene, const ScenePose& pose, uint32_t count = 32768);

} // namespace estampe
