// SPDX-License-Identifier: MIT
#pragma once

// Clouds and their section of the style. There are three layers of clouds. The lowest layer is cumulus, made
// of round puffs on a flat base. Above it lie small flat clouds (altocumulus). The highest layer is streaks
// (cirrus). The layers are fixed in the world and drift with the wind.

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "gpu/graph/graph.hpp"
#include "style/parameter.hpp"
#include "style/wind.hpp"
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
    wind::Wind wind; ///< wind of the scene, from the style's [wind]; not a key of the section [clouds]
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

/// The camera and the light from which the clouds of a picture are computed.
struct CloudView {
    glm::dvec3 eye_m{0.0}; ///< position of the eye in world space
    double time_s = 0.0;
    glm::vec3 towards_sun{0.0F, 1.0F, 0.0F};
    /// Elevation of the sun from which the clouds' colours are computed. None: the colours do not depend on
    /// the sun.
    std::optional<double> follows_elevation_rad;
    SkyColors colors; ///< colours of the sky behind the clouds
    float pixels_per_mm = 1.0F;
};

/// The shapes of all clouds. The shapes do not depend on the camera.
struct CloudShapes {
    /// One layer of puffs (balls of cloud): indices at which the layer's data starts in the lists of
    /// CloudShapes.
    struct Layer {
        uint32_t first_cell = 0;
        uint32_t first_home = 0; ///< index of the first cell in the lists that contain each puff only once
        float top = 0.0F;        ///< height of the layer in cells; 0 if it has no puffs
        float reach = 0.0F;      ///< largest radius of a puff including its outline, in cells
    };

    /// Adds a layer of puffs. The centres of the puffs lie on a tile of `cells` cells per side.
    Layer add(std::span<const shared::CloudPuff> layer_puffs, uint32_t cells);

    std::array<Layer, 2> layers; ///< cumulus clouds, then altocumulus clouds
    /// Several lists of cells. Each list stores the index of the first puff (ball of cloud) of each cell. The
    /// list's last entry is the end of the last cell's puffs.
    std::vector<uint32_t> starts;
    std::vector<shared::CloudPuff> puffs;
    std::vector<float> streaks; ///< density of streaks at each corner of the cells, row by row
};

/// Cache of cloud shapes between pictures. Clouds change slowly, so many pictures share their shapes.
class CloudMemory {
public:
    /// Returns the cloud shapes of `style` at the phase `turn` (0 to 1) of their slow change. Returns the
    /// cached shapes if `style` and `turn` are unchanged; otherwise computes shapes in some milliseconds per
    /// layer.
    [[nodiscard]] std::shared_ptr<const CloudShapes> shapes(const CloudStyle& style, float turn);

private:
    CloudStyle style_;
    float turn_ = 0.0F;
    std::shared_ptr<const CloudShapes> shapes_;
};

/// The shapes and constants of the clouds of one picture.
struct CloudPlan {
    shared::CloudGlobals globals{};
    uint32_t variant = 0;
    std::shared_ptr<const CloudShapes> shapes;
};

/// Computes the clouds of a picture. Returns none if the style has no clouds or the eye is above all clouds.
/// The clouds' shapes change in small steps: 32,768 steps in the time `clouds.change_s`. `memory` only saves
/// time and does not change the result. Cost: memory.shapes().
[[nodiscard]] std::optional<CloudPlan> plan_clouds(const CloudStyle& style, const CloudView& view,
                                                   CloudMemory& memory);

/// The clouds of a picture, uploaded to the device.
struct CloudHandles {
    gpu::BufferId globals; ///< buffer with the CloudGlobals: all constants of the clouds
    gpu::BufferId starts;
    gpu::BufferId puffs;
    gpu::BufferId streaks;
};

struct CloudInputs {
    gpu::BufferId frame; ///< buffer with the FrameGlobals of the current frame
    CloudHandles clouds;
    gpu::ImageId depth; ///< r32f: reversed depth (1 at the near plane), 0 for the background
    uint32_t variant = 0;
    bool keeps_cover = false; ///< also outputs the clouds' coverage of each pixel
    glm::uvec2 size_px{0};
    /// If set, paints clouds only in the listed tiles of the page; the list comes from
    /// surface::add_far_tiles(). Requires keeps_cover = false.
    std::optional<gpu::BufferId> tiles;
    /// If set, paints no clouds at pixels that show a surface nearer to the eye than `far_m`.
    std::optional<float> far_m;
    /// If set, the 8 x 8 pixels of a workgroup find their puffs together, which is faster on GPUs. A tile of
    /// the page must then begin at a multiple of 8 pixels. With other tile positions, outlines that cross
    /// each other may differ from the outlines in a page that is drawn as a whole.
    bool by_groups = false;
};

/// A sky with clouds, and an r16f image of each pixel's coverage by clouds. Without `keeps_cover`, that image
/// is a single texel.
struct CloudedSky {
    Sky sky;
    gpu::ImageId cover;
};

/// Paints clouds over a sky: clouds replace the sky's wash and hide its strokes. Does nothing in parallel
/// projection, where all pixels look in one direction.
///
/// Cost    one dispatch over the page or a list of tiles; where sky may be visible, a walk through cells, or
///         a loop over the puffs near a workgroup's pixels
/// Source  the walk through cells: Amanatides and Woo, "A Fast Voxel Traversal Algorithm for Ray Tracing",
///         Eurographics 1987
[[nodiscard]] CloudedSky add_clouds(gpu::Graph& graph, const CloudInputs& in, const Sky& sky);

struct CloudShadowInputs {
    gpu::BufferId frame; ///< buffer with the FrameGlobals of the current frame
    CloudHandles clouds;
    gpu::ImageId depth; ///< r32f: reversed depth (1 at the near plane), 0 for the background
    /// Image of the page's size: share of sunlight that other objects let through.
    std::optional<gpu::ImageId> share;
    glm::uvec2 size_px{0};
};

/// Returns the share of sunlight at visible surfaces, r16f. Cumulus and altocumulus clouds cast shadows of
/// darkness `strength`. Cost: a full-screen dispatch, with a walk through each layer for every pixel that
/// shows a surface.
[[nodiscard]] gpu::ImageId add_cloud_shadow(gpu::Graph& graph, const CloudShadowInputs& in, float strength);

} // namespace estampe::sky
