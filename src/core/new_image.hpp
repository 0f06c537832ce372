// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>

#include <fmt/format.h>

#include <estampe/error.hpp>

#include "core/free_memory.hpp"
#include "core/image_codec.hpp"

namespace estampe {

/// Throws Error with `name` as its place when an image of that size is beyond the limits of what is read.
inline void check_image_size(uint64_t width, uint64_t height, const std::string& name)
{
    if (width == 0 || height == 0 || width > max_image_side || height > max_image_side ||
        width * height > max_image_pixels) {
        throw Error(fmt::format("image of {} x {} pixels is beyond the limit of {} x {} and {} megapixels",
                                width, height, max_image_side, max_image_side, max_image_pixels >> 20),
                    name);
    }
}

/// An image of that size, all zeros, after its size and the free memory have been checked.
template <class Picture = Image>
Picture new_image(uint64_t width, uint64_t height, const std::string& name)
{
    check_image_size(width, height, name);
    require_memory(width * height * 4 * sizeof(typename decltype(Picture::rgba)::value_type),
                   fmt::format("an image of {} x {} pixels", width, height), name);
    Picture image{.width = static_cast<uint32_t>(width), .height = static_cast<uint32_t>(height), .rgba = {}};
    image.rgba.resize(width * height * 4);
    return image;
}

} // namespace estampe
