// SPDX-License-Identifier: MIT
#include "output/layer_files.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <iterator>
#include <set>
#include <system_error>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <estampe/error.hpp>
#include <estampe/layers.hpp>

#include "core/color.hpp"
#include "core/exr.hpp"
#include "core/file.hpp"
#include "core/image_codec.hpp"
#include "core/zip_writer.hpp"
#include "output/layer_bytes.hpp"
#include "output/pictures.hpp"
#include "output/svg.hpp"

namespace estampe::output {
namespace {

/// Returns a saturated colour for a number; consecutive numbers give very different colours.
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

/// Makes a file name that is valid on any disk: keeps ASCII letters and digits, replaces other characters by
/// dashes, and limits the length.
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

namespace {

std::string layer_element(const LayerFile& file, const std::string& source)
{
    return fmt::format("<layer name=\"{}\" src=\"{}\" x=\"{}\" y=\"{}\" opacity=\"1\" visibility=\"{}\" "
                       "composite-op=\"{}\"/>\n",
                       escaped(file.name), source, file.x, file.y, file.is_visible ? "visible" : "hidden",
                       file.blend == "multiply" ? "svg:multiply" : "svg:src-over");
}

/// Writes the layer stack of an OpenRaster file, topmost layer first; the masks of objects are in a group at
/// the top.
std::string stack_of(const LayeredImage& image, const std::vector<LayerFile>& files,
                     const std::vector<std::string>& sources)
{
    std::string objects;
    std::string others;
    for (size_t i = files.size(); i-- > 0;) {
        (files[i].is_object ? objects : others) += layer_element(files[i], sources[i]);
    }
    if (!objects.empty()) {
        objects = fmt::format("<stack name=\"objects\" opacity=\"1\" visibility=\"visible\" "
                              "composite-op=\"svg:src-over\">\n{}</stack>\n",
                              objects);
    }
    return fmt::format("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
                       "<image version=\"0.0.3\" w=\"{}\" h=\"{}\">\n<stack>\n{}{}</stack>\n</image>\n",
                       image.picture.width, image.picture.height, objects, others);
}

/// Makes a thumbnail: the picture scaled to at most 256 pixels per side; colours and alpha are averaged in
/// linear light.
Image thumbnail_of(const Image& picture)
{
    constexpr uint32_t longest_side = 256;
    static const auto linear = linear_of_srgb_bytes<float>();
    const uint32_t longest = std::max(picture.width, picture.height);
    const auto reduced = [&](uint32_t side) {
        return longest <= longest_side
                   ? side
                   : std::max(1U, static_cast<uint32_t>(uint64_t{side} * longest_side / longest));
    };
    Image thumbnail{.width = reduced(picture.width), .height = reduced(picture.height), .rgba = {}};
    const auto place = [](uint32_t i, uint32_t from, uint32_t to) {
        return static_cast<uint32_t>(uint64_t{i} * from / to);
    };
    for (uint32_t y = 0; y < thumbnail.height; ++y) {
        for (uint32_t x = 0; x < thumbnail.width; ++x) {
            const uint32_t top = place(y, picture.height, thumbnail.height);
            const uint32_t bottom = std::max(top + 1, place(y + 1, picture.height, thumbnail.height));
            const uint32_t left = place(x, picture.width, thumbnail.width);
            const uint32_t right = std::max(left + 1, place(x + 1, picture.width, thumbnail.width));
            glm::vec4 sum(0.0F); // Sum of the premultiplied colours and the alphas
            for (uint32_t from_y = top; from_y < bottom; ++from_y) {
                for (uint32_t from_x = left; from_x < right; ++from_x) {
                    const uint8_t* pixel = &picture.rgba[4 * (size_t{from_y} * picture.width + from_x)];
                    const float alpha = static_cast<float>(pixel[3]) / 255.0F;
                    sum += alpha * glm::vec4(linear[pixel[0]], linear[pixel[1]], linear[pixel[2]], 1.0F);
                }
            }
            const float alpha = sum.w / static_cast<float>((bottom - top) * (right - left));
            sum /= std::max(sum.w, 1e-6F);
            for (int channel = 0; channel < 3; ++channel) {
                thumbnail.rgba.push_back(static_cast<uint8_t>(
                    std::lround(255.0F * srgb_from_linear(std::min(sum[channel], 1.0F)))));
            }
            thumbnail.rgba.push_back(static_cast<uint8_t>(std::lround(255.0F * alpha)));
        }
    }
    return thumbnail;
}

} // namespace

std::vector<std::byte> encode_openraster(const LayeredImage& image)
{
    const std::vector<LayerFile> files = layer_files(image, 8);
    std::vector<std::string> sources;
    for (size_t i = 0; i < files.size(); ++i) {
        sources.push_back(fmt::format("data/{:03}.png", i));
    }
    const std::string mimetype = "image/openraster";
    const std::string stack = stack_of(image, files, sources);
    const std::vector<std::byte> merged = encode_png(image.picture);
    const std::vector<std::byte> thumbnail = encode_png(thumbnail_of(image.picture));
    ZipWriter archive;
    // The entry `mimetype` is first and uncompressed, so that programs recognise the format.
    archive.add("mimetype", std::as_bytes(std::span(mimetype)), false);
    archive.add("stack.xml", std::as_bytes(std::span(stack)), true);
    for (size_t i = 0; i < files.size(); ++i) {
        archive.add(sources[i], files[i].png, false);
    }
    archive.add("mergedimage.png", merged, false);
    archive.add("Thumbnails/thumbnail.png", thumbnail, false);
    return archive.finish();
}

namespace {

/// Makes unique OpenEXR layer names. Dots separate a layer from its channels, so names have no dots.
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
    // Longest name of a layer; OpenEXR allows 255 characters including the channel's name.
    static constexpr size_t longest = 200;
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

namespace estampe {

void save_openraster(const LayeredImage& image, const std::filesystem::path& path)
{
    output::save_as(path, [&] { return output::encode_openraster(image); });
}

void save_layers(const LayeredImage& image, const std::filesystem::path& folder, int bits)
{
    output::pending_layers(image, folder, bits).publish();
}

void save_layers_exr(const LayeredImage& image, const std::filesystem::path& path, ExrNumbers numbers)
{
    output::save_as(path, [&] { return output::encode_layers_exr(image, numbers); });
}

} // namespace estampe
