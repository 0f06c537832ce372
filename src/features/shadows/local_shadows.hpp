// SPDX-License-Identifier: MIT
#pragma once

// The shadow maps of local lights, from frame to frame: who gets one, how large, and which are drawn anew.

#include <span>
#include <vector>

#include "features/common/view.hpp"
#include "gpu/resources.hpp"
#include "techniques/light/light.hpp"
#include "techniques/raster/raster.glsl.h"
#include "techniques/shadow/atlas.hpp"
#include "techniques/shadow/local/local_view.hpp"
#include "techniques/shadow/shadow_style.hpp"

namespace estampe::features {

/// What the maps of a local light depend on. The range is rounded up, so that the exposure of a scene that
/// moves does not change it all the time.
[[nodiscard]] shadow::LocalLight local_light(const shared::LightRecord& record);

/// Radius in metres of the ball that glows: the light's own, or what the style says of all.
[[nodiscard]] float radius_of(const shared::LightRecord& record, const shadow::ShadowStyle& style);

/// Where the page is taken from, for judging how many texels a light is worth.
struct PageView {
    glm::vec3 eye_anchor{0.0F};
    PixelSize pixel;
    float scene_radius_m = 1.0F;
    uint32_t longer_side_px = 1;
};

/// What a light asks of the atlas: as many texels as its shadow fills pixels, at most the style's size or
/// half the page for an omni and the whole page for a spot; more important the more of the page it lights.
[[nodiscard]] shadow::AtlasRequest atlas_request(const shared::LightRecord& record,
                                                 const shadow::LocalLight& light, const PageView& page,
                                                 const shadow::ShadowStyle& style);

/// The views that draw the maps of a light, not placed yet.
void add_views(std::vector<shared::RasterView>& list, const shadow::LocalLight& light,
               const shared::LocalShadow& shadow);

/// Whether there are casters that may move, and such that never do.
struct CasterKinds {
    bool moving = false;
    bool still = false;
};

/// Maps that are out of date, each list placed by raster::place_views().
struct LocalMapViews {
    std::vector<shared::RasterView> whole;  ///< to be drawn from all casters
    std::vector<shared::RasterView> still;  ///< whose layer of what stands still is to be drawn
    std::vector<shared::RasterView> moving; ///< to be drawn from what moves, and merged with that layer

    [[nodiscard]] bool empty() const { return whole.empty() && still.empty() && moving.empty(); }

    /// Keeps the room that they took.
    void clear()
    {
        whole.clear();
        still.clear();
        moving.clear();
    }
};

/// Shadow maps of local lights, as a picture is to have them.
struct LocalMapPlan {
    bool is_there = false; ///< some light has any
    uint32_t variant = 0;  ///< see shadow/local/edge_look.hpp
    LocalMapViews views;   ///< to draw anew
};

/// The maps of one frame.
struct LocalShadowPlan {
    std::vector<shared::LocalShadow> shadows; ///< what LightRecord::shadow numbers, from 1
    LocalMapViews views;
    uint64_t texel_count = 0; ///< that the buffer of all maps must hold
    size_t without = 0;       ///< lights that asked for a shadow and got none
};

/// Plans the maps of a scene's local lights and remembers which of them are up to date.
class LocalShadows {
public:
    /// Fills in the records' `shadow`. `moved` are the places, before and after, of what moved since the last
    /// call. A light within whose reach casters move while it stands keeps a layer of those that do not, in a
    /// second buffer as large as the maps', which are held to `shadow.local_megatexels`. Valid until the next
    /// call. Cost: linear in lights and in what moved.
    [[nodiscard]] const LocalShadowPlan& plan(light::Lighting& lighting, std::span<const Bounds> moved,
                                              const PageView& page, const shadow::ShadowStyle& style,
                                              const CasterKinds& casters = {});

    /// All maps and layers are out of date: another scene, or another buffer.
    void forget() { kept_.clear(); }

private:
    struct Kept {
        shadow::LocalLight light;
        shadow::Allotment allotment;
        bool has_layer = false; ///< of what stands still
    };

    shadow::Atlas atlas_;
    std::vector<Kept> kept_; ///< by local light: what its maps show
    LocalShadowPlan plan_;   ///< its room serves the next frame, as does that of these:
    std::vector<shadow::LocalLight> lights_;
    std::vector<shadow::AtlasRequest> requests_;
};

} // namespace estampe::features
