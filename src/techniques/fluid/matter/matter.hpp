// SPDX-License-Identifier: MIT
#pragma once

// Obstacles and sources: shapes that move through a fluid. And what becomes of the quantities that it
// carries, besides being carried.

#include <array>
#include <span>
#include <vector>

#include "gpu/resources.hpp"
#include "techniques/fluid/grid.hpp"
#include "techniques/fluid/motion/motion.hpp"
#include "techniques/fluid/pressure/projection.hpp"

namespace estampe::fluid {

/// A box turned about z, and all that is no farther than `radius_m` from it. Along z only volumes have a
/// size.
struct Shape {
    glm::vec3 centre_m{0.0F}; ///< from the grid's low corner
    glm::vec3 half_m{0.0F};   ///< of the box, along its own axes
    float radius_m = 0.0F;
    float angle_rad = 0.0F; ///< from x towards y
    glm::vec3 velocity_m_per_s{0.0F};
    float spin_rad_s = 0.0F;
};

[[nodiscard]] Shape disc(glm::vec3 centre_m, float radius_m);
[[nodiscard]] Shape box(glm::vec3 centre_m, glm::vec3 half_m, float angle_rad = 0.0F);
/// So long from the middle of one end to that of the other.
[[nodiscard]] Shape capsule(glm::vec3 centre_m, float length_m, float radius_m, float angle_rad = 0.0F);

/// Where something comes into the fluid.
struct Source {
    Shape shape;
    float push_per_s = 0.0F; ///< how quickly what is within takes up the shape's velocity
    std::array<float, shared::fluid_most_channels> gain_per_s{}; ///< of quantities, channel by channel
    float least_density = 0.0F; ///< of what is within after a step, however quickly it goes through
    float least_vapour = 0.0F;  ///< likewise, before any of it condenses
};

/// Obstacles and sources of a fluid, on the device.
class Shapes {
public:
    explicit Shapes(gpu::Device& device);

    /// Throws std::logic_error for more than 64 in all. No graph that reads them may be running.
    void set(std::span<const Shape> obstacles, std::span<const Source> sources);

    /// Lets all that moves move on.
    void advance(float time_s);

    /// Writes where they are, for the graph that runs next.
    [[nodiscard]] gpu::BufferId upload(gpu::Graph& graph);

    /// For a moment so long after that of upload().
    [[nodiscard]] shared::FluidShapes constants(const Grid& grid, float age_s, float step_s,
                                                uint32_t channels) const;

    /// Whether a source pushes what is in it.
    [[nodiscard]] bool are_pushing() const;

    [[nodiscard]] bool are_solid() const { return obstacle_count_ > 0; }

private:
    gpu::Buffer buffer_;
    std::vector<shared::FluidShape> shapes_;
    uint32_t obstacle_count_ = 0;
};

/// Which cells are in obstacles, written over `cells`. `standing` has a word a cell, fluid_stands_still or 0,
/// or is too small for that where nothing stands still for good.
[[nodiscard]] Solids add_solids(gpu::Graph& graph, const Grid& grid, gpu::BufferId shapes,
                                const shared::FluidShapes& constants, gpu::BufferId standing,
                                gpu::BufferId cells);

/// `velocity` with that of obstacles on their faces, and pushed by sources.
[[nodiscard]] gpu::ImageId add_push(gpu::Graph& graph, const Grid& grid, gpu::BufferId shapes,
                                    const shared::FluidShapes& constants, const Solids& solids,
                                    gpu::ImageId velocity);

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
