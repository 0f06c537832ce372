// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

namespace estampe::tam {

/// A line one pixel wide in whole pixels, not wrapped.
using Chain = std::vector<glm::ivec2>;

/// A square of texels that wraps.
class Field {
public:
    Field(std::vector<uint8_t> texels, uint32_t size_px) : texels_(std::move(texels)), size_px_(size_px) {}

    [[nodiscard]] uint32_t size_px() const { return size_px_; }

    [[nodiscard]] const std::vector<uint8_t>& texels() const { return texels_; }

    [[nodiscard]] uint8_t& at(glm::ivec2 place) { return texels_[index(place)]; }

    [[nodiscard]] uint8_t at(glm::ivec2 place) const { return texels_[index(place)]; }

private:
    [[nodiscard]] size_t index(glm::ivec2 place) const
    {
        const uint32_t mask = size_px_ - 1;
        return size_t{static_cast<uint32_t>(place.y) & mask} * size_px_ +
               (static_cast<uint32_t>(place.x) & mask);
    }

    std::vector<uint8_t> texels_;
    uint32_t size_px_;
};

/// Joins chains whose ends point at each other, at most `reach_px` apart with ink between them all the way.
/// Gaps are filled with a straight line.
[[nodiscard]] std::vector<Chain> join_chains(std::vector<Chain> chains, const Field& ink, float reach_px);

} // namespace estampe::tam
