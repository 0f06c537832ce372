// SPDX-License-Identifier: MIT
#pragma once

// Draws smoke in boxes: from grids of densities to paint and ink on the page.

#include <algorithm>
#include <optional>
#include <span>
#include <vector>

#include "gpu/graph/graph.hpp"
#include "gpu/resources.hpp"
#include "techniques/smoke/smoke.glsl.h"
#include "techniques/smoke/smoke_style.hpp"

namespace estampe::smoke {

/// A grid of cells in anchor space.
struct Box {
    glm::uvec3 cells{0};
    float cell_m = 1.0F;
    glm::mat4 grid_from_anchor{1.0F}; ///< in cells, from the low corner
    glm::vec3 puffs_risen_m{0.0F};    ///< displacement of the puffs, in the grid's axes
    float strokes_risen_m = 0.0F;
    uint32_t number = 0; ///< boxes with different numbers have different puffs

    [[nodiscard]] float width_m() const { return cell_m * static_cast<float>(std::min(cells.x, cells.z)); }
};

/// A light of the scene.
struct Lamp {
    glm::vec3 place{0.0F};   ///< in anchor space; for a directional light, a vector towards it
    glm::vec3 beam{0.0F};    ///< direction of a spot's beam
    float luminance = 0.0F;  ///< at one metre; at any distance for a directional light
    float range_m = 0.0F;    ///< 0: directional
    float cone_scale = 0.0F; ///< spots: factor saturate(cos(angle) * scale + offset) squared
    float cone_offset = 1.0F;
    uint32_t shadow = shared::smoke_no_shadow; ///< shadow map of the lamp
};

/// The light around the smoke.
struct Surroundings {
    std::span<const Lamp> lamps;
    float ambient = 0.2F; ///< luminance
};

/// Constants for at most shared::smoke_most_boxes boxes. Each box uses its strongest lamps, at most
/// shared::smoke_most_lights, as shares of all light at its middle.
[[nodiscard]] shared::SmokeGlobals globals_of(std::span<const Box> boxes, const SmokeStyle& style,
                                              const Surroundings& around);

/// Smoke with its lighting, ready for ray marching.
struct Volume {
    gpu::ImageId packed;  ///< rgba16f: density and light of a cell and of the next one along z
    gpu::BufferId bricks; ///< highest density of each brick
    bool has_several = false;
};

/// Keeps a Volume from one graph to another.
class VolumeMemory {
public:
    /// Allocates memory for the boxes. Throws Error when memory runs out.
    void ensure(gpu::Device& device, const shared::SmokeGlobals& globals);

    /// Imports the result of add_volume().
    [[nodiscard]] Volume import(gpu::Graph& graph);

private:
    friend Volume add_volume(gpu::Graph& graph, VolumeMemory& memory, const SmokeStyle& style,
                             const struct Fields& in);

    shared::SmokeGlobals globals_{}; ///< globals of the boxes that memory is allocated for
    gpu::Image packed_;
    gpu::Buffer bricks_;
};

/// The scene's shadow maps, in the format of techniques/shadow.
struct SceneShadows {
    gpu::BufferId frame;         ///< FrameGlobals
    gpu::BufferId sun_map;       ///< one float per texel
    gpu::BufferId sun_shadow;    ///< SunShadow
    gpu::BufferId local_shadows; ///< LocalShadow, one per view
    gpu::BufferId local_maps;    ///< one float per texel
    uint32_t variant = 0;        ///< variant bits of the sun's shadow map, see shaders/light_variant.glsl.h
};

/// Inputs of add_volume().
struct Fields {
    gpu::BufferId globals; ///< SmokeGlobals
    /// One r32f image array per box: the density in the first layers, followed by the fluid's other channels.
    std::vector<gpu::ImageId> densities;
    float ignition = 1.0F;                    ///< temperature from which fuel burns
    std::optional<SceneShadows> shadows = {}; ///< none: the scene casts no shadow on the smoke
};

/// Shapes and lights the smoke once per picture, and stores it in `memory`, after VolumeMemory::ensure().
/// Cost: three dispatches over the cells of each box, and another for smoke that burns or is moist; the light
/// grid has an eighth of the cells.
Volume add_volume(gpu::Graph& graph, VolumeMemory& memory, const SmokeStyle& style, const Fields& in);

struct ViewInputs {
    gpu::BufferId frame;   ///< FrameGlobals
    gpu::BufferId globals; ///< SmokeGlobals
    gpu::ImageId depth;    ///< r32f, reversed
    glm::uvec2 size_px{0};
};

/// Marches rays through the smoke. Writes rgba32f: opacity; mean light of the visible smoke, as a share of
/// all light; distance at which the edge opacity is reached, 0 if it is not reached; and the orientation
/// towards the light there, 0 to 1, plus 2 times the index of the densest box there. A ray passes all boxes
/// at once. Its step is the shortest of the steps of the boxes around the sample. Cost: a full-screen
/// dispatch, a texel read per step in boxes and per empty brick.
[[nodiscard]] gpu::ImageId add_march(gpu::Graph& graph, const Volume& volume, const SmokeStyle& style,
                                     const ViewInputs& in);

/// Share of sunlight that the smoke lets through to visible surfaces, r16f, multiplied by `share` if given.
/// Cost: a full-screen dispatch, a texel read per cell between the surface and the sun within boxes.
struct ThrownInputs {
    ViewInputs view;
    std::optional<gpu::ImageId> share; ///< page-sized
    glm::vec3 towards_sun{0.0F, 1.0F, 0.0F};
};

[[nodiscard]] gpu::ImageId add_thrown(gpu::Graph& graph, const Volume& volume, const SmokeStyle& style,
                                      const ThrownInputs& in);

/// Fading with distance, as in techniques/haze.
struct Haze {
    gpu::ImageId sky; ///< rgba16f, page-sized or one texel
    float start_m = 0.0F;
    float reach_m = 1.0F;
    float ink = 1.0F;
};

/// The drawn smoke.
struct Layer {
    gpu::ImageId paint; ///< rgba8: square roots of the paint's transmittance, coverage in alpha
    gpu::ImageId ink;   ///< r16f: lines and strokes over the paint
};

struct InkInputs {
    ViewInputs view;
    gpu::ImageId marched;       ///< result of add_march()
    gpu::ImageId lines;         ///< rgba8, lines of the scene: coverage in alpha
    float scene_line_px = 1.0F; ///< half the width of the widest line
    float pixels_per_mm = 1.0F;
    std::optional<Haze> haze = {};
};

/// Draws the result of add_march(). Cost: a full-screen dispatch. Pixels with smoke read a dozen texels per
/// pixel of the line width.
[[nodiscard]] Layer add_ink(gpu::Graph& graph, const SmokeStyle& style, const InkInputs& in);

/// The distance in pixels within which other pixels may affect a pixel's ink.
[[nodiscard]] uint32_t reach_px(const SmokeStyle& style, float pixels_per_mm);

} // namespace estampe::smoke
