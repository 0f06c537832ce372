// SPDX-License-Identifier: MIT
#pragma once

#include "style/parameter.hpp"

namespace estampe::occlusion {

/// How it is found: from the depths on the page, between all vertices, by pixels or by texels from all
/// vertices, or as a mask of depth.
enum class Method : uint8_t { horizon, discs, splats, uv, unsharp };

/// Whether there is a disc at each vertex.
[[nodiscard]] constexpr bool has_discs(Method method)
{
    return method == Method::discs || method == Method::splats || method == Method::uv;
}

/// What occlusion is let into: light from everywhere, all light, or nothing but its own mask.
enum class Feeds : uint8_t { ambient, tone, layer };

struct OcclusionStyle {
    bool drawn = false;
    Method method = Method::horizon;
    Feeds feeds = Feeds::ambient;
    float radius_m = 0.0F;
    float reach_mm = 25.0F;
    float thickness = 0.5F;
    float strength = 1.0F;
    float bleeding = 0.0F;
    uint32_t texels = 512;
};

[[nodiscard]] const style::Table<OcclusionStyle>& occlusion_table();

} // namespace estampe::occlusion
