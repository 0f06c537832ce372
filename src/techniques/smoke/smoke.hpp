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

/// A box of smoke: a grid of cells in anchor space (coordinates relative to a nearby origin).
struct Box {
    glm::uvec3 cells{0};
    float cell_m = 1.0F;
    glm::mat4 grid_from_anchor{1.0F}; ///< transform from anchor space (relative to a nearby origin) to cells
    glm::vec3 puffs_risen_m{0.0F};    ///< distance that the puffs have moved, in the grid's axes
    float strokes_risen_m = 0.0F;
    uint32_t number = 0; ///< number of the box; boxes with different numbers have different puffs

    [[nodiscard]] float width_m() const { return cell_m * static_cast<float>(std::min(cells.x, cells.z)); }
};

/// A light of the scene that lights smoke.
struct Lamp {
    /// Position relative to a nearby origin; for a directional light, a vector to the light.
    glm::vec3 place{0.0F};
    glm::vec3 beam{0.0F};   ///< direction of a spot's beam
    float luminance = 0.0F; ///< luminance at one metre, or at any distance for a directional light
    float range_m = 0.0F;   ///< range of the light; 0: a directional light
    /// For spots: the cone's factor is saturate(cos(angle) * scale + offset) squared.
    float cone_scale = 0.0F;
    float cone_offset = 1.0F;
    uint32_t shadow = shared::smoke_no_shadow; ///< number of the lamp's shadow map
};

/// The lights around the smoke.
struct Surroundings {
    std::span<const Lamp> lamps;
    float ambient = 0.2F; ///< luminance of ambient light
};

/// Makes the shader constants for at most shared::smoke_most_boxes boxes. Each box uses its strongest lamps,
/// at most shared::smoke_most_lights, as shares of all light at its middle.
[[nodiscard]] shared::SmokeGlobals globals_of(std::span<const Box> boxes, const SmokeStyle& style,
                                              const Surroundings& around);

/// Smoke with its lighting, ready for ray marching.
struct Volume {
    gpu::ImageId packed;  ///< rgba16f: density and light of a cell and of the next cell along z
    gpu::BufferId bricks; ///< highest density of smoke in each brick
    bool has_several = false;
};

/// Keeps a Volume of smoke from one graph to another.
class VolumeMemory {
public:
    /// Allocates memory for the smoke boxes. Throws Error when memory runs out.
    void ensure(gpu::Device& device, const shared::SmokeGlobals& globals);

    /// Imports the kept result of add_volume() into a graph.
    [[nodiscard]] Volume import(gpu::Graph& graph);

private:
    friend Volume add_volume(gpu::Graph& graph, VolumeMemory& memory, const SmokeStyle& style,
                             const struct Fields& in);

    shared::SmokeGlobals globals_{}; ///< constants of the boxes that memory is allocated for
    gpu::Image packed_;
    gpu::Buffer bricks_;
};

/// The scene's shadow maps, in the format of techniques/shadow.
struct SceneShadows {
    gpu::BufferId frame;         ///< buffer with a FrameGlobals record
    gpu::BufferId sun_map;       ///< the sun's shadow map, one float per texel
    gpu::BufferId sun_shadow;    ///< buffer with a SunShadow record
    gpu::BufferId local_shadows; ///< LocalShadow records, one per view
    gpu::BufferId local_maps;    ///< shadow maps of local lights, one float per texel
    uint32_t variant = 0; ///< bits of `variant` for the sun's shadow map, see shaders/light_variant.glsl.h
};

/// The fields of smoke and their surroundings, as inputs of add_volume().
struct Fields {
    gpu::BufferId globals; ///< buffer with a SmokeGlobals record
    /// One r32f image array per smoke box: the density in the first layers, followed by the fluid's other
    /// channels.
    std::vector<gpu::ImageId> densities;
    float ignition = 1.0F;                    ///< lowest temperature at which fuel burns
    std::optional<SceneShadows> shadows = {}; ///< empty: the scene casts no shadow on the smoke
};

/// Shapes and lights the smoke once per picture, and stores it in `memory`. Requires VolumeMemory::ensure()
/// before. Cost: three dispatches over the cells of each box, and another for smoke that burns or is moist;
/// the light grid has an eighth of the cells.
Volume add_volume(gpu::Graph& graph, VolumeMemory& memory, const SmokeStyle& style, const Fields& in);

struct ViewInputs {
    gpu::BufferId frame;   ///< buffer with a FrameGlobals record
    gpu::BufferId globals; ///< buffer with a SmokeGlobals record
    gpu::ImageId depth;    ///< r32f: reversed depth of visible surfaces
    glm::uvec2 size_px{0};
};

/// Marches view rays through the smoke. Writes rgba32f: opacity; mean light of the visible smoke, as a share
/// of all light; distance at which the edge opacity is reached, 0 if it is not reached; and a value for the
/// place where it is reached: the orientation towards the light, 0 to 1, plus 2 times the index of the
/// densest box. A ray passes all boxes together. The ray's step is the shortest of the steps of the boxes
/// around the sample. Cost: a full-screen dispatch, a texel read per step in boxes and per empty brick.
[[nodiscard]] gpu::ImageId add_march(gpu::Graph& graph, const Volume& volume, const SmokeStyle& style,
                                     const ViewInputs& in);

/// Inputs of the smoke's shadow on the scene. The result is the share of sunlight that smoke lets through to
/// visible surfaces, r16f, multiplied by `share` if given. Cost: a full-screen dispatch, a texel read per
/// cell between the surface and the sun within boxes.
struct ThrownInputs {
    ViewInputs view;
    std::optional<gpu::ImageId> share; ///< share of sunlight that terrain and clouds let through; page-sized
    glm::vec3 towards_sun{0.0F, 1.0F, 0.0F};
};

[[nodiscard]] gpu::ImageId add_thrown(gpu::Graph& graph, const Volume& volume, const SmokeStyle& style,
                                      const ThrownInputs& in);

/// Fading of drawn smoke with distance, as in techniques/haze.
struct Haze {
    gpu::ImageId sky; ///< rgba16f: colour of the sky, page-sized or one texel
    float start_m = 0.0F;
    float reach_m = 1.0F;
    float ink = 1.0F;
};

/// The images of drawn smoke.
struct Layer {
    gpu::ImageId paint; ///< rgba8: square roots of the paint's transmittance, coverage in alpha
    gpu::ImageId ink;   ///< r16f: darkness of lines and strokes over the paint
};

struct InkInputs {
    ViewInputs view;
    gpu::ImageId marched;       ///< result of add_march()
    gpu::ImageId lines;         ///< rgba8: contour lines of the scene, coverage in alpha
    float scene_line_px = 1.0F; ///< half the width of the scene's widest line
    float pixels_per_mm = 1.0F;
    std::optional<Haze> haze = {};
};

/// Draws the smoke from the result of add_march(). Cost: a full-screen dispatch. Pixels with smoke read a
/// dozen texels per pixel of the line width.
[[nodiscard]] Layer add_ink(gpu::Graph& graph, const SmokeStyle& style, const InkInputs& in);

/// The distance in pixels within which other pixels may affect a pixel's smoke ink.
[[nodiscard]] uint32_t reach_px(const SmokeStyle& style, float pixels_per_mm);

} // namespace estampe::smoke
