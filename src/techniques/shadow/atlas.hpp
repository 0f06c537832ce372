// SPDX-License-Identifier: MIT
#pragma once

// Which light gets how many texels of shadow map, and where: all maps share one buffer of limited size.

#include <cstdint>
#include <span>
#include <vector>

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

} // namespace estampe::shadow
