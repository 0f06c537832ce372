// SPDX-License-Identifier: MIT
#pragma once

// Reads and writes OpenEXR files, with the header attributes of lightmaps and motion.

#include <cstddef>
#include <filesystem>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include <estampe/lightmap.hpp>
#include <estampe/linear_image.hpp>
#include <estampe/motion.hpp>

#include "core/child/exchange.hpp"

namespace estampe {

/// An OpenEXR picture with the header attributes that this program stores.
struct ExrFile {
    LightImage image;
    std::map<std::string, std::string> texts;
    std::map<std::string, std::vector<float>> numbers;
};

/// Encodes the red, green and blue of a picture as half floats with lossless compression. The same picture
/// gives the same bytes. Values are clamped to the range of a half. Throws Error if the image is empty.
[[nodiscard]] std::vector<std::byte> encode_exr(const ExrFile& file);

/// One channel of a picture in linear light, named "R", or "layer.R" for a layer.
struct ExrChannel {
    std::string name;
    /// Writes row `y` of the channel into `row`, from left to right.
    std::function<void(uint32_t y, std::span<float> row)> fill;
};

/// Encodes channels as half floats or floats, with the Rec. 709 primaries and `texts` in the header. Half
/// floats are clamped to their range. Throws Error if the picture is empty.
[[nodiscard]] std::vector<std::byte> encode_exr(uint32_t width, uint32_t height,
                                                std::span<const ExrChannel> channels, ExrNumbers numbers,
                                                const std::map<std::string, std::string>& texts = {});

/// Encodes the file of save_motion(). Throws Error with `path` as its place if there is no motion.
[[nodiscard]] std::vector<std::byte> encode_motion(const Motion& motion, const std::filesystem::path& path);

/// Decodes an OpenEXR picture (of a multi-part file, the first part). Grey becomes three channels, alpha is
/// ignored, negative and non-finite values become zero. Throws Error with `name` as its place if the data is
/// not OpenEXR, is damaged, or exceeds the limits in image_codec.hpp.
[[nodiscard]] ExrFile decode_exr(std::span<const std::byte> bytes, const std::string& name);

/// Returns whether the bytes start with OpenEXR's magic number.
[[nodiscard]] bool is_exr(std::span<const std::byte> bytes);

/// Returns whether the header says that `estampe bake` wrote the file as a lightmap.
[[nodiscard]] bool is_baked(const ExrFile& file);

/// Returns the lightmap in an OpenEXR picture. Throws Error with `path` as its place if the picture is not a
/// lightmap or is damaged.
[[nodiscard]] Lightmap baked_lightmap(ExrFile file, const std::filesystem::path& path);

// Lists of members, for send() and receive() of core/child/exchange.hpp.

template <Either<LightImage> T>
auto members(T& image)
{
    auto& [width, height, texels] = image;
    return std::tie(width, height, texels);
}

template <Either<WornPicture> T>
auto members(T& worn)
{
    auto& [picture, uv_set, intensity] = worn;
    return std::tie(picture, uv_set, intensity);
}

template <Either<Lightmap> T>
auto members(T& map)
{
    auto& [light, corners, geometry, exposure, baked_lights, settings, pictures, of_node, of_material,
           of_scene] = map;
    return std::tie(light, corners, geometry, exposure, baked_lights, settings, pictures, of_node,
                    of_material, of_scene);
}

/// Returns whether the sizes, indices and texture coordinates of the lightmap are valid. For lightmaps that
/// come from another process.
[[nodiscard]] bool is_well_formed(const Lightmap& map);

} // namespace estampe
