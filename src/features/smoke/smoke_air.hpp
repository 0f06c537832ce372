// SPDX-License-Identifier: MIT
#pragma once

// The air in a box of smoke: what a style asks of the fluid there, and what it flows around, the cells that
// a scene's surfaces go through.

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include <estampe/scene.hpp>

#include "techniques/fluid/fluid.hpp"
#include "techniques/smoke/smoke.hpp"

namespace estampe::features {

/// How fast smoke goes through a box.
struct Draught {
    float speed_m_per_s = 1.0F;
    float width_m = 1.0F;
    float height_m = 1.0F;
    glm::vec3 wind_m_per_s{0.0F}; ///< in the grid's axes
};

[[nodiscard]] Draught draught_of(const smoke::Box& box, const smoke::SmokeStyle& style);

/// Temperature from which on fuel burns; a source makes it in less than its own height.
inline constexpr float smoke_ignition = 0.2F;

/// What that air carries: density and heat; fuel, where there is some; and water, where there is some.
[[nodiscard]] uint32_t smoke_channels(const smoke::SmokeStyle& style);

/// How many steps the air takes at least: 24, or so many that wind carries nothing in one of them farther
/// than half the rim at the open ends, which would not notice it; but no more than 480.
[[nodiscard]] double steps_per_s(const smoke::Box& box, const smoke::SmokeStyle& style);

/// Open on all sides.
[[nodiscard]] fluid::Grid grid_of(const smoke::Box& box);

/// For steps of that length.
[[nodiscard]] fluid::FluidStyle solving(const smoke::Box& box, const smoke::SmokeStyle& style, double step_s);

[[nodiscard]] fluid::Source source_of(const smoke::Box& box, const smoke::SmokeStyle& style);

/// At the start: air that stirs a little, or smoke would rise as straight as a column.
[[nodiscard]] std::vector<float> stirred_air(const smoke::Box& box, const smoke::SmokeStyle& style);

/// What air carries at the start, as fluid::Fluid takes it: no more than the air outside. Empty where that is
/// nothing.
[[nodiscard]] std::vector<float> clean_air(const smoke::Box& box, const smoke::SmokeStyle& style);

/// A flag for each cell of the box, row by row and layer by layer, that a triangle of a rigid mesh touches,
/// as the scene stands. Source: Akenine-Moeller, "Fast 3D Triangle-Box Overlap Testing", 2001. Cost: linear
/// in triangles, and in the cells about each.
[[nodiscard]] std::vector<uint8_t> standing_cells(const Scene& scene, const ScenePose& pose,
                                                  const glm::dvec3& anchor, const smoke::Box& box);

} // namespace estampe::features
