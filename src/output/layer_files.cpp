// SPDX-License-Identifier: MIT
#include "output/layer_files.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <iterator>
#include <system_error>

#include <estampe/error.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/file.hpp"
#include "core/image_codec.hpp"
#include "output/layer_bytes.hpp"

namespace estampe::output {
namespace {

/// A strong colour for each of many things, neighbours far apart.
std::array<uint8_t, 3> color_of(size_t number)
{
    constexpr double golden = 0.61803398875;
    std::array<uint8_t, 3> color{};
    for (size_t i = 0; i < color.size(); ++i) {
        double unused = 0.0;
        const double turn =
            std::modf(golden * static_cast<double>(number) + static_cast<double>(i) / 3.0, &unused);
        color.at(i) =
            static_cast<uint8_t>(std::lround(255.0 * std::clamp(std::abs(6.0 * turn - 3.0) - 1.0, 0.1, 0.9)));
    }
    return color;
}

LayerFile mask_file(const PictureMask& mask, size_t number)
{
    const uint64_t count = uint64_t{mask.width} * mask.height;
    if (count == 0 || mask.cover.size() != count) {
        throw Error("an empty mask cannot be written", mask.name);
    }
    const std::array<uint8_t, 3> color = mask.is_object ? color_of(number) : std::array<uint8_t, 3>{};
    Image image{.width = mask.width, .height = mask.height, .rgba = {}};
    image.rgba.reserve(4 * count);
    for (const float cover : mask.cover) {
        image.rgba.insert(image.rgba.end(), color.begin(), color.end());
        image.rgba.push_back(static_cast<uint8_t>(std::lround(255.0F * std::clamp(cover, 0.0F, 1.0F))));
    }
    return {.name = mask.name,
            .blend = "normal",
            .is_visible = false,
            .is_object = mask.is_object,
            .x = mask.x,
            .y = mask.y,
            .width = mask.width,
            .height = mask.height,
            .png = encode_png(image)};
}

LayerFile layer_file(const LayeredImage& image, const EncodedLayer& layer, int bits)
{
    LayerFile file{.name = layer.name,
                   .blend = layer.blend == LayerBlend::multiply ? "multiply" : "normal",
                   .is_visible = layer.is_visible,
                   .width = image.picture.width,
                   .height = image.picture.height};
    if (bits == 16) {
        file.png = encode_png(file.width, file.height, 4, layer.rgba);
    } else {
        Image bytes{.width = file.width, .height = file.height, .rgba = {}};
        bytes.rgba.reserve(layer.rgba.size());
        std::ranges::transform(layer.rgba, std::back_inserter(bytes.rgba),
                               [](uint16_t value) { return static_cast<uint8_t>(value); });
        file.png = encode_png(bytes);
    }
    return file;
}

/// A name that any disk takes: letters and digits of ASCII, the rest as dashes, and not too long.
std::string plain_name(const std::string& name)
{
    constexpr size_t longest = 60;
    std::string plain = name.substr(0, longest);
    std::ranges::replace_if(
        plain, [](unsigned char letter) { return letter >= 0x80 || std::isalnum(letter) == 0; }, '-');
    return plain;
}

} // namespace

std::vector<LayerFile> layer_files(const LayeredImage& image, int bits)
{
    if (bits != 8 && bits != 16) {
        throw Error(fmt::format("layers of {} bits a channel cannot be written", bits), {}, "8 and 16 can");
    }
    std::vector<LayerFile> files;
    const auto add_masks = [&](size_t above) {
        for (size_t i = 0; i < image.masks.size(); ++i) {
            if (std::min<size_t>(image.masks[i].above, image.layers.size()) == above) {
                files.push_back(mask_file(image.masks[i], i));
            }
        }
    };
    const std::vector<EncodedLayer> layers = encoded_layers(image, bits);
    for (size_t i = 0; i < layers.size(); ++i) {
        add_masks(i);
        files.push_back(layer_file(image, layers[i], bits));
    }
    add_masks(layers.size());
    return files;
}

std::string manifest_of(const LayeredImage& image, const std::vector<LayerFile>& files,
                        const std::vector<std::string>& file_names)
{
    nlohmann::ordered_json layers = nlohmann::ordered_json::array();
    for (size_t i = 0; i < files.size(); ++i) {
        const LayerFile& file = files[i];
        layers.push_back({{"file", file_names[i]},
                          {"name", file.name},
                          {"blend", file.blend},
                          {"visible", file.is_visible},
                          {"x", file.x},
                          {"y", file.y},
                          {"width", file.width},
                          {"height", file.height}});
    }
    const nlohmann::ordered_json manifest{
        {"width", image.picture.width}, {"height", image.picture.height}, {"layers", layers}};
    return manifest.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

AtomicFile pending_layers(const LayeredImage& image, std::filesystem::path folder, int bits)
{
    if (!folder.has_filename()) {
        folder = folder.parent_path();
    }
    std::error_code failure;
    if (std::filesystem::exists(folder, failure) && !std::filesystem::is_empty(folder, failure)) {
        throw Error("exists and is not empty", folder.string(),
                    "remove it, or give the name of a new folder");
    }
    const std::vector<LayerFile> files = layer_files(image, bits);
    AtomicFile pending = AtomicFile::folder(folder);
    std::vector<std::string> names;
    for (size_t i = 0; i < files.size(); ++i) {
        names.push_back(fmt::format("{:02}-{}.png", i, plain_name(files[i].name)));
        write_file_atomically(pending.path() / names.back(), files[i].png);
    }
    const std::string manifest = manifest_of(image, files, names);
    write_file_atomically(pending.path() / "layers.json", std::as_bytes(std::span(manifest)));
    std::filesystem::permissions(pending.path(), std::filesystem::perms(0755), failure);
    return pending;
}

} // namespace estampe::output
