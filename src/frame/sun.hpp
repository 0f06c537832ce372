// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "frame/frame.hpp"
#include "techniques/hatch/hatch.hpp"
#include "techniques/shadow/edge_look.hpp"

namespace estampe::frame {

/// The lines of the hatching that edges of shadows can follow; none where no lines are drawn.
[[nodiscard]] std::optional<shadow::HatchedLines>
hatched_lines(const hatch::HatchStyle& style, const glm::vec3& towards_light, bool has_directions);

/// What decides how the sun's shadow is kept.
struct SunScene {
    Bounds casters;       ///< world space
    double floor_m = 0.0; ///< nothing that is lit lies lower, world space
    glm::dvec3 anchor{0.0};
    glm::dvec3 towards_sun{0.0, 1.0, 0.0};
    bool throws_shadow = false;
    uint64_t most_bytes = 1ULL << 27U; ///< of a buffer on the device
};

/// Plans the sun's map: its view, its size, and the windows of a clipmap where the style or, by itself, a
/// scene that is far larger than what is near the eye wants one. To be called when the rest of `plan` stands.
void plan_sun(FramePlan& plan, const SunScene& scene, const Camera& camera, const StyleTables& style);

/// The plan's map as the light's shader looks it up.
[[nodiscard]] shared::SunShadow sun_globals(const FramePlan& plan, const shadow::ShadowStyle& style);

/// The map between pictures: what it holds, and what of it has to be drawn.
class SunMap {
public:
    /// What threw the shadow has changed.
    void forget() { view_.reset(); }

    /// Makes room for the map that `plan` wants, and tells the plan what to draw into it.
    void provide(gpu::Device& device, FramePlan& plan);
    /// The plan's drawing has been done.
    void drawn(const FramePlan& plan);

    [[nodiscard]] gpu::Buffer& buffer() { return map_; }

private:
    gpu::Buffer map_;
    std::optional<glm::mat4> view_; ///< of what the map holds; none when it is out of date
    std::optional<shadow::Clipmap> clipmap_;
    shadow::Windows windows_;
};

/// Draws what the plan wants of the sun's map.
[[nodiscard]] gpu::BufferId add_sun_map(gpu::Graph& graph, const raster::RasterInputs& in,
                                        const std::vector<raster::Batch>& batches, const FramePlan& plan,
                                        uint32_t vertex_count, gpu::BufferId map);

} // namespace estampe::frame
