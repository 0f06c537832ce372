// SPDX-License-Identifier: MIT
#pragma once

// Obstacles and sources: shapes that move through a fluid.

#include <array>
#include <span>
#include <vector>

#include "gpu/resources.hpp"
#include "techniques/fluid/grid.hpp"
#include "techniques/fluid/pressure/projection.hpp"

namespace estampe::fluid {

/// A box turned about z, and all that is no farther than `radius_m` from it. Along z only volumes have a
/// size.
struct Shape {
    glm::vec3 centre_m{0.0F}; ///< from the grid's low corner
    glm::vec3 half_m{0.0F};   ///< of the box, along its own axes
    float radius_m = 0.0F;
    float angle_rad = 0.0F; ///< from x towards y
    glm::vec3 velocity_m_s{0.0F};
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

} // namespace estampe::fluid
