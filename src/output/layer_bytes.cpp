// SPDX-License-Identifier: MIT
#include "output/layer_bytes.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <estampe/error.hpp>

#include "core/color.hpp"
#include "output/pictures.hpp"

namespace estampe::output {
namespace {

/// A colour whose components are integers, as in compositing programs.
using Numbers = glm::ivec3;

/// Composite at one pixel of all layers processed so far. The composite is stored twice, because two kinds of
/// programs compute it differently.
struct Laid {
    Numbers rounded{0};    ///< Composite in a program that rounds to integers after every layer
    glm::dvec3 exact{0.0}; ///< Composite in a program that works in floats; in the same unit as `rounded`
};

/// The colour that the composite must have after the next layer is added.
struct Wanted {
    Numbers rounded{0};
    glm::dvec3 exact{0.0};
};

/// Finds the number for which the increasing function `result` gives `wanted`, or comes nearest to `wanted`.
/// The search begins at `start`.
template <class Result>
int tuned(int start, int wanted, int top, const Result& result)
{
    while (start < top && result(start) < wanted) {
        ++start;
    }
    while (start > 0 && result(start) > wanted) {
        --start;
    }
    return start;
}

/// Least alpha with which a layer of any colour can turn the value `below` into `wanted`.
double least_alpha(double below, double wanted, double top)
{
    if (wanted > below) {
        return (wanted - below) / std::max(top - below, wanted - below);
    }
    return below > wanted ? (below - wanted) / below : 0.0;
}

/// Alpha with which a layer of one pigment (flat colour) comes nearest to the wanted colour. If the pigment
/// is too similar to the colour below, the layer's coverage of the pixel is used as alpha.
double pigment_alpha(const Laid& laid, const Wanted& wanted, const glm::dvec3& pigment, double share, int top)
{
    const glm::dvec3 way = laid.exact - pigment;
    const double least_way = 0.02 * top;
    const double length_2 = glm::dot(way, way);
    return length_2 > least_way * least_way ? glm::dot(laid.exact - wanted.exact, way) / length_2 : share;
}

/// Returns the colour and alpha of a layer of ink or paint that turns `laid` (the composite of the layers
/// below) into `wanted`. `paint` is the premultiplied colour and alpha of the ink or paint, in linear light.
/// The paint's colour is kept if some alpha gives the wanted result, and changed otherwise. Updates `laid` to
/// the composite with the new layer.
glm::ivec4 covering(Laid& laid, const Wanted& wanted, const glm::vec4& paint, const Arithmetic& in)
{
    if (paint.w <= 0.0F) {
        return glm::ivec4(0);
    }
    const int top = in.top();
    const glm::dvec3 pigment = in.encoded(glm::vec3(paint) / paint.w);
    double least = 0.0;
    for (int i = 0; i < 3; ++i) {
        least = std::max({least, least_alpha(laid.exact[i], wanted.exact[i], top),
                          least_alpha(laid.rounded[i], wanted.rounded[i], top)});
    }
    const double share =
        std::max(least, pigment_alpha(laid, wanted, pigment, static_cast<double>(paint.w), top));
    const int alpha = std::clamp(
        std::max(static_cast<int>(std::ceil(least * top - 1e-9)), in.nearest(share * top)), 0, top);
    if (alpha == 0) {
        return glm::ivec4(0);
    }
    glm::ivec4 pixel(0, 0, 0, alpha);
    for (int i = 0; i < 3; ++i) {
        const auto result = [&](int color) { return in.over(laid.rounded[i], color, alpha); };
        const int own = in.nearest(pigment[i]);
        const bool serves = result(own) == wanted.rounded[i] &&
                            std::abs(in.over(laid.exact[i], own, alpha) - wanted.exact[i]) <= 0.5;
        const double ideal = laid.exact[i] + (wanted.exact[i] - laid.exact[i]) * top / alpha;
        pixel[i] = serves ? own : tuned(in.nearest(ideal), wanted.rounded[i], top, result);
        laid.exact[i] = in.over(laid.exact[i], pixel[i], alpha);
        laid.rounded[i] = result(pixel[i]);
    }
    return pixel;
}

} // namespace

glm::ivec4 straight(const glm::vec4& page, const glm::vec3& paper, const Arithmetic& in)
{
    const float alpha = std::min(page.w, 1.0F);
    Wanted wanted{.exact = in.encoded(glm::vec3(page) + (1.0F - alpha) * paper)};
    Laid laid{.exact = in.encoded(paper)};
    for (int i = 0; i < 3; ++i) {
        wanted.rounded[i] = in.nearest(wanted.exact[i]);
        laid.rounded[i] = in.nearest(laid.exact[i]);
    }
    if (page.w >= 1.0F) {
        return {wanted.rounded, in.top()};
    }
    return covering(laid, wanted, page, in);
}

namespace {

/// Returns the colour and alpha of a layer with the blend mode multiply. The layer changes `laid` (the
/// composite of the layers below) into `wanted`.
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

/// Finds for each pixel the index of the last layer that changes it.
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

/// Checks that there are layers and that all layers have the same size. Throws Error as flattened() does.
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

} // namespace

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
    // In a transparent picture, a flat colour replaces the paper layer, because the user's own paper does not
    // have the relief of the paper layer.
    if (image.paper) {
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

/// Removes the white on which a colour was composited. The result has the smallest alpha that allows this.
glm::vec4 without_white(const glm::vec3& laid)
{
    const float alpha = std::clamp(1.0F - std::min({laid.x, laid.y, laid.z}), 0.0F, 1.0F);
    return {glm::max(laid - (1.0F - alpha), 0.0F), alpha};
}

/// Replaces the white below a layer or mask by transparency, and sets the image's paper colour to white.
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
