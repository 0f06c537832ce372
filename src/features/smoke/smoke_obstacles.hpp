// SPDX-License-Identifier: MIT
#pragma once

// What smoke flows around: the cells of its box that a scene's surfaces go through.

#include <cstdint>
#include <vector>

#include <estampe/scene.hpp>

#include "techniques/smoke/smoke.hpp"

namespace estampe::features {

/// A flag for each cell of the box, row by row and layer by layer, that a triangle of a rigid mesh touches,
/// as the scene stands. Source: Akenine-Moeller, "Fast 3D Triangle-Box Overlap Testing", 2001. Cost: linear
/// in triangles, and in the cells about each.
[[nodiscard]] std::vector<uint8_t> standing_cells(const Scene& scene, const ScenePose& pose,
                                                  const glm::dvec3& anchor, const smoke::Box& box);

} // namespace estampe::features
