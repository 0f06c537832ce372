// SPDX-License-Identifier: MIT
#pragma once

// Shadow maps of local lights: how many texels each light gets in the shared buffer, and where; and the views
// of the maps: one along a spot's beam, six along the axes for an omnidirectional light.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "techniques/shadow/shadow.glsl.h"

namespace estampe::shadow {

inline constexpr uint32_t smallest_map = 64;

/// What a light requests. With `map_count` 0 it requests nothing.
struct AtlasRequest {
    uint32_t map_count = 0;
    float wanted_size = 0.0F; ///< texels per side at which a texel is about as large as a pixel
    uint32_t largest_size = 512;
    float importance = 0.0F; ///< priority if texels are short; only ratios between lights matter
};

/// The texels that a light gets: its maps of `size` texels per side, a power of two, one after another. Size
/// 0 means no map.
struct Allotment {
    uint32_t size = 0;
    uint32_t first_texel = 0;
    bool operator==(const Allotment&) const = default;
};

struct AtlasBudget {
    uint64_t texels = 0;
    size_t lights = SIZE_MAX; ///< at most this many lights get maps
};

/// Shares texels out among lights in each frame. Sizes change only if the wanted size has changed clearly,
/// and a light keeps its place, so that its maps can be kept.
class Atlas {
public:
    /// Shares the budget out among the lights of a frame. A light must keep its index from frame to frame.
    /// The most important lights get the power of two next to their wanted size. If that is too much, the
    /// largest maps are halved, the least important first; at `smallest_map` the least important lights get
    /// none. Cost: a sort, and linear in lights for each halving. The result is valid until the next call.
    [[nodiscard]] const std::vector<Allotment>& allot(std::span<const AtlasRequest> requests,
                                                      const AtlasBudget& budget);

    /// Number of texels that the buffer must hold.
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
    // Buffers that are reused from frame to frame.
    std::vector<uint32_t> sizes_; ///< by light
    std::vector<size_t> order_;   ///< lights in order of importance
    std::vector<Held> held_before_;
    std::vector<size_t> taken_; ///< lights that have a place, in order of places
    std::vector<size_t> waiting_;
    std::vector<Allotment> allotted_;
};

/// Everything about a local light that its shadow maps depend on, in anchor space.
struct LocalLight {
    glm::vec3 position{0.0F};
    float range_m = 1.0F;           ///< objects farther away are neither lit nor drawn into the maps
    glm::vec3 beam{0.0F, 0.0F, -1}; ///< unit vector; only for spots
    glm::vec3 side{1.0F, 0.0F, 0};  ///< unit vector perpendicular to the beam, along two sides of a pyramid
    float half_angle_rad = 0.0F;    ///< half angle of a spot's cone or pyramid; 0 is an omnidirectional light
    uint32_t casters = ~0U;         ///< object groups that cast shadows in this light

    /// Whether the light needs six maps: it is omnidirectional, or a spot too wide for one map.
    [[nodiscard]] bool is_cube() const;

    [[nodiscard]] uint32_t map_count() const { return is_cube() ? 6 : 1; }

    bool operator==(const LocalLight&) const = default;
};

/// Margin of texels around each map, so that lookups near its border find neighbours.
inline constexpr uint32_t rim_texels = 2;

/// Record for shader lookups: the maps have `size` texels per side and start at `first_texel`. `radius_m` is
/// the radius of the luminous sphere.
[[nodiscard]] shared::LocalShadow local_shadow(const LocalLight& light, uint32_t size, uint32_t first_texel,
                                               float radius_m = 0.0F);

/// The view of one map. In clip space y points down and z is reversed: 1 at the near plane, 0 at infinity.
struct LocalView {
    glm::mat4 clip_from_anchor{1.0F};
    uint32_t first_texel = 0;
};

/// The views of the maps of `light`, in the order in which `shadow` stores them.
[[nodiscard]] std::vector<LocalView> local_views(const LocalLight& light, const shared::LocalShadow& shadow);

} // namespace estampe::shadow
