// SPDX-License-Identifier: MIT
#pragma once

// Smoke in boxes, inked: from grids of densities to paint and ink on the page.

#include <algorithm>
#include <optional>
#include <span>
#include <vector>

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
    glm::vec3 puffs_risen_m{0.0F};    ///< in the grid's axes
    float strokes_risen_m = 0.0F;
    uint32_t number = 0; ///< boxes of other numbers have other puffs

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
    uint32_t shadow = shared::smoke_no_shadow; ///< who knows what stands before it
};

/// What smoke stands in.
struct Surroundings {
    std::span<const Lamp> lamps;
    float ambient = 0.2F; ///< luminance
};

/// Of at most shared::smoke_most_boxes; the lamps that give most light at the middle of each, at most
/// shared::smoke_most_lights, as shares of all that comes there.
[[nodiscard]] shared::SmokeGlobals globals_of(std::span<const Box> boxes, const SmokeStyle& style,
                                              const Surroundings& around);

/// Smoke with its light, ready to be looked at.
struct Volume {
    gpu::ImageId packed;  ///< rgba16f: density and light of a cell and of the next along z
    gpu::BufferId bricks; ///< the densest of each
    bool has_several = false;
};

/// Where that is kept from one graph to another.
class VolumeMemory {
public:
    /// Makes room for the boxes. Throws Error when memory runs out.
    void ensure(gpu::Device& device, const shared::SmokeGlobals& globals);

    /// What add_volume() left.
    [[nodiscard]] Volume import(gpu::Graph& graph);

private:
    friend Volume add_volume(gpu::Graph& graph, VolumeMemory& memory, const SmokeStyle& style,
                             const struct Fields& in);

    shared::SmokeGlobals globals_{}; ///< of the boxes that there is room for
    gpu::Image packed_;
    gpu::Buffer bricks_;
};

/// What stands in the way of lights, as shadow keeps it.
struct SceneShadows {
    gpu::BufferId frame;         ///< FrameGlobals
    gpu::BufferId sun_map;       ///< floats
    gpu::BufferId sun_shadow;    ///< SunShadow
    gpu::BufferId local_shadows; ///< LocalShadow, one a view
    gpu::BufferId local_maps;    ///< floats
    uint32_t variant = 0;        ///< how the sun's map is looked up, see shaders/light_variant.glsl.h
};

/// What the drawing is made from.
struct Fields {
    gpu::BufferId globals; ///< SmokeGlobals
    /// Of each box, r32f, an array; density is in the first layers, and behind it what else the fluid
    /// carries, channel by channel.
    std::vector<gpu::ImageId> densities;
    float ignition = 1.0F;                    ///< temperature from which on fuel burns
    std::optional<SceneShadows> shadows = {}; ///< none: nothing stands in any light's way
};

/// Shapes and lights the smoke, once a picture, and leaves it in `memory`, in which there is room. Cost:
/// three dispatches over the cells of each box, and another of smoke that burns or is moist; a light is
/// followed through an eighth as many.
Volume add_volume(gpu::Graph& graph, VolumeMemory& memory, const SmokeStyle& style, const Fields& in);

struct ViewInputs {
    gpu::BufferId frame;   ///< FrameGlobals
    gpu::BufferId globals; ///< SmokeGlobals
    gpu::ImageId depth;    ///< r32f, reversed
    glm::uvec2 size_px{0};
};

/// rgba32f: opacity; mean light of what is seen of it, a share of all; how far from the eye its edge opacity
/// is reached, 0 where it is not; how it faces the light there, 0 to 1, more than that by 2 for each box
/// before the one that is densest there. Rays go through all boxes at once, by the shortest steps of those
/// that they are in. Cost: a full-screen dispatch, a texel a step within the box and a brick where there is
/// nothing.
[[nodiscard]] gpu::ImageId add_march(gpu::Graph& graph, const Volume& volume, const SmokeStyle& style,
                                     const ViewInputs& in);

/// How much of the sun is left where something is seen, r16f: times `share`, where something else takes of
/// it. Cost: a full-screen dispatch, a texel a cell between there and the sun within boxes.
struct ThrownInputs {
    ViewInputs view;
    std::optional<gpu::ImageId> share; ///< as large as the page
    glm::vec3 towards_sun{0.0F, 1.0F, 0.0F};
};

[[nodiscard]] gpu::ImageId add_thrown(gpu::Graph& graph, const Volume& volume, const SmokeStyle& style,
                                      const ThrownInputs& in);

/// What distance takes, as haze does.
struct Haze {
    gpu::ImageId sky; ///< rgba16f, as large as the page or of one texel
    float start_m = 0.0F;
    float reach_m = 1.0F;
    float ink = 1.0F;
};

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
    std::optional<Haze> haze = {};
};

/// Inks what add_march() found. Cost: a full-screen dispatch; where there is smoke a dozen texels a pixel of
/// a line's width.
[[nodiscard]] Layer add_ink(gpu::Graph& graph, const SmokeStyle& style, const InkInputs& in);

/// How far a pixel's ink hangs on others.
[[nodiscard]] uint32_t reach_px(const SmokeStyle& style, float pixels_per_mm);

} // namespace estampe::smoke
