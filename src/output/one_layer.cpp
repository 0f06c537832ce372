// SPDX-License-Identifier: MIT
#include "output/one_layer.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <vector>

#include <estampe/error.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/srgb.hpp"
#include "output/layer_bytes.hpp"

namespace estampe::output {
namespace {

LinearImage on_white(const LayeredImage& image)
{
    return {.width = image.picture.width,
            .height = image.picture.height,
            .pixels =
                std::vector<glm::vec4>(size_t{image.picture.width} * image.picture.height, glm::vec4(1.0F))};
}

void take_away(LinearImage& white, const PictureMask& mask)
{
    for (uint32_t y = 0; y < mask.height; ++y) {
        for (uint32_t x = 0; x < mask.width; ++x) {
            const float left = 1.0F - mask.cover[size_t{y} * mask.width + x];
            white.pixels[size_t{mask.y + y} * white.width + mask.x + x] = glm::vec4(glm::vec3(left), 1.0F);
        }
    }
}

} // namespace

LinearImage one_layer(const LayeredImage& image, const std::string& name)
{
    check_layers(image);
    LinearImage alone = on_white(image);
    const auto layer = std::ranges::find(image.layers, name, &PictureLayer::name);
    const auto mask = std::ranges::find(image.masks, name, &PictureMask::name);
    if (layer != image.layers.end()) {
        lay(alone, *layer);
    } else if (mask != image.masks.end()) {
        take_away(alone, *mask);
    } else {
        std::vector<std::string> names;
        std::ranges::transform(image.layers, std::back_inserter(names), &PictureLayer::name);
        std::ranges::transform(image.masks, std::back_inserter(names), &PictureMask::name);
        throw Error(fmt::format("the picture has no layer \"{}\"", name), "",
                    fmt::format("it has {}; a style may make others", fmt::join(names, ", ")));
    }
    return alone;
}

Image encoded_bytes(const LinearImage& image)
{
    Image bytes{.width = image.width, .height = image.height, .rgba = {}};
    bytes.rgba.reserve(4 * image.pixels.size());
    for (const glm::vec4& pixel : image.pixels) {
        for (int channel = 0; channel < 3; ++channel) {
            const float encoded = srgb_from_linear(std::clamp(pixel[channel], 0.0F, 1.0F));
            bytes.rgba.push_back(static_cast<uint8_t>(std::lround(255.0F * encoded)));
        }
        bytes.rgba.push_back(255);
    }
    return bytes;
}

} // namespace estampe::output
