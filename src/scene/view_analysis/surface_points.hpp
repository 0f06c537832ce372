// SPDX-License-Identifier: MIT
#pragma once

// Samples a scene as a cloud of points on its surfaces, and renders the cloud into views of 64 x 64 cells.
// That is enough to judge a view, a room or a shadow in a millisecond, whatever the number of triangles.

#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include <estampe/scene.hpp>

namespace estampe {

/// The axes of a camera at the origin. of() gives a point in camera space: right, up, forward.
struct ViewAxes {
    glm::dvec3 right;
    glm::dvec3 up;
    glm::dvec3 forward;

    [[nodiscard]] glm::dvec3 of(const glm::dvec3& point) const
    {
        return {glm::dot(right, point), glm::dot(up, point), glm::dot(forward, point)};
    }

    [[nodiscard]] glm::dvec3 world(const glm::dvec3& v) const
    {
        return right * v.x + up * v.y + forward * v.z;
    }
};

/// Unit vector towards a bearing and an elevation above the horizon: azimuth 0 is +z, a quarter turn is +x.
inline glm::dvec3 bearing(double azimuth_rad, double elevation_rad)
{
    return {std::sin(azimuth_rad) * std::cos(elevation_rad), std::sin(elevation_rad),
            std::cos(azimuth_rad) * std::cos(elevation_rad)};
}

/// The view of an eye that stands at a bearing and looks at the origin; not valid straight from above or
/// below.
inline ViewAxes look_from(double azimuth_rad, double elevation_rad)
{
    const glm::dvec3 forward = -bearing(azimuth_rad, elevation_rad);
    const glm::dvec3 right = glm::normalize(glm::cross(forward, glm::dvec3(0.0, 1.0, 0.0)));
    return {right, glm::cross(right, forward), forward};
}

/// A sample point on a surface.
struct SurfacePoint {
    glm::vec3 position{0.0F}; ///< relative to the cloud's origin
    glm::vec3 normal{0.0F};   ///< computed from the winding, towards the visible side
    float detail = 0.0F;      ///< fineness of the mesh: 1 / length of a triangle's side
    float area_m2 = 0.0F;     ///< area of the surface that the point represents
    bool two_sided = false;
    bool glows = false; ///< its material emits light
};

struct SurfaceCloud {
    glm::dvec3 origin{0.0}; ///< in the world; the centre of the bounds
    Bounds bounds;          ///< bounds of all vertices, in the world
    std::vector<SurfacePoint> points;
};

/// Samples about `count` points on the triangles of `scene`, deterministically: half of them in proportion to
/// area, half in equal numbers per primitive, so that a vast floor does not take them all. Cost: two visits
/// of all vertices and triangles.
[[nodiscard]] SurfaceCloud surface_cloud(const Scene& scene, const ScenePose& pose, uint32_t count = 32768);

struct SeenGrid {
    static constexpr int side = 64;
    static constexpr uint32_t nothing = 0xffffffffU;

    std::vector<uint32_t> nearest = std::vector<uint32_t>(side * side, nothing); ///< into the cloud's points
    std::vector<float> depth_m = std::vector<float>(side * side, 0.0F);          ///< along the view
    float cell_m = 1.0F;
};

/// The points within `frame` (world space) that a parallel view shows. Single-sided surfaces are visible from
/// their front only, unless `all_sides` is set. Cost: linear in points.
[[nodiscard]] SeenGrid see_from_afar(const SurfaceCloud& cloud, const ViewAxes& axes, const Bounds& frame,
                                     bool all_sides = false);

/// The points that a grid shows, one per cell.
[[nodiscard]] std::vector<uint32_t> seen_points(const SeenGrid& seen);

/// Marks the points that a parallel view of the whole cloud shows from their front. Cost: two visits of all
/// points.
void mark_shown(const SurfaceCloud& cloud, const ViewAxes& axes, std::vector<bool>& shown);

/// Amount of drawable detail in a view, about 0 to 1: silhouettes, depth discontinuities, bends of the
/// surface, finely meshed parts, and area.
[[nodiscard]] double interest(const SurfaceCloud& cloud, const SeenGrid& seen);

/// Share of `points` (indices into the cloud's points) that face and receive a parallel light from
/// `towards_light`. Cost: linear in the cloud's points.
[[nodiscard]] double lit_share(const SurfaceCloud& cloud, std::span<const uint32_t> points,
                               const ViewAxes& from_eye, const glm::dvec3& towards_light);

} // namespace estampe
