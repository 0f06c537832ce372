// SPDX-License-Identifier: MIT
#pragma once

// Obstacles and sources: shapes that move through a fluid. Also changes of the quantities besides advection:
// fading, cooling, combustion, condensation.

#include <array>
#include <span>
#include <vector>

#include "gpu/resources.hpp"
#include "techniques/fluid/grid.hpp"
#include "techniques/fluid/motion/motion.hpp"
#include "techniques/fluid/pressure/projection.hpp"

namespace estampe::fluid {

/// A rounded box turned about z, used for obstacles and sources: all points within `radius_m` of the box.
/// Sizes along z only count in 3D.
struct Shape {
    glm::vec3 centre_m{0.0F}; ///< centre of the shape, from the grid's low corner
    glm::vec3 half_m{0.0F};   ///< half size of the box along the box's own axes
    float radius_m = 0.0F;
    float angle_rad = 0.0F; ///< rotation about z, from x towards y
    glm::vec3 velocity_m_per_s{0.0F};
    float spin_rad_s = 0.0F;
};

[[nodiscard]] Shape disc(glm::vec3 centre_m, float radius_m);
[[nodiscard]] Shape box(glm::vec3 centre_m, glm::vec3 half_m, float angle_rad = 0.0F);
/// Makes a capsule. `length_m` is the distance between the centres of the capsule's two round ends.
[[nodiscard]] Shape capsule(glm::vec3 centre_m, float length_m, float radius_m, float angle_rad = 0.0F);

/// A shape that brings smoke, heat or further quantities into the fluid.
struct Source {
    Shape shape;
    float push_per_s = 0.0F; ///< rate at which the fluid inside approaches the shape's velocity
    std::array<float, shared::fluid_most_channels> gain_per_s{}; ///< gain of each quantity per second
    float least_density = 0.0F; ///< lowest density inside after a step, however fast the fluid passes
    float least_vapour = 0.0F;  ///< lowest vapour inside the source, before condensation
};

/// Obstacles and sources of a fluid on the GPU.
class Shapes {
public:
    explicit Shapes(gpu::Device& device);

    /// Replaces all obstacles and sources. Throws std::logic_error for more than 64 in total. No graph that
    /// reads the shapes may be running.
    void set(std::span<const Shape> obstacles, std::span<const Source> sources);

    /// Moves all obstacles and sources along their velocities by `time_s`.
    void advance(float time_s);

    /// Uploads the current positions of obstacles and sources for the next graph.
    [[nodiscard]] gpu::BufferId upload(gpu::Graph& graph);

    /// Shader constants of obstacles and sources, `age_s` seconds after upload().
    [[nodiscard]] shared::FluidShapes constants(const Grid& grid, float age_s, float step_s,
                                                uint32_t channels) const;

    /// Whether any source accelerates the fluid inside the source.
    [[nodiscard]] bool are_pushing() const;

    [[nodiscard]] bool are_solid() const { return obstacle_count_ > 0; }

private:
    gpu::Buffer buffer_;
    std::vector<shared::FluidShape> shapes_;
    uint32_t obstacle_count_ = 0;
};

/// Adds a pass that writes for each cell which obstacle contains it into `cells`. `standing` has one word per
/// cell, fluid_stands_still or 0; if no cell is solid permanently, `standing` may be shorter.
[[nodiscard]] Solids add_solids(gpu::Graph& graph, const Grid& grid, gpu::BufferId shapes,
                                const shared::FluidShapes& constants, gpu::BufferId standing,
                                gpu::BufferId cells);

/// Adds a pass that returns `velocity` with the velocities of obstacles on the obstacles' faces, and with the
/// push of sources.
[[nodiscard]] gpu::ImageId add_push(gpu::Graph& graph, const Grid& grid, gpu::BufferId shapes,
                                    const shared::FluidShapes& constants, const Solids& solids,
                                    gpu::ImageId velocity);

/// Changes of a fluid's quantities besides advection. Channels 0 to 4 are density, temperature relative to
/// the surroundings, fuel, vapour and cloud. Effects on missing channels are skipped. Channels from 5 on are
/// free, for example for colours.
struct MatterStyle {
    float fading_per_s = 0.0F;  ///< rate at which density decays
    float cooling_per_s = 0.0F; ///< rate at which the temperature approaches that of the surroundings

    float burning_per_s = 0.0F; ///< share of the fuel that burns per second at `ignition` or hotter
    float ignition = 1.0F;
    float heat_of_fuel = 1.0F;  ///< gain of temperature per unit of burnt fuel
    float smoke_of_fuel = 1.0F; ///< gain of density per unit of burnt fuel

    /// Share per second of excess vapour that condenses, or of lacking vapour that evaporates from cloud.
    float condensing_per_s = 0.0F;
    float saturation = 1.0F;            ///< vapour that air holds at y = 0 at the surroundings' temperature
    float saturation_growth = 0.0F;     ///< growth of the logarithm of saturation per unit of temperature
    float saturation_fall_per_m = 0.0F; ///< fall of the logarithm of saturation per metre of height, because
                                        ///< the surroundings are colder above
    float latent_heat = 0.0F;           ///< gain of temperature per unit of condensed vapour

    /// Temperature above which the fluid expands until it has cooled to this temperature, see add_swelling();
    /// 0: the fluid never expands.
    float expands_above = 0.0F;
    float expansion_per_s = 0.0F; ///< rate at which the excess of temperature turns into volume

    Rim rim; ///< layer where density, heat, fuel and cloud leave, and vapour becomes `outside_vapour`
    float outside_vapour = 0.0F; ///< vapour of the outside air, limited by the air's saturation

    bool operator==(const MatterStyle&) const = default;
};

/// Whether fluid with `channels` quantities may expand.
[[nodiscard]] inline bool is_expanding(const MatterStyle& style, uint32_t channels)
{
    return style.expands_above > 0.0F && channels > shared::fluid_temperature;
}

/// Adds a pass that applies one step of MatterStyle and of the sources to `quantities`. Returns `quantities`
/// itself if nothing changes the quantities.
[[nodiscard]] gpu::ImageId add_matter(gpu::Graph& graph, const Grid& grid, const MatterStyle& style,
                                      gpu::BufferId shapes, const shared::FluidShapes& constants,
                                      gpu::ImageId quantities);

/// Adds a pass like add_matter() that first applies MacCormack's correction (of advection blur) to `carried`,
/// and writes the result into `target`.
[[nodiscard]] gpu::ImageId add_corrected_matter(gpu::Graph& graph, const Grid& grid, const MatterStyle& style,
                                                gpu::BufferId shapes, const shared::FluidShapes& constants,
                                                const ThereAndBack& carried, gpu::ImageId target);

} // namespace estampe::fluid
