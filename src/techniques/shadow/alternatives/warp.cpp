// SPDX-License-Identifier: MIT
#include "techniques/shadow/alternatives/warp.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace estampe::shadow {
namespace {

/// A plane with an inner side: a point is inside if the dot product of `normal` and the point, plus `offset`,
/// is at least 0.
using Plane = glm::dvec4;

/// Planes of the eye's frustum: its sides and the near plane.
std::vector<Plane> planes_of(const shared::FrameGlobals& eye)
{
    const glm::dmat4 rows = glm::transpose(glm::dmat4(eye.clip_from_anchor));
    std::vector<Plane> planes;
    for (int axis = 0; axis < 2; ++axis) {
        planes.push_back(rows[3] + rows[axis]);
        planes.push_back(rows[3] - rows[axis]);
    }
    planes.push_back(rows[3] - rows[2]);
    return planes;
}

/// Corners of the convex body inside all planes.
std::vector<glm::dvec3> corners_of(std::vector<Plane> planes)
{
    for (Plane& plane : planes) {
        plane /= glm::length(glm::dvec3(plane));
    }
    std::vector<glm::dvec3> corners;
    for (size_t a = 0; a < planes.size(); ++a) {
        for (size_t b = a + 1; b < planes.size(); ++b) {
            for (size_t c = b + 1; c < planes.size(); ++c) {
                const glm::dmat3 normals{glm::dvec3(planes[a]), glm::dvec3(planes[b]), glm::dvec3(planes[c])};
                if (std::abs(glm::determinant(normals)) < 1e-9) {
                    continue;
                }
                const glm::dvec3 point = -glm::inverse(glm::transpose(normals)) *
                                         glm::dvec3(planes[a].w, planes[b].w, planes[c].w);
                const double slack = 1e-6 * (1.0 + glm::length(point));
                if (std::ranges::all_of(planes, [&](const Plane& plane) {
                        return glm::dot(plane, {point, 1.0}) >= -slack;
                    })) {
                    corners.push_back(point);
                }
            }
        }
    }
    return corners;
}

/// Planes around the volume in which shadows can fall: the casters' box, extended along the sun, above the
/// floor.
std::vector<Plane> planes_of(const SunMapScene& scene, const SunView& view)
{
    const glm::dmat4 rows = glm::transpose(glm::dmat4(view.clip_from_anchor));
    const Plane one(0.0, 0.0, 0.0, 1.0);
    return {one + rows[0],
            one - rows[0],
            one + rows[1],
            one - rows[1],
            one - rows[2],
            8.0 * one + rows[2],
            Plane(0.0, 1.0, 0.0, scene.anchor.y - scene.floor_m + 0.01 * scene.casters.radius()),
            Plane(0.0, -1.0, 0.0, scene.casters.max.y - scene.anchor.y + 0.01 * scene.casters.radius())};
}

struct Range {
    double low = std::numeric_limits<double>::max();
    double high = std::numeric_limits<double>::lowest();

    void extend(double value)
    {
        low = std::min(low, value);
        high = std::max(high, value);
    }
};

} // namespace

SunView warped_view(const SunMapScene& scene)
{
    const shared::FrameGlobals& eye = scene.eye;
    const uint32_t size = scene.size;
    SunView view = sun_view(scene.casters, scene.anchor, scene.towards_sun, size);
    std::vector<Plane> planes = planes_of(eye);
    const std::vector<Plane> shadows = planes_of(scene, view);
    planes.insert(planes.end(), shadows.begin(), shadows.end());
    const std::vector<glm::dvec3> body = corners_of(planes);
    const glm::dvec3 forward(eye.view_forward);
    const glm::dvec3 across = forward - scene.towards_sun * glm::dot(forward, scene.towards_sun);
    const double sine = glm::length(across);
    if (body.size() < 4 || eye.is_orthographic != 0 || sine < 0.02) {
        return view;
    }
    const glm::dvec3 down = across / sine;
    const glm::dvec3 right = glm::cross(down, scene.towards_sun);
    Range along;
    Range away;
    for (const glm::dvec3& point : body) {
        along.extend(glm::dot(point, down));
        away.extend(glm::dot(point - glm::dvec3(eye.eye_anchor), forward));
    }
    // The chosen near distance makes the error along the eye's direction equal at the near and the far end of
    // the view (Wimmer et al.).
    const double depth_m = std::max(along.high - along.low, 1e-6);
    const double seen_m = std::clamp(scene.nearest_m, std::max(away.low, 0.0), std::max(away.high, 0.0));
    const double near_m = (seen_m + std::sqrt(seen_m * std::max(away.high, 0.0))) / sine;
    const double n = std::clamp(near_m, 1e-3 * depth_m, 1e3 * depth_m);
    const double middle = glm::dot(glm::dvec3(eye.eye_anchor), right);
    double half_m = 1e-6;
    for (const glm::dvec3& point : body) {
        const double w = 1.0 + (glm::dot(point, down) - along.low) / n;
        half_m = std::max(half_m, std::abs(glm::dot(point, right) - middle) / w);
    }
    // The view leaves a margin of four texels at each border, for the texels around a lookup.
    const double kept = 1.0 - 8.0 / static_cast<double>(size);
    const double p = kept * (2.0 * n + depth_m) / depth_m;
    const double q = kept * 2.0 * (n + depth_m) / depth_m;
    const glm::dvec4 w_row(down / n, 1.0 - along.low / n);
    const glm::dvec4 x_row = glm::dvec4(right, -middle) * (kept / half_m);
    const glm::dvec4 y_row = w_row * p - glm::dvec4(0.0, 0.0, 0.0, q);
    const glm::dvec4 z_row(glm::transpose(glm::dmat4(view.clip_from_anchor))[2]);
    view.clip_from_anchor = glm::mat4(glm::transpose(glm::dmat4(x_row, y_row, z_row, w_row)));
    view.right = glm::vec3(right);
    view.down = glm::vec3(down);
    view.extent_m = glm::vec2(2.0 * half_m / kept, 2.0 * n / q);
    view.texel_m = std::max(view.extent_m.x, view.extent_m.y) / static_cast<float>(size);
    view.warp = glm::vec2(p, q);
    return view;
}

} // namespace estampe::shadow
