// SPDX-License-Identifier: MIT
#pragma once

// Smoke in a box, inked: from a grid of densities to paint and ink on the page.

#include <algorithm>
#include <span>

#include "gpu/graph/graph.hpp"
#include "gpu/resources.hpp"
#include "techniques/smoke/smoke.glsl.h"
#include "techniques/smoke/smoke_style.hpp"

namespace estampe::smoke {

/// A grid of cells somewhere in anchor space.
struct Box {
    glm::uvec3 cells{0};
    float cell_m = 1.0F;
    glm::mat4 grid_from_anchor{1.0F}; ///< in cells, from the low corner

    [[nodiscard]] float width_m() const { return cell_m * static_cast<float>(std::min(cells.x, cells.z)); }
};

/// A light of the scene.
struct Lamp {
    glm::vec3 place{0.0F};   ///< in anchor space; of a directional light towards it
    glm::vec3 beam{0.0F};    ///< of spots, along it
    float luminance = 0.0F;  ///< at one metre; of a directional light anywhere
    float range_m = 0.0F;    ///< 0: directional
    float cone_scale = 0.0F; ///< saturate(cos(angle) * scale + offset) squared arrives
    float cone_offset = 1.0F;
};

/// What smoke stands in.
struct Surroundings {
    std::span<const Lamp> lamps;
    float ambient = 0.2F;          ///< luminance
    glm::vec3 puffs_risen_m{0.0F}; ///< in the grid's axes
};

/// The lamps that give most light at the middle of the box, at most shared::smoke_most_lights, as shares of
/// all that comes there.
[[nodiscard]] shared::SmokeGlobals globals_of(const Box& box, const SmokeStyle& style,
                                              const Surroundings& around);

[[nodiscard]] inline uint32_t puff_count_of(const shared::SmokeGlobals& globals)
{
    return globals.puff_counts.x * globals.puff_counts.y * globals.puff_counts.z;
}

/// Smoke with its light, ready to be looked at.
struct Volume {
    gpu::ImageId packed;  ///< rgba16f: density and light of a cell and of the next along z
    gpu::BufferId bricks; ///< the densest of each
};

/// Where that is kept from one graph to another.
class VolumeMemory {
public:
    /// Makes room for so many cells. Throws Error when memory runs out.
    void provide(gpu::Device& device, const glm::uvec3& cells);

    /// What add_volume() left.
    [[nodiscard]] Volume import(gpu::Graph& graph);

private:
    friend Volume add_volume(gpu::Graph& graph, VolumeMemory& memory, const SmokeStyle& style,
                             const struct Fields& in);

    glm::uvec3 cells_{0};
    gpu::Image packed_;
    gpu::Buffer bricks_;
};

/// What the drawing is made from.
struct Fields {
    gpu::BufferId globals;   ///< SmokeGlobals
    gpu::ImageId density;    ///< r32f, an array; density is in the first layers
    uint32_t puff_count = 0; ///< of puff_count_of()
};

/// Shapes and lights the smoke, once a picture, and leaves it in `memory`, in which there is room. Cost:
/// three dispatches over cells; a light is followed through an eighth as many.
Volume add_volume(gpu::Graph& graph, VolumeMemory& memory, const SmokeStyle& style, const Fields& in);

struct ViewInputs {
    gpu::BufferId frame;   ///< FrameGlobals
    gpu::BufferId globals; ///< SmokeGlobals
    gpu::ImageId depth;    ///< r32f, reversed
    glm::uvec2 size_px{0};
};

/// rgba32f: opacity; mean light of what is seen of it, a share of all; how far from the eye its edge opacity
/// is reached, 0 where it is not; how it faces the light there, 0 to 1. Cost: a full-screen dispatch, a texel
/// a step within the box and a brick where there is nothing.
[[nodiscard]] gpu::ImageId add_march(gpu::Graph& graph, const Volume& volume, const SmokeStyle& style,
                                     const ViewInputs& in);

/// What is laid on the page.
struct Layer {
    gpu::ImageId paint; ///< rgba8: roots of what the paint lets through, cover in alpha
    gpu::ImageId ink;   ///< r16f: lines and strokes over it
};

struct InkInputs {
    ViewInputs view;
    gpu::ImageId marched;       ///< of add_march
    gpu::ImageId lines;         ///< rgba8, of the scene: coverage in alpha
    float scene_line_px = 1.0F; ///< half the widest of them
    float pixels_per_mm = 1.0F;
    float width_m = 1.0F; ///< of the box
    float rise_m = 0.0F;  ///< how far strokes have risen with the smoke
};

/// Inks what add_march() found. Cost: a full-screen dispatch; where there is smoke a dozen texels a pixel of
/// a line's width.
[[nodiscard]] Layer add_ink(gpu::Graph& graph, const SmokeStyle& style, const InkInputs& in);

/// How far a pixel's ink hangs on others.
[[nodiscard]] uint32_t reach_px(const SmokeStyle& style, float pixels_per_mm);

} // namespace estampe::smoke
