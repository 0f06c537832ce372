// SPDX-License-Identifier: MIT
#include "techniques/surface/mips.hpp"

#include <algorithm>
#include <cstring>

#include "core/long_jobs.hpp"

#if defined(__GNUC__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wextra"
#endif
#define STB_IMAGE_RESIZE_IMPLEMENTATION
#define STB_IMAGE_RESIZE_STATIC
#include <stb/stb_image_resize.h>
#if defined(__GNUC__)
#pragma GCC diagnostic pop
#endif

namespace estampe::surface {
namespace {

constexpr uint32_t made_ahead = 2;

std::vector<std::byte> halved(const std::vector<std::byte>& fine, uint32_t fine_side)
{
    const uint32_t side = fine_side / 2;
    std::vector<std::byte> coarse(static_cast<size_t>(side) * side * 4);
    const auto* from = reinterpret_cast<const uint8_t*>(fine.data());
    const size_t row = static_cast<size_t>(fine_side) * 4;
    for (uint32_t y = 0; y < side; ++y) {
        for (uint32_t x = 0; x < side; ++x) {
            const uint8_t* corner = from + 2 * y * row + 8 * static_cast<size_t>(x);
            for (size_t c = 0; c < 4; ++c) {
                const unsigned sum = corner[c] + corner[c + 4] + corner[row + c] + corner[row + c + 4];
                coarse[(static_cast<size_t>(y) * side + x) * 4 + c] = static_cast<std::byte>((sum + 2U) / 4U);
            }
        }
    }
    return coarse;
}

} // namespace

gpu::LayerPixels make_mips(const Image& image, uint32_t side)
{
    std::vector<std::byte> top(static_cast<size_t>(side) * side * 4);
    if (image.width == side && image.height == side) {
        std::memcpy(top.data(), image.rgba.data(), top.size());
    } else {
        stbir_resize_uint8(image.rgba.data(), static_cast<int>(image.width), static_cast<int>(image.height),
                           0, reinterpret_cast<unsigned char*>(top.data()), static_cast<int>(side),
                           static_cast<int>(side), 0, 4);
    }
    gpu::LayerPixels pixels;
    pixels.levels.push_back(std::move(top));
    for (uint32_t s = side; s > 1; s /= 2) {
        pixels.levels.push_back(halved(pixels.levels.back(), s));
    }
    return pixels;
}

MipQueue::MipQueue(const Scene& scene, const std::vector<Index>& layers, uint32_t side)
    : scene_(scene), layers_(layers), side_(side), pending_(std::max<size_t>(layers.size(), 1))
{
    for (uint32_t layer = 0; layer < std::min<size_t>(made_ahead, pending_.size()); ++layer) {
        start(layer);
    }
}

void MipQueue::start(uint32_t layer)
{
    static const Image white{.width = 1, .height = 1, .rgba = {255, 255, 255, 255}};
    const Image& image = layers_.empty() ? white : scene_.textures[layers_[layer]].image;
    pending_[layer] = std::async(launch_if_possible, make_mips, std::cref(image), side_);
}

gpu::LayerPixels MipQueue::take(uint32_t layer)
{
    gpu::LayerPixels pixels = pending_[layer].get();
    if (layer + made_ahead < pending_.size()) {
        start(layer + made_ahead);
    }
    return pixels;
}

} // namespace estampe::surface
