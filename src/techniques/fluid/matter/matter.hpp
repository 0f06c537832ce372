// SPDX-License-Identifier: MIT
#pragma once

// What becomes of the quantities that a fluid carries, besides being carried.

#include "techniques/fluid/matter/shapes.hpp"
#include "techniques/fluid/motion/advection.hpp"

namespace estampe::fluid {

/// Channels 0 to 4 are density, temperature above that of the surroundings, fuel, vapour and cloud; what a
/// fluid has too few channels for does not happen. Those from 5 on are for colours and the like.
struct MatterStyle {
    float fading_per_s = 0.0F;  ///< of density
    float cooling_per_s = 0.0F; ///< of temperature

    float burning_per_s = 0.0F; ///< share of the fuel, at first, where it is as hot as `ignition`
    float ignition = 1.0F;
    float heat_of_fuel = 1.0F;  ///< temperature by a unit of fuel
    float smoke_of_fuel = 1.0F; ///< density by a unit of fuel

    float condensing_per_s =
        0.0F; ///< share of the vapour that is too much, or lacks where there is cloud, at first
    float saturation = 1.0F;        ///< vapour that air holds at y = 0, no warmer than its surroundings
    float saturation_growth = 0.0F; ///< of the logarithm of it, by a unit of temperature
    float saturation_fall_per_m =
        0.0F;                 ///< of the logarithm of it, by height: the surroundings are colder above
    float latent_heat = 0.0F; ///< temperature by a unit of vapour that condenses

    Rim rim; ///< where density, heat, fuel and cloud leave, and vapour becomes that of the air outside
    float outside_vapour = 0.0F; ///< where air as warm as the surroundings holds as much; else what it holds

    bool operator==(const MatterStyle&) const = default;
};

/// `quantities` after a step of it, and of what sources bring; themselves when there is nothing to do.
[[nodiscard]] gpu::ImageId add_matter(gpu::Graph& graph, const Grid& grid, const MatterStyle& style,
                                      gpu::BufferId shapes, const shared::FluidShapes& constants,
                                      gpu::ImageId quantities);

/// The same of what MacCormack's scheme has carried, corrected first, into `target`: one pass for both.
[[nodiscard]] gpu::ImageId add_corrected_matter(gpu::Graph& graph, const Grid& grid, const MatterStyle& style,
                                                gpu::BufferId shapes, const shared::FluidShapes& constants,
                                                const ThereAndBack& carried, gpu::ImageId target);

} // namespace estampe::fluid
