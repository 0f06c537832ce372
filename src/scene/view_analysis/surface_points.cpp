// SPDX-License-Identifier: MIT
#include "scene/view_analysis/surface_points.hpp"

#include <algorithm>
#include <cmath>

#include "scene/pose.hpp"
#include "scene/view_analysis/strays.hpp"

namespace estampe {
namespace {

/// Walks over the triangles and drops a point after every `step` of area.
class Sower {
public:
    explicit Sower(SurfaceCloud& cloud) : cloud_(cloud) {}

    void begin(double step_m2)
    {
        step_m2_ = step_m2;
        due_m2_ = due_ * step_m2;
    }

    void end() { due_ = due_m2_ / step_m2_; }

    void add(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const Material& material)
    {
        const glm::dvec3 across = glm::cross(b - a, c - a);
        const double length = glm::length(across);
        const double area_m2 = 0.5 * length;
        if (!(area_m2 > 0.0))
            return;
        const glm::vec3 normal(across / length);
        const auto detail = static_cast<float>(1.0 / std::sqrt(area_m2));
        const bool glows = std::max({material.emissive.x, material.emissive.y, material.emissive.z}) > 0.5F;
        for (; due_m2_ <= area_m2; due_m2_ += step_m2_) {
            // Roberts' sequence, folded from the square into the triangle.
            const auto n = static_cast<double>(cloud_.points.size() + 1);
            double u = std::fmod(0.7548776662466927 * n, 1.0);
            double v = std::fmod(0.5698402909980532 * n, 1.0);
            if (u + v > 1.0) {
                u = 1.0 - u;
                v = 1.0 - v;
            }
            cloud_.points.push_back({.position = glm::vec3(a + u * (b - a) + v * (c - a)),
                                     .normal = normal,
                                     .detail = detail,
                                     .area_m2 = static_cast<float>(step_m2_),
                                     .two_sided = material.double_sided,
                                     .glows = glows});
        }
        due_m2_ -= area_m2;
    }

private:
    SurfaceCloud& cloud_;
    double due_ = 0.5; ///< steps until the next point, carried from primitive to primitive
    double step_m2_ = 1.0;
    double due_m2_ = 1.0;
};

double area_of(const PosedPrimitive& posed)
{
    const std::vector<uint32_t>& indices = posed.primitive->indices;
    double area_m2 = 0.0;
    for (size_t i = 0; posed.primitive->topology == Topology::triangles && i + 2 < indices.size(); i += 3) {
        const glm::dvec3& a = posed.positions[indices[i]];
        const glm::dvec3 b = posed.positions[indices[i + 1]] - a;
        const glm::dvec3 c = posed.positions[indices[i + 2]] - a;
        area_m2 += 0.5 * glm::length(glm::cross(b, c));
    }
    return area_m2;
}

} // namespace

SurfaceCloud surface_cloud(const Scene& scene, const ScenePose& pose, uint32_t count)
{
    SurfaceCloud cloud;
    std::vector<double> areas_m2; // of the primitives, in the order of the visit
    double total_m2 = 0.0;
    double surfaces = 0.0;
    visit_posed(scene, pose, [&](const PosedPrimitive& posed) {
        for (const glm::dvec3& position : posed.positions)
            cloud.bounds.extend(position);
        areas_m2.push_back(area_of(posed));
        total_m2 += areas_m2.back();
        surfaces += areas_m2.back() > 0.0 ? 1.0 : 0.0;
    });
    const Bounds all = cloud.bounds;
    cloud.bounds = bounds_without_strays(scene, pose, all);
    if (!(total_m2 > 0.0) || !std::isfinite(total_m2))
        return cloud;
    cloud.origin = cloud.bounds.center();
    cloud.points.reserve(count + 1);
    Sower sower(cloud);
    static const Material plain;
    size_t next = 0;
    visit_posed(scene, pose, [&](const PosedPrimitive& posed) {
        const double area_m2 = areas_m2[next++];
        if (area_m2 == 0.0)
            return;
        sower.begin(area_m2 / (0.5 * count * (area_m2 / total_m2 + 1.0 / surfaces)));
        const std::vector<uint32_t>& indices = posed.primitive->indices;
        const Index material = posed.primitive->material;
        const Material& look = material < scene.materials.size() ? scene.materials[material] : plain;
        for (size_t i = 0; i + 2 < indices.size(); i += 3) {
            const auto corner = [&](size_t k) { return posed.positions[indices[i + k]] - cloud.origin; };
            sower.add(corner(0), corner(posed.mirrored ? 2 : 1), corner(posed.mirrored ? 1 : 2), look);
        }
        sower.end();
    });
    if (length(all.max - all.min) > length(cloud.bounds.max - cloud.bounds.min)) {
        std::erase_if(cloud.points, [&](const SurfacePoint& point) {
            return !holds(cloud.bounds, glm::dvec3(point.position) + cloud.origin);
        });
    }
    return cloud;
}

} // namespace estampe
