// SPDX-License-Identifier: MIT
#pragma once

// Clouds: heaps of round puffs on a flat base, flocks of small flat ones above them, and streaks above all,
// in layers that stand in the world and drift with the wind; and what a style says of them.

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "gpu/graph/graph.hpp"
#include "style/parameter.hpp"
#include "techniques/sky/sky.glsl.h"
#include "techniques/sky/sky.hpp"

namespace estampe::sky {

struct CloudStyle {
    float coverage = 0.0F;
    float base_m = 1400.0F;
    float size_m = 2400.0F;
    float heaped = 1.0F;
    float flocks = 0.0F;
    float flocks_base_m = 3600.0F;
    float flocks_size_m = 2600.0F;
    float streaks = 0.0F;
    float streaks_base_m = 8000.0F;
    float streaks_size_m = 9000.0F;
    float streaks_mm = 0.9F;
    float wind_m_per_s = 9.0F;
    float wind_deg = 90.0F;
    float change_s = 3600.0F;
    glm::vec3 color = style::srgb(0xffffff);
    glm::vec3 shade_color = style::srgb(0xc4cfd0);
    int tones = 2;
    float shade = 0.35F;
    float outline_mm = 0.5F;
    float broken = 0.5F;
    float hatch = 0.0F;
    float hatch_mm = 0.25F;
    float shadow = 0.0F;
    float reach_m = 32000.0F;
    int seed = 1;

    bool operator==(const CloudStyle& other) const = default;
};

[[nodiscard]] const style::Table<CloudStyle>& cloud_table();

/// From where clouds are seen, and under which light.
struct CloudView {
    glm::dvec3 eye_m{0.0}; ///< in the world
    double time_s = 0.0;
    glm::vec3 towards_sun{0.0F, 1.0F, 0.0F};
    std::optional<double> follows_elevation_rad; ///< height of the sun that colours go by, if they do
    SkyLook look;                                ///< of the sky behind
    float pixels_per_mm = 1.0F;
};

/// What clouds there are, whoever looks.
struct CloudShapes {
    /// Of one kind that is made of puffs.
    struct Layer {
        uint32_t first_cell = 0;
        uint32_t first_home = 0; ///< of the lists in which each puff stands once
        float top = 0.0F;        ///< in its own cells; 0 where there is none
        float reach = 0.0F;      ///< of its largest puff
    };

    /// A layer of puffs whose middles are on a tile of so many cells a side.
    Layer add(std::span<const shared::CloudPuff> layer_puffs, uint32_t cells);

    std::array<Layer, 2> layers;  ///< heaps, flocks
    std::vector<uint32_t> starts; ///< of each cell of each list, where its puffs begin; and the end
    std::vector<shared::CloudPuff> puffs;
    std::vector<float> streaks; ///< how dense they are at each corner, row by row
};

/// Shapes kept from picture to picture, as clouds change slowly.
class CloudMemory {
public:
    /// The shapes of that style when they are `turn` (0 to 1) through their changes. Cost: nothing where both
    /// are as they were; else some milliseconds a layer.
    [[nodiscard]] std::shared_ptr<const CloudShapes> shapes(const CloudStyle& style, float turn);

private:
    CloudStyle style_;
    float turn_ = 0.0F;
    std::shared_ptr<const CloudShapes> shapes_;
};

/// The clouds of a picture.
struct CloudPlan {
    shared::CloudGlobals globals{};
    uint32_t variant = 0;
    std::shared_ptr<const CloudShapes> shapes;
};

/// Nothing where the style has no clouds, or the eye is above all of them. Clouds change in small steps,
/// 32,768 in `clouds.change_s`. The same for the same arguments, whatever `memory` holds. Cost: that of
/// memory.shapes().
[[nodiscard]] std::optional<CloudPlan> plan_clouds(const CloudStyle& style, const CloudView& view,
                                                   CloudMemory& memory);

/// The clouds of a plan on the device.
struct CloudHandles {
    gpu::BufferId globals; ///< CloudGlobals
    gpu::BufferId starts;
    gpu::BufferId puffs;
    gpu::BufferId streaks;
};

struct CloudInputs {
    gpu::BufferId frame; ///< FrameGlobals
    CloudHandles clouds;
    gpu::ImageId depth; ///< r32f: reversed, 0 where nothing is
    uint32_t variant = 0;
    bool keeps_cover = false; ///< for a mask of them
    glm::uvec2 size_px{0};
    /// Then these alone are painted, as of surface::add_far_tiles(), without a mask.
    std::optional<gpu::BufferId> tiles;
    /// Then pixels that see something nearer to the eye are left alone.
    std::optional<float> far_m;
    /// The pixels of 8 x 8 find their puffs together, as suits a GPU: where a tile of the page is drawn, it
    /// has to begin at a multiple of 8, or its outlines may cross otherwise than those of the page.
    bool by_groups = false;
};

/// A sky, and what of it clouds cover: r16f, one texel where that is not kept.
struct CloudedSky {
    Sky sky;
    gpu::ImageId cover;
};

/// Paints clouds into a sky: its wash is theirs where they are, its strokes end at them. Not in parallel
/// projection, which sees one direction alone.
///
/// Cost    one dispatch, over the page or a list of tiles; walks where sky may show, or looks through the
///         puffs that the pixels of a group come near
/// Source  the walk through cells: Amanatides and Woo, "A Fast Voxel Traversal Algorithm for Ray Tracing",
///         Eurographics 1987
[[nodiscard]] CloudedSky add_clouds(gpu::Graph& graph, const CloudInputs& in, const Sky& sky);

struct CloudShadowInputs {
    gpu::BufferId frame; ///< FrameGlobals
    CloudHandles clouds;
    gpu::ImageId depth;                ///< r32f: reversed, 0 where nothing is
    std::optional<gpu::ImageId> share; ///< of the sun, as large as the page, that something else leaves
    glm::uvec2 size_px{0};
};

/// How much of the sun is left where something is seen, r16f; heaps and flocks throw shadows, `strength`
/// dark. Cost: a full-screen dispatch, a walk through each layer's slab for every pixel that sees something.
[[nodiscard]] gpu::ImageId add_cloud_shadow(gpu::Graph& graph, const CloudShadowInputs& in, float strength);

} // namespace estampe::sky
