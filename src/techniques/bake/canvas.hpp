// SPDX-License-Identifier: MIT
#pragma once

// A picture that is known only at some texels, and is extended from these texels to their neighbours.

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

namespace estampe::bake {

/// A square image in which some texels have no value yet.
class Canvas {
public:
    /// `repeats`: the texels at opposite edges of the image are neighbours.
    explicit Canvas(uint32_t side, bool repeats = false)
        : size(side), light(static_cast<size_t>(side) * side), known(light.size(), false), repeats_(repeats)
    {
    }

    /// Calls `visit` for each of a texel's eight neighbours; without `repeats`, only for those inside the
    /// image.
    template <class Visit>
    void around(uint32_t place, const Visit& visit) const
    {
        const auto side = static_cast<int64_t>(size);
        const auto x = static_cast<int64_t>(place % size);
        const auto y = static_cast<int64_t>(place / size);
        for (int64_t v = y - 1; v <= y + 1; ++v) {
            for (int64_t u = x - 1; u <= x + 1; ++u) {
                const bool inside = u >= 0 && v >= 0 && u < side && v < side;
                if ((inside || repeats_) && (u != x || v != y)) {
                    visit(static_cast<uint32_t>((v + side) % side * side + (u + side) % side));
                }
            }
        }
    }

    uint32_t size;
    std::vector<glm::vec3> light; ///< value of each texel, row by row
    std::vector<bool> known;

private:
    bool repeats_;
};

/// Fills the texels of `wanted` that touch known texels with the mean of the known neighbours. Returns the
/// filled texels.
std::vector<uint32_t> fill_beside(Canvas& canvas, const std::vector<uint32_t>& wanted);

/// Returns the unknown texels that touch `texels`, without duplicates.
[[nodiscard]] std::vector<uint32_t> unknown_beside(const Canvas& canvas, const std::vector<uint32_t>& texels);

} // namespace estampe::bake
