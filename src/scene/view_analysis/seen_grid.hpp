// SPDX-License-Identifier: MIT
#pragma once

// A coarse picture of a cloud: for each cell of a square grid the nearest point.

#include <cstdint>
#include <span>
#include <vector>

#include "scene/view_analysis/surface_points.hpp"
#include "scene/view_analysis/view_axes.hpp"

namespace estampe {

struct SeenGrid {
    static constexpr int side = 64;
    static constexpr uint32_t nothing = 0xffffffffU;

    std::vector<uint32_t> nearest = std::vector<uint32_t>(side * side, nothing); ///< into the cloud's points
    std::vector<float> depth_m = std::vector<float>(side * side, 0.0F);          ///< along the view
    float cell_m = 1.0F;
};

/// What a parallel view shows of the points within `frame` (world space). Single-sided surfaces are seen from
/// their front alone, unless `all_sides`. Cost: linear in points.
[[nodiscard]] SeenGrid see_from_afar(const SurfaceCloud& cloud, const ViewAxes& axes, const Bounds& frame,
                                     bool all_sides = false);

/// The points that a grid shows, one a cell.
[[nodiscard]] std::vector<uint32_t> seen_points(const SeenGrid& seen);

/// Marks the points that a parallel view of the whole cloud shows from their front. Cost: two visits of
/// all points.
void mark_shown(const SurfaceCloud& cloud, const ViewAxes& axes, std::vector<bool>& shown);

/// How much there is to draw in a view, about 0 to 1: edges against the paper, steps in depth and bends of
/// the surface, finely meshed parts, and area.
[[nodiscard]] double interest(const SurfaceCloud& cloud, const SeenGrid& seen);

/// Which of the `points` (into the cloud's) a parallel light from `towards_light` reaches and faces, as a
/// share of them. Cost: linear in the cloud's points.
[[nodiscard]] double lit_share(const SurfaceCloud& cloud, std::span<const uint32_t> points,
                               const ViewAxes& from_eye, const glm::dvec3& towards_light);

} // namespace estampe
