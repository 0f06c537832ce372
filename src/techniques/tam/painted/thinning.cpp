// SPDX-License-Identifier: MIT
#include <array>

#include "techniques/tam/painted/painted_strokes.hpp"

namespace estampe::tam {
namespace {

/// The eight neighbours of a texel, clockwise from the one above; the map wraps.
std::array<uint32_t, 8> around(uint32_t texel, uint32_t size_px)
{
    const uint32_t mask = size_px - 1;
    const uint32_t x = texel & mask;
    const uint32_t y = texel / size_px;
    const uint32_t left = (x - 1) & mask;
    const uint32_t right = (x + 1) & mask;
    const uint32_t up = ((y - 1) & mask) * size_px;
    const uint32_t here = y * size_px;
    const uint32_t down = ((y + 1) & mask) * size_px;
    return {up + x, up + right, here + right, down + right, down + x, down + left, here + left, up + left};
}

/// Whether a texel of the edge may go in this half of a round.
bool removable(const std::vector<uint8_t>& mask, uint32_t texel, uint32_t size_px, bool second)
{
    const std::array<uint32_t, 8> places = around(texel, size_px);
    std::array<uint8_t, 9> p{};
    int neighbours = 0;
    for (size_t i = 0; i < 8; ++i) {
        p[i] = mask[places[i]];
        neighbours += p[i];
    }
    p[8] = p[0];
    int rises = 0;
    for (size_t i = 0; i < 8; ++i) {
        rises += p[i] == 0 && p[i + 1] == 1 ? 1 : 0;
    }
    if (neighbours < 2 || neighbours > 6 || rises != 1) {
        return false;
    }
    return second ? (p[0] * p[2] * p[6] == 0 && p[0] * p[4] * p[6] == 0)
                  : (p[0] * p[2] * p[4] == 0 && p[2] * p[4] * p[6] == 0);
}

} // namespace

void thin(std::vector<uint8_t>& mask, uint32_t size_px)
{
    std::vector<uint32_t> inked;
    for (uint32_t texel = 0; texel < mask.size(); ++texel) {
        if (mask[texel] != 0) {
            inked.push_back(texel);
        }
    }
    std::vector<uint32_t> gone;
    bool changed = true;
    while (changed) {
        changed = false;
        for (const bool second : {false, true}) {
            gone.clear();
            for (const uint32_t texel : inked) {
                if (removable(mask, texel, size_px, second)) {
                    gone.push_back(texel);
                }
            }
            for (const uint32_t texel : gone) {
                mask[texel] = 0;
            }
            std::erase_if(inked, [&](uint32_t texel) { return mask[texel] == 0; });
            changed = changed || !gone.empty();
        }
    }
}

} // namespace estampe::tam
