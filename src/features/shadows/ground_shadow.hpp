// SPDX-License-Identifier: MIT
#pragma once

// The sun's shadow of the terrain: what it is to be, and what of it is kept from picture to picture.

#include <optional>

#include <estampe/scene.hpp>

#include "gpu/device.hpp"
#include "gpu/execution_profile.hpp"
#include "gpu/resources.hpp"
#include "techniques/shadow/ground/ground_shadow.hpp"
#include "techniques/shadow/shadow_style.hpp"
#include "techniques/terrain/terrain_buffers.hpp"

namespace estampe::features {

struct GroundShadowPlan {
    bool is_thrown = false;
    glm::dvec3 towards_sun{0.0, 1.0, 0.0};
    float sun_radius_rad = 0.0F;
    uint32_t size = 0; ///< texels a side of each field
    shadow::GroundLevels levels{};
    shadow::HeightMethod method = shadow::HeightMethod::sweep;
    double relief_m = 0.0; ///< between the lowest ground and the highest of what stands on it
};

struct GroundShadowScene {
    const Camera& camera;
    glm::dvec3 anchor{0.0};
    glm::dvec3 towards_sun{0.0, 1.0, 0.0};
    bool is_thrown = false;
    uint32_t page_height_px = 0;
    gpu::ExecutionProfile execution; ///< of the device that draws it
    double relief_m = 0.0;           ///< of the scene
};

/// Plans the fields about the camera. Their horizons are found by sweeps on a processor, which does least
/// then; a device of many threads keeps too few of them busy by that, and climbs pyramids. A small page's
/// fields reach half as far each: its pixels are as large there as a large page's are twice as far away.
[[nodiscard]] GroundShadowPlan plan_ground_shadow(const GroundShadowScene& scene,
                                                  const shadow::ShadowStyle& style);

struct GroundShadowInputs {
    const GroundShadowPlan& plan;
    gpu::BufferId texels; ///< of the terrain
    gpu::BufferId frame;  ///< FrameGlobals
    gpu::ImageId depth;
    glm::uvec2 size_px{0};
    std::optional<glm::mat4> clip_from_anchor = std::nullopt; ///< where all of a picture is drawn at once
};

/// Fields of heights and horizons between pictures. A field is made anew when it has gone along with the eye,
/// or when the sun or the ground have changed. By pyramid, fields that stand on ground which goes on
/// changing, or under such a sun, are made where the picture looks them up and no farther.
class GroundShadow {
public:
    void forget() { held_.reset(); }

    /// Makes room for what `plan` wants.
    void ensure(gpu::Device& device, const GroundShadowPlan& plan);
    /// Brings the fields up to date, and looks every pixel up in them.
    [[nodiscard]] gpu::ImageId add_share(gpu::Graph& graph, terrain::TerrainBuffers& terrain,
                                         const GroundShadowInputs& in);
    /// That has been drawn.
    void drawn(const GroundShadowPlan& plan, const terrain::TerrainBuffers& terrain);

private:
    struct Held {
        GroundShadowPlan plan;
        uint64_t form = 0; ///< of the terrain
    };

    /// Whether a field is where it was.
    [[nodiscard]] bool stands(const GroundShadowPlan& plan, uint32_t level) const;

    [[nodiscard]] bool is_held(const GroundShadowPlan& plan, uint32_t level, uint64_t form) const;

    gpu::Buffer kept_;
    std::optional<Held> held_;
    bool is_in_part_ = false; ///< what is held is up to date only where the last picture looked it up
};

} // namespace estampe::features
