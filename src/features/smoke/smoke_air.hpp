// SPDX-License-Identifier: MIT
#pragma once

// The air in a box of smoke: the fluid's settings from the style, and its obstacles, which are the cells
// that the scene's surfaces touch.

#include <cstdint>
#include <optional>
#include <vector>

#include <glm/glm.hpp>

#include <estampe/scene.hpp>

#include "features/common/blast.hpp"
#include "techniques/fluid/fluid.hpp"
#include "techniques/smoke/smoke.hpp"

namespace estampe::features {

/// Speed of the air through a smoke box, and the box's size.
struct Draught {
    float speed_m_per_s = 1.0F;
    float width_m = 1.0F;
    float height_m = 1.0F;
    glm::vec3 wind_m_per_s{0.0F}; ///< Wind in metres per second, along the grid's axes
};

[[nodiscard]] Draught draught_of(const smoke::Box& box, const smoke::SmokeStyle& style);

/// Temperature above which fuel burns, in the units of the simulation. The air in a source reaches this
/// temperature within the height of the source.
inline constexpr float smoke_ignition = 0.2F;

/// Returns the number of quantities that the air carries: density and temperature, plus fuel or water if the
/// style has them.
[[nodiscard]] uint32_t smoke_channels(const smoke::SmokeStyle& style);

/// Returns the least number of simulation steps per second for smoke: at least 24, and so many that in one
/// step the wind crosses at most half the zone at the open faces, and that exploding air grows by a factor of
/// at most sqrt(e); but at most 480.
[[nodiscard]] double steps_per_s(const smoke::Box& box, const smoke::SmokeStyle& style);

/// Returns the simulation grid of a smoke box; all its faces are open.
[[nodiscard]] fluid::Grid grid_of(const smoke::Box& box);

/// Returns the fluid simulation's settings for steps of `step_s`.
[[nodiscard]] fluid::FluidStyle solving(const smoke::Box& box, const smoke::SmokeStyle& style, double step_s);

[[nodiscard]] fluid::Source source_of(const smoke::Box& box, const smoke::SmokeStyle& style);

/// Returns the source in the step of `step_s` in which a blast goes off. The air in the source becomes hotter
/// by smoke.blast_heat, and gets as much smoke as fills the air with smoke of density 1 once it has expanded.
[[nodiscard]] fluid::Source blasting_source_of(const smoke::Box& box, const smoke::SmokeStyle& style,
                                               double step_s);

/// Returns the blast of a smoke box; none if the style has no blast, or if the blast's heat is too low for an
/// explosion. The ball of the blast has the volume of the source above the box's floor. `anchor` is the
/// origin of positions on the device.
[[nodiscard]] std::optional<Blast> blast_of(const smoke::Box& box, const smoke::SmokeStyle& style,
                                            const glm::dvec3& anchor);

/// Returns the air's initial velocity: wind with slight turbulence. Without turbulence smoke would rise in a
/// straight column.
[[nodiscard]] std::vector<float> stirred_air(const smoke::Box& box, const smoke::SmokeStyle& style);

/// Returns the air's initial quantities for fluid::Fluid: the water vapour of the outside air, limited by
/// saturation. Empty if the air is dry.
[[nodiscard]] std::vector<float> clean_air(const smoke::Box& box, const smoke::SmokeStyle& style);

/// Finds the cells of a smoke box that solid objects occupy. One flag per cell, row by row and layer by
/// layer: 1 if a triangle of a rigid mesh touches the cell in this pose. Source: Akenine-Moeller, "Fast 3D
/// Triangle-Box Overlap Testing", 2001. Cost: linear in triangles, and in the cells around each.
[[nodiscard]] std::vector<uint8_t> standing_cells(const Scene& scene, const ScenePose& pose,
                                                  const glm::dvec3& anchor, const smoke::Box& box);

} // namespace estampe::features
