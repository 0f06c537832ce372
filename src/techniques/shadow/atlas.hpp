// SPDX-License-Identifier: MIT
#pragma once

// Shadow maps of local lights (lamps and spots) in one shared buffer: number and place of each light's
// texels, and the views of the maps. A spot has one view along its beam, an omnidirectional light has six
// views along the axes.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "techniques/shadow/shadow.glsl.h"

namespace estampe::shadow {

inline constexpr uint32_t smallest_map = 64;

/// The shadow map that a light requests. `map_count` 0 means that the light needs no map.
struct AtlasRequest {
    uint32_t map_count = 0;
    float wanted_size = 0.0F; ///< texels per side at which a texel of the map is about as large as a pixel
    uint32_t largest_size = 512;
    /// Priority of the light when texels are scarce; only ratios between lights matter.
    float importance = 0.0F;
};

/// The texels that a light gets in the shared buffer. The light's maps have `size` texels per side, a power
/// of two, and are stored one after another. Size 0 means no map.
struct Allotment {
    uint32_t size = 0;
    uint32_t first_texel = 0;
    bool operator==(const Allotment&) const = default;
};

struct AtlasBudget {
    uint64_t texels = 0;
    size_t lights = SIZE_MAX; ///< most lights that get shadow maps
};

/// Divides shadow map texels among lights in each frame. A light's size changes only if the wanted size has
/// changed clearly. A light also keeps its place in the buffer, so that its maps can be reused.
class Atlas {
public:
    /// Divides the texel budget among the lights of a frame. A light must keep its index from frame to frame.
    /// The most important lights get the power of two nearest to their wanted size. If the maps do not fit,
    /// the largest maps are halved, the least important first. At `smallest_map` the least important lights
    /// get no map. Cost: a sort, and linear in lights for each halving. The result is valid until the next
    /// call.
    [[nodiscard]] const std::vector<Allotment>& allot(std::span<const AtlasRequest> requests,
                                                      const AtlasBudget& budget);

    /// Number of texels that the buffer of all shadow maps must hold.
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

    std::vector<Held> held_; ///< place and size that each light got in the last frame
    // Work memory that is reused from frame to frame.
    std::vector<uint32_t> sizes_; ///< size of each light's maps
    std::vector<size_t> order_;   ///< indices of lights in order of importance
    std::vector<Held> held_before_;
    std::vector<size_t> taken_; ///< indices of lights with a place in the buffer, in order of places
    std::vector<size_t> waiting_;
    std::vector<Allotment> allotted_;
};

/// All properties of a local light that its shadow maps depend on, in anchor space (relative to a nearby
/// origin).
struct LocalLight {
    glm::vec3 position{0.0F};
    /// Radius of the light; objects farther away are neither lit nor drawn into the maps.
    float range_m = 1.0F;
    glm::vec3 beam{0.0F, 0.0F, -1}; ///< direction of a spot's beam, a unit vector
    /// Unit vector perpendicular to a spot's beam, along two sides of the map's pyramid.
    glm::vec3 side{1.0F, 0.0F, 0};
    float half_angle_rad = 0.0F; ///< half angle of a spot's cone or pyramid; 0 for an omnidirectional light
    uint32_t casters = ~0U;      ///< bits of the object groups that cast shadows in the light

    /// Whether the light needs six maps: the light is omnidirectional, or a spot too wide for one map.
    [[nodiscard]] bool is_cube() const;

    [[nodiscard]] uint32_t map_count() const { return is_cube() ? 6 : 1; }

    bool operator==(const LocalLight&) const = default;
};

/// Width in texels of the margin around each map, so that lookups near its border find neighbour texels.
inline constexpr uint32_t rim_texels = 2;

/// Makes the record for shader lookups. The maps have `size` texels per side and start at `first_texel`.
/// `radius_m` is the radius of the luminous sphere.
[[nodiscard]] shared::LocalShadow local_shadow(const LocalLight& light, uint32_t size, uint32_t first_texel,
                                               float radius_m = 0.0F);

/// The view of one local shadow map. In clip space y points down and z is reversed: 1 at the near plane, 0 at
/// infinity.
struct LocalView {
    glm::mat4 clip_from_anchor{1.0F};
    uint32_t first_texel = 0;
};

/// The views of all shadow maps of `light`, in the order in which `shadow` stores them.
[[nodiscard]] std::vector<LocalView> local_views(const LocalLight& light, const shared::LocalShadow& shadow);

} // namespace estampe::shadow
