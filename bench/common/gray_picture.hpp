// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>

#include <estampe/image.hpp>

namespace estampe::bench {

/// Writes a gray PNG file. `gray_at(x, y)` gives each pixel, x to the right and y down.
template <class GrayAt>
void save_gray_picture(uint32_t width, uint32_t height, const GrayAt& gray_at, const std::string& file)
{
    Image image{.width = width, .height = height};
    for (uint32_t y = 0; y < height; ++y) {
        for (uint32_t x = 0; x < width; ++x) {
            const uint8_t gray = gray_at(x, y);
            image.rgba.insert(image.rgba.end(), {gray, gray, gray, 255});
        }
    }
    save_png(image, file);
}

} // namespace estampe::bench
