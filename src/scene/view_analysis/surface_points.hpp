// SPDX-License-Identifier: MIT
#pragma once

// Samples a scene as a cloud of points on its surfaces, and renders this cloud into grids of 64 x 64 cells.
// With a grid, a view, a room or a shadow can be judged in a millisecond, regardless of the number of
// triangles.

#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include <estampe/scene.hpp>

namespace estampe {

/// The axes of a camera at the origin. The function of() converts a vector to camera space, with the
/// components right, up and forward.
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

/// Returns the unit vector of a direction given by azimuth and elevation above the horizon. Azimuth 0 is +z,
/// a quarter turn is +x.
inline glm::dvec3 bearing(double azimuth_rad, double elevation_rad)
{
    return {std::sin(azimuth_rad) * std::cos(elevation_rad), std::sin(elevation_rad),
            std::cos(azimuth_rad) * std::cos(elevation_rad)};
}

/// Returns the view axes of an eye at an azimuth and elevation that looks at the origin. Not valid straight
/// from above or below.
inline ViewAxes look_from(double azimuth_rad, double elevation_rad)
{
    const glm::dvec3 forward = -bearing(azimuth_rad, elevation_rad);
    const glm::dvec3 right = glm::normalize(glm::cross(forward, glm::dvec3(0.0, 1.0, 0.0)));
    return {right, glm::cross(right, forward), forward};
}

/// A sample point on a surface.
struct SurfacePoint {
    glm::vec3 position{0.0F}; ///< position of the point, relative to the cloud's origin
    glm::vec3 normal{0.0F}; ///< unit normal, from the winding of the triangle; it points to the visible side
    float detail = 0.0F;    ///< fineness of the mesh at this point: 1 / length of a triangle's side
    float area_m2 = 0.0F;   ///< area of the surface that the point represents
    bool two_sided = false;
    bool glows = false; ///< the material emits light
};

struct SurfaceCloud {
    glm::dvec3 origin{0.0}; ///< origin of the cloud in world space: the centre of the bounds
    Bounds bounds;          ///< bounds of all vertices in world space
    std::vector<SurfacePoint> points;
};

/// Samples about `count` points on the triangles of `scene`. One half of the points is distributed in
/// proportion to area, the other half in equal numbers per primitive. A vast floor then does not get all
/// points. The same scene always gives the same points. Cost: two visits of all vertices and triangles.
[[nodiscard]] SurfaceCloud surface_cloud(const Scene& scene, const ScenePose& pose, uint32_t count = 32768);

struct SeenGrid {
    static constexpr int side = 64;
    static constexpr uint32_t nothing = 0xffffffffU;

    /// For each cell: index of the nearest point in the cloud.
    std::vector<uint32_t> nearest = std::vector<uint32_t>(side * side, nothing);
    /// For each cell: depth of the nearest point along the view.
    std::vector<float> depth_m = std::vector<float>(side * side, 0.0F);
    float cell_m = 1.0F;
};

/// Renders the points inside `frame` (world space) with a parallel projection. Single-sided surfaces are
/// visible only from their front, unless `all_sides` is set. Cost: linear in points.
[[nodiscard]] SeenGrid see_from_afar(const SurfaceCloud& cloud, const ViewAxes& axes, const Bounds& frame,
                                     bool all_sides = false);

/// Returns the indices of the points that are visible in a grid, one per cell.
[[nodiscard]] std::vector<uint32_t> seen_points(const SeenGrid& seen);

/// Marks the points that are visible from their front in a parallel projection of the whole cloud. Cost: two
/// visits of all points.
void mark_shown(const SurfaceCloud& cloud, const ViewAxes& axes, std::vector<bool>& shown);

/// Returns the amount of drawable detail in a view, about 0 to 1. The amount is computed from silhouettes,
/// depth discontinuities, bends of the surface, finely meshed parts, and area.
[[nodiscard]] double interest(const SurfaceCloud& cloud, const SeenGrid& seen);

/// Returns the share of `points` (indices of the cloud's points) whose front is lit by a parallel light from
/// the direction `towards_light`. Cost: linear in the cloud's points.
[[nodiscard]] double lit_share(const SurfaceCloud& cloud, std::span<const uint32_t> points,
                               const ViewAxes& from_eye, const glm::dvec3& towards_light);

} // namespace estampe
