// SPDX-License-Identifier: MIT
#pragma once

// The shadow map of the sun: what it is to be, what it holds, and how it is drawn.

#include <optional>
#include <vector>

#include <estampe/renderer.hpp>

#include "frame/strokes.hpp"
#include "frame/style_tables.hpp"
#include "frame/sun_casters.hpp"
#include "frame/view.hpp"
#include "gpu/graph/graph.hpp"
#include "gpu/resources.hpp"
#include "techniques/hatch/hatch.hpp"
#include "techniques/raster/raster.hpp"
#include "techniques/shadow/clipmap.hpp"
#include "techniques/shadow/edge_look.hpp"
#include "techniques/shadow/sun_view.hpp"

namespace estampe::frame {

/// The lines of the hatching that edges of shadows can follow; none where no lines are drawn.
[[nodiscard]] std::optional<shadow::HatchedLines>
hatched_lines(const hatch::HatchStyle& style, const glm::vec3& towards_light, const StrokePlan& strokes);

/// What decides how the sun's shadow is kept.
struct SunScene {
    Bounds casters;       ///< world space
    double floor_m = 0.0; ///< nothing that is lit lies lower, world space
    glm::dvec3 anchor{0.0};
    glm::dvec3 towards_sun{0.0, 1.0, 0.0};
    bool throws_shadow = false;
    uint64_t most_bytes = 1ULL << 27U; ///< of a buffer on the device
};

/// What the map is to be.
struct SunMapPlan {
    uint32_t size = 0; ///< texels a side; 0 for no shadow
    shadow::SunView view;
    std::optional<shadow::Clipmap> clipmap; ///< in place of a single map of the view
    shadow::Windows windows;                ///< of the clipmap
    uint32_t variant = 0;                   ///< how it is looked up, see shaders/light_variant.glsl.h
};

/// What of the map is to be drawn now.
struct SunMapWork {
    bool redraws_whole = false;
    std::vector<shadow::Piece> pieces; ///< of a clipmap, not drawn yet
};

/// Plans the map: its view, its size, and the windows of a clipmap where the style or, by itself, a scene
/// that is far larger than what is near the eye wants one.
[[nodiscard]] SunMapPlan plan_sun_map(const SunScene& scene, const Camera& camera, glm::uvec2 size_px,
                                      const PixelSize& pixel, const StyleTables& style);

/// The map as the light's shader looks it up.
[[nodiscard]] shared::SunShadow sun_globals(const SunMapPlan& plan, const PixelSize& pixel,
                                            const shadow::ShadowStyle& style);

/// The map between pictures: what it holds, and what of it has to be drawn.
class SunMap {
public:
    /// What threw the shadow has changed.
    void forget() { view_.reset(); }

    /// Makes room for the map that `plan` wants, and says what to draw into it.
    [[nodiscard]] SunMapWork provide(gpu::Device& device, const SunMapPlan& plan);
    /// That has been drawn.
    void drawn(const SunMapPlan& plan);

    [[nodiscard]] gpu::Buffer& buffer() { return map_; }

private:
    gpu::Buffer map_;
    std::optional<glm::mat4> view_; ///< of what the map holds; none when it is out of date
    std::optional<shadow::Clipmap> clipmap_;
    shadow::Windows windows_;
};

struct SunMapInputs {
    const raster::RasterInputs& raster;
    std::span<const raster::Batch> casters; ///< for a clipmap those that move alone
    std::span<const StillCaster> still;     ///< and the others
    Groups groups = all_groups;             ///< of those that the sun shadows
    glm::dvec3 anchor{0.0};
    const SunMapPlan& plan;
    const SunMapWork& work;
    RasterPath path = RasterPath::compute; ///< never automatic
    raster::Tuning tuning;
    uint32_t vertex_count = 0; ///< of the posed vertices
};

/// Draws what is to be drawn of the map, and hands it back.
///
/// Cost    nothing where nothing is to be drawn; else that of raster::add_depth(), of a clipmap for each
/// piece, of what stands still only what is seen there
[[nodiscard]] gpu::BufferId add_sun_map(gpu::Graph& graph, const SunMapInputs& in, gpu::BufferId map);

} // namespace estampe::frame
