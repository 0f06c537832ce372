// SPDX-License-Identifier: MIT
// Pictures of more than eight bits a channel.
#include <algorithm>
#include <cmath>

#include <estampe/error.hpp>
#include <fmt/format.h>

#include "core/exr.hpp"
#include "core/image_codec.hpp"
#include "core/srgb.hpp"
#include "output/covering.hpp"
#include "output/pictures.hpp"

namespace estampe::output {

void check_pixels(const LinearImage& image)
{
    if (image.empty() || image.pixels.size() != uint64_t{image.width} * image.height) {
        throw Error(fmt::format("a picture of {} x {} with {} pixels cannot be written", image.width,
                                image.height, image.pixels.size()));
    }
}

std::vector<std::byte> encode_deep_png(const LinearImage& image, uint32_t dots_per_m)
{
    check_pixels(image);
    std::vector<uint16_t> values;
    if (image.paper) {
        const Arithmetic in(16);
        values.reserve(4 * image.pixels.size());
        for (const glm::vec4& pixel : image.pixels) {
            const glm::ivec4 numbers = straight(pixel, *image.paper, in);
            for (int channel = 0; channel < 4; ++channel) {
                values.push_back(static_cast<uint16_t>(numbers[channel]));
            }
        }
        return encode_png(image.width, image.height, 4, values, dots_per_m);
    }
    values.reserve(3 * image.pixels.size());
    for (const glm::vec4& pixel : image.pixels) {
        for (int channel = 0; channel < 3; ++channel) {
            const float encoded = srgb_from_linear(std::clamp(pixel[channel], 0.0F, 1.0F));
            values.push_back(static_cast<uint16_t>(std::lround(65535.0F * encoded)));
        }
    }
    return encode_png(image.width, image.height, 3, values, dots_per_m);
}

std::vector<std::byte> encode_picture_exr(const LinearImage& image, ExrNumbers numbers)
{
    check_pixels(image);
    std::vector<ExrChannel> channels;
    const int count = image.paper ? 4 : 3;
    channels.reserve(static_cast<size_t>(count));
    for (int channel = 0; channel < count; ++channel) {
        channels.push_back(
            {std::string(1, "RGBA"[channel]), [&image, channel](uint32_t y, std::span<float> row) {
                 const glm::vec4* pixels = image.pixels.data() + size_t{y} * image.width;
                 std::transform(pixels, pixels + image.width, row.begin(),
                                [channel](const glm::vec4& pixel) { return pixel[channel]; });
             }});
    }
    return encode_exr(image.width, image.height, channels, numbers);
}

} // namespace estampe::output
