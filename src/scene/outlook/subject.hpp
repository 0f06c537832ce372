// SPDX-License-Identifier: MIT
#pragma once

#include "scene/outlook/surface_points.hpp"

namespace estampe {

/// What a picture of the scene should show: all of it, but of a floor much wider than what stands on it only
/// the part below that. In world space; the lowest point of what stands is at the floor. Cost: linear in
/// points.
[[nodiscard]] Bounds subject_bounds(const SurfaceCloud& cloud);

/// The cloud without what lies outside of `subject`.
[[nodiscard]] SurfaceCloud within(const SurfaceCloud& cloud, const Bounds& subject);

} // namespace estampe
