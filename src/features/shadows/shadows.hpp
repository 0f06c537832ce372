// SPDX-License-Identifier: MIT
#pragma once

// The shadows of a scene from picture to picture: the sun's map, that of dunes, and the maps of lamps and
// spots.

#include <span>
#include <string>
#include <vector>

#include "features/common/feature.hpp"
#include "features/shadows/ground_shadow.hpp"
#include "features/shadows/local_maps.hpp"
#include "features/shadows/local_shadows.hpp"
#include "features/shadows/sun.hpp"
#include "techniques/shadow/local/edge.glsl.h"

namespace estampe::features {

/// What the maps of local lights are planned from.
struct LocalMapScene {
    PageView page;
    shadow::ShadowStyle style; ///< with as many local lights as may throw shadows
    CasterKinds casters;
};

class Shadows final : public Feature {
public:
    /// Maps hold what they were drawn from: another scene, light or origin makes them out of date.
    void invalidate(Event event) override;

    /// Something moved from and to these places (anchor space).
    void move(std::span<const Bounds> places);

    /// Plans the maps of local lights, fills in the records' `shadow`, makes room, and says in `notes` how
    /// many lights go without.
    [[nodiscard]] LocalMapPlan ensure_local_maps(gpu::Device& device, light::Lighting& lighting,
                                                 const LocalMapScene& scene, std::vector<std::string>& notes);

    /// Uploads what lookups read.
    void upload(gpu::Device& device, const shared::EdgeLook& edges, const shared::SunShadow& sun);

    [[nodiscard]] SunMap& sun() { return sun_; }

    [[nodiscard]] GroundShadow& ground() { return ground_; }

    [[nodiscard]] LocalShadowBuffers& local() { return local_buffers_; }

    /// EdgeLook, see shadow/local/edge.glsl.h.
    [[nodiscard]] gpu::Buffer& edge_look() { return edge_look_; }

    /// SunShadow, see shadow/sun/sun.glsl.h.
    [[nodiscard]] gpu::Buffer& sun_globals() { return sun_globals_; }

private:
    SunMap sun_;
    GroundShadow ground_;
    LocalShadows local_;
    LocalShadowBuffers local_buffers_;
    std::vector<Bounds> moved_; ///< since local maps were planned last
    gpu::Buffer edge_look_;
    gpu::Buffer sun_globals_;
};

} // namespace estampe::features
