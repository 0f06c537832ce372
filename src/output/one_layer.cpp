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
#include "output/covering.hpp"
#include "output/layer_bytes.hpp"

namespace estampe::output {
namespace {

LinearImage on_white(const LayeredImage& image)
{
    return {.width = image.picture.width,
            .height = image.picture.height,
            .pixels =
                std::vector<glm::vec4>(size_t{image.picture.width} * image.picture.height, glm::vec4(1.0F)),
            .paper = std::nullopt};
}

/// What lies on white, without the white: what is darker than it hides as little as will do.
glm::vec4 without_white(const glm::vec3& laid)
{
    const float alpha = std::clamp(1.0F - std::min({laid.x, laid.y, laid.z}), 0.0F, 1.0F);
    return {glm::max(laid - (1.0F - alpha), 0.0F), alpha};
}

/// The layer or mask on nothing in place of white, which it is then found to lie on.
void take_white_away(LinearImage& alone, const PictureLayer* layer)
{
    for (size_t i = 0; i < alone.pixels.size(); ++i) {
        const bool has_alpha = layer != nullptr && layer->blend == LayerBlend::normal;
        alone.pixels[i] = has_alpha ? layer->image.pixels[i] : without_white(glm::vec3(alone.pixels[i]));
    }
    alone.paper = glm::vec3(1.0F);
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
    if (image.paper) {
        take_white_away(alone, layer != image.layers.end() ? &*layer : nullptr);
    }
    return alone;
}

Image encoded_bytes(const LinearImage& image)
{
    Image bytes{.width = image.width, .height = image.height, .rgba = {}};
    bytes.rgba.reserve(4 * image.pixels.size());
    const Arithmetic in(8);
    for (const glm::vec4& pixel : image.pixels) {
        if (image.paper) {
            const glm::ivec4 numbers = straight(pixel, *image.paper, in);
            for (int channel = 0; channel < 4; ++channel) {
                bytes.rgba.push_back(static_cast<uint8_t>(numbers[channel]));
            }
            continue;
        }
        for (int channel = 0; channel < 3; ++channel) {
            const float encoded = srgb_from_linear(std::clamp(pixel[channel], 0.0F, 1.0F));
            bytes.rgba.push_back(static_cast<uint8_t>(std::lround(255.0F * encoded)));
        }
        bytes.rgba.push_back(255);
    }
    return bytes;
}

} // namespace estampe::output
