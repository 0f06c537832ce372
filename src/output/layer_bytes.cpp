// SPDX-License-Identifier: MIT
#include "output/layer_bytes.hpp"

#include <algorithm>

#include <estampe/error.hpp>
#include <fmt/format.h>

#include "output/covering.hpp"
#include "output/pictures.hpp"

namespace estampe::output {
namespace {

/// Colour and alpha of a layer that multiplies.
glm::ivec4 multiplying(Laid& laid, const Wanted& wanted, const Arithmetic& in)
{
    glm::ivec4 pixel(in.top());
    for (int i = 0; i < 3; ++i) {
        const double ideal = laid.exact[i] > 0.0 ? in.top() * wanted.exact[i] / laid.exact[i] : in.top();
        const int below = laid.rounded[i];
        pixel[i] = tuned(in.nearest(ideal), wanted.rounded[i], in.top(),
                         [&](int factor) { return in.multiplied(below, factor); });
        laid.rounded[i] = in.multiplied(below, pixel[i]);
        laid.exact[i] *= static_cast<double>(pixel[i]) / in.top();
    }
    const bool is_white = glm::ivec3(pixel) == glm::ivec3(in.top());
    return is_white ? glm::ivec4(0) : pixel;
}

/// Which layer is the last to change each pixel.
std::vector<size_t> topmost_layers(const LayeredImage& image)
{
    std::vector<size_t> topmost(image.layers.front().image.pixels.size(), 0);
    for (size_t number = 1; number < image.layers.size(); ++number) {
        const PictureLayer& layer = image.layers[number];
        const glm::vec4 nothing(layer.blend == LayerBlend::multiply ? 1.0F : 0.0F);
        for (size_t i = 0; i < topmost.size(); ++i) {
            topmost[i] = layer.image.pixels[i] == nothing ? topmost[i] : number;
        }
    }
    return topmost;
}

Numbers numbers_of(const glm::vec4& linear, const Arithmetic& in)
{
    const glm::dvec3 exact = in.encoded(glm::vec3(linear));
    return {in.nearest(exact.x), in.nearest(exact.y), in.nearest(exact.z)};
}

void check_opaque(const PictureLayer& bottom)
{
    const bool is_opaque =
        std::ranges::all_of(bottom.image.pixels, [](const glm::vec4& pixel) { return pixel.w >= 1.0F; });
    if (!is_opaque || bottom.blend != LayerBlend::normal) {
        throw Error("the bottom layer of a picture must be opaque and normal", bottom.name);
    }
}

} // namespace

void check_layers(const LayeredImage& image)
{
    if (image.layers.empty()) {
        throw Error("a picture without layers cannot be written");
    }
    for (const PictureLayer& layer : image.layers) {
        check_pixels(layer.image);
        const LinearImage& bottom = image.layers.front().image;
        if (layer.image.width != bottom.width || layer.image.height != bottom.height) {
            throw Error("a layer is not as large as the bottom one", layer.name);
        }
    }
}

void check_whole(const LayeredImage& image)
{
    check_layers(image);
    const LinearImage& bottom = image.layers.front().image;
    const Image& picture = image.picture;
    if (picture.width != bottom.width || picture.height != bottom.height ||
        picture.rgba.size() != 4 * bottom.pixels.size()) {
        throw Error("the picture is not as large as its layers");
    }
}

void lay(LinearImage& below, const PictureLayer& layer)
{
    for (size_t i = 0; i < below.pixels.size(); ++i) {
        const glm::vec4& pixel = layer.image.pixels[i];
        const glm::vec4 under = below.pixels[i];
        below.pixels[i] =
            layer.blend == LayerBlend::multiply ? under * pixel : pixel + under * (1.0F - pixel.w);
    }
}

std::vector<EncodedLayer> encoded_layers(const LayeredImage& image, int bits)
{
    check_whole(image);
    check_opaque(image.layers.front());
    const Arithmetic in(bits);
    LinearImage stage = image.layers.front().image;
    if (image.paper) { // its relief is not that of what will lie below the others
        std::ranges::fill(stage.pixels, glm::vec4(*image.paper, 1.0F));
    }
    std::vector<Laid> laid(stage.pixels.size());
    const std::vector<size_t> topmost = topmost_layers(image);
    std::vector<EncodedLayer> result;
    for (size_t number = 0; number < image.layers.size(); ++number) {
        const PictureLayer& layer = image.layers[number];
        if (number > 0) {
            lay(stage, layer);
        }
        EncodedLayer& encoded = result.emplace_back(
            EncodedLayer{.name = layer.name, .blend = layer.blend, .is_visible = layer.is_visible});
        encoded.rgba.reserve(4 * stage.pixels.size());
        for (size_t i = 0; i < stage.pixels.size(); ++i) {
            Wanted wanted{.exact = in.encoded(glm::vec3(stage.pixels[i]))};
            const bool is_whole = bits == 8 && number >= topmost[i] && !image.paper;
            for (int channel = 0; channel < 3; ++channel) {
                wanted.rounded[channel] = is_whole ? image.picture.rgba[4 * i + static_cast<size_t>(channel)]
                                                   : in.nearest(wanted.exact[channel]);
            }
            glm::ivec4 pixel(wanted.rounded, in.top());
            if (number == 0) {
                laid[i] = {wanted.rounded, wanted.rounded};
                pixel = image.paper ? glm::ivec4(numbers_of(layer.image.pixels[i], in), in.top()) : pixel;
            } else if (layer.blend == LayerBlend::multiply) {
                pixel = multiplying(laid[i], wanted, in);
            } else {
                pixel = covering(laid[i], wanted, layer.image.pixels[i], in);
            }
            for (int channel = 0; channel < 4; ++channel) {
                encoded.rgba.push_back(static_cast<uint16_t>(pixel[channel]));
            }
        }
    }
    return result;
}

} // namespace estampe::output

namespace estampe {

LinearImage flattened(const LayeredImage& image)
{
    output::check_layers(image);
    LinearImage result = image.layers.front().image;
    if (!image.layers.front().is_visible) {
        std::ranges::fill(result.pixels, glm::vec4(0.0F));
    }
    for (size_t i = 1; i < image.layers.size(); ++i) {
        if (image.layers[i].is_visible) {
            output::lay(result, image.layers[i]);
        }
    }
    result.paper = image.paper;
    return result;
}

} // namespace estampe
