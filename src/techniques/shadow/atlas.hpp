// SPDX-License-Identifier: MIT
#pragma once

// The maps of local lights. Which light gets how many texels, and where: all maps share one buffer of limited
// size. What they look at: a spot's one map along its beam, an omni's six along the axes.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "techniques/shadow/shadow.glsl.h"

namespace estampe::shadow {

inline constexpr uint32_t smallest_map = 64;

/// What a light asks for. `map_count` of 0 asks for nothing.
struct AtlasRequest {
    uint32_t map_count = 0;
    float wanted_size = 0.0F; ///< texels a side at which a texel is about a pixel
    uint32_t largest_size = 512;
    float importance = 0.0F; ///< who gets texels when there are too few; any scale
};

/// What it gets: maps of `size` texels a side, a power of two, one after another. 0: none.
struct Allotment {
    uint32_t size = 0;
    uint32_t first_texel = 0;
    bool operator==(const Allotment&) const = default;
};

/// What there is to share out.
struct AtlasBudget {
    uint64_t texels = 0;
    size_t lights = SIZE_MAX; ///< how many of them at most
};

/// Gives lights their texels, frame after frame. Sizes change only when what is wanted has clearly changed,
/// and a light that has a place keeps it, so that maps can be kept.
class Atlas {
public:
    /// Shares the budget out among the lights of a frame, who keep their order from frame to frame. The most
    /// important get the power of two next to what they want. When that is too much, the largest are halved,
    /// of these the least important first, and of those at `smallest_map` the least important go without.
    /// Cost: a sort, and linear in lights for each halving.
    /// Valid until the next call.
    [[nodiscard]] const std::vector<Allotment>& allot(std::span<const AtlasRequest> requests,
                                                      const AtlasBudget& budget);

    /// How many texels the buffer must hold.
    [[nodiscard]] uint64_t end_texel() const;

private:
    struct Held {
        Allotment allotment;
        uint32_t map_count = 0;

        [[nodiscard]] uint64_t texels() const
        {
            return uint64_t{map_count} * allotment.size * allotment.size;
        }
    };

    void choose_sizes(std::span<const AtlasRequest> requests, const AtlasBudget& budget);
    void place(std::span<const AtlasRequest> requests, uint64_t budget_texels);

    std::vector<Held> held_; ///< by light
    // Room that a frame works in, so that the next needs none.
    std::vector<uint32_t> sizes_; ///< by light
    std::vector<size_t> order_;   ///< lights by what they are worth
    std::vector<Held> held_before_;
    std::vector<size_t> taken_; ///< lights that have a place, in the order of places
    std::vector<size_t> waiting_;
    std::vector<Allotment> allotted_;
};

/// All of a local light that its maps depend on, in anchor space.
struct LocalLight {
    glm::vec3 position{0.0F};
    float range_m = 1.0F;           ///< what is farther away is neither lit nor drawn
    glm::vec3 beam{0.0F, 0.0F, -1}; ///< unit; of spots
    glm::vec3 side{1.0F, 0.0F, 0};  ///< unit, square to the beam; a pyramid's sides are along it and across
    float half_angle_rad = 0.0F;    ///< of a spot's cone or pyramid; 0: shines to all sides
    uint32_t casters = ~0U;         ///< groups of objects that throw shadows in its light

    /// Six maps: a light to all sides, or a spot too wide for one.
    [[nodiscard]] bool is_cube() const;

    [[nodiscard]] uint32_t map_count() const { return is_cube() ? 6 : 1; }

    bool operator==(const LocalLight&) const = default;
};

/// Texels about each map beyond what it has to show, so that lookups near its border find neighbours there.
inline constexpr uint32_t rim_texels = 2;

/// The record that lookups read, of maps of `size` texels a side that begin at `first_texel`. `radius_m` is
/// that of the ball that glows.
[[nodiscard]] shared::LocalShadow local_shadow(const LocalLight& light, uint32_t size, uint32_t first_texel,
                                               float radius_m = 0.0F);

/// One map to draw. In clip space y points down, z is reversed: near_m at the near plane, 0 at infinity.
struct LocalView {
    glm::mat4 clip_from_anchor{1.0F};
    uint32_t first_texel = 0;
};

/// The maps of `light` that `shadow` tells of, in their order.
[[nodiscard]] std::vector<LocalView> local_views(const LocalLight& light, const shared::LocalShadow& shadow);

} // namespace estampe::shadow
