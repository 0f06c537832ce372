// SPDX-License-Identifier: MIT
#include <algorithm>
#include <set>

#include <estampe/error.hpp>
#include <fmt/format.h>

#include "core/exr.hpp"
#include "output/layer_bytes.hpp"
#include "output/layer_files.hpp"

namespace estampe::output {
namespace {

/// Names of layers in OpenEXR: dots part a layer from its channels, and no two may be alike.
class ChannelNames {
public:
    std::string make(std::string name)
    {
        std::ranges::replace(name, '.', '_');
        name = name.substr(0, longest);
        std::string unique = name;
        for (int number = 2; !taken_.insert(unique).second; ++number) {
            unique = fmt::format("{} {}", name, number);
        }
        return unique;
    }

private:
    static constexpr size_t longest = 200; // OpenEXR takes 255 with the channel's own
    std::set<std::string> taken_;
};

void add_layer(std::vector<ExrChannel>& channels, const std::string& prefix, const char* letters,
               const LinearImage& image)
{
    for (int channel = 0; letters[channel] != '\0'; ++channel) {
        channels.push_back({prefix + letters[channel], [&image, channel](uint32_t y, std::span<float> row) {
                                const glm::vec4* pixels = image.pixels.data() + size_t{y} * image.width;
                                std::transform(pixels, pixels + image.width, row.begin(),
                                               [channel](const glm::vec4& pixel) { return pixel[channel]; });
                            }});
    }
}

void add_mask(std::vector<ExrChannel>& channels, const std::string& name, const PictureMask& mask,
              const Image& page)
{
    if (mask.cover.size() != uint64_t{mask.width} * mask.height ||
        uint64_t{mask.x} + mask.width > page.width || uint64_t{mask.y} + mask.height > page.height) {
        throw Error("a mask does not lie on the page", mask.name);
    }
    channels.push_back({name + ".Y", [&mask](uint32_t y, std::span<float> row) {
                            std::ranges::fill(row, 0.0F);
                            if (y >= mask.y && y - mask.y < mask.height) {
                                const float* cover = mask.cover.data() + size_t{y - mask.y} * mask.width;
                                std::copy_n(cover, mask.width, row.begin() + mask.x);
                            }
                        }});
}

} // namespace

std::vector<std::byte> encode_layers_exr(const LayeredImage& image, ExrNumbers numbers)
{
    check_whole(image);
    const LinearImage whole = flattened(image);
    ChannelNames names;
    std::vector<ExrChannel> channels;
    std::vector<LayerFile> listed;
    std::vector<std::string> prefixes;
    const auto list = [&](const std::string& name, bool is_visible, const char* blend) {
        prefixes.push_back(names.make(name));
        listed.push_back({.name = name,
                          .blend = blend,
                          .is_visible = is_visible,
                          .width = image.picture.width,
                          .height = image.picture.height});
        return prefixes.back();
    };
    const auto add_masks = [&](size_t above) {
        for (const PictureMask& mask : image.masks) {
            if (std::min<size_t>(mask.above, image.layers.size()) == above) {
                add_mask(channels, list(mask.name, false, "normal"), mask, image.picture);
            }
        }
    };
    add_layer(channels, "", image.paper ? "RGBA" : "RGB", whole);
    for (size_t i = 0; i < image.layers.size(); ++i) {
        add_masks(i);
        const PictureLayer& layer = image.layers[i];
        const bool multiplies = layer.blend == LayerBlend::multiply;
        add_layer(channels, list(layer.name, layer.is_visible, multiplies ? "multiply" : "normal") + ".",
                  "RGBA", layer.image);
    }
    add_masks(image.layers.size());
    return encode_exr(image.picture.width, image.picture.height, channels, numbers,
                      {{"estampe:layers", manifest_of(image, listed, prefixes)}});
}

} // namespace estampe::output
