// SPDX-License-Identifier: MIT
#pragma once

// OpenEXR, both ways, and what is in the files of lightmaps and motion.

#include <cstddef>
#include <filesystem>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <vector>

#include <estampe/lightmap.hpp>
#include <estampe/linear_image.hpp>

namespace estampe {

/// An OpenEXR picture with attributes of our own in its header.
struct ExrFile {
    LightImage image;
    std::map<std::string, std::string> texts;
    std::map<std::string, std::vector<float>> numbers;
};

/// Encodes red, green and blue as half floats, without loss beyond that; the same picture gives the same
/// bytes. Values are held to what a half can carry. Throws Error when the image is empty.
[[nodiscard]] std::vector<std::byte> encode_exr(const ExrFile& file);

/// One channel of a picture in linear light, by its name: "R", or "layer.R" of a layer.
struct ExrChannel {
    std::string name;
    /// Fills one row, from left to right.
    std::function<void(uint32_t y, std::span<float> row)> fill;
};

/// Encodes channels as halves or floats, and names the primaries of Rec. 709 in the header, besides `texts`.
/// Values are held to what a half can carry where they become halves. Throws Error when the picture is empty.
[[nodiscard]] std::vector<std::byte> encode_exr(uint32_t width, uint32_t height,
                                                std::span<const ExrChannel> channels, ExrNumbers numbers,
                                                const std::map<std::string, std::string>& texts = {});

/// Decodes the first part of an OpenEXR picture; grey becomes three channels, alpha is left out. Negative and
/// non-finite values become zero. Throws Error with `name` as its place when the data is none, damaged or
/// beyond the limits of image_codec.hpp.
[[nodiscard]] ExrFile decode_exr(std::span<const std::byte> bytes, const std::string& name);

/// Whether the bytes begin as an OpenEXR picture does.
[[nodiscard]] bool is_exr(std::span<const std::byte> bytes);

/// Whether the header is that of a map which `estampe bake` made.
[[nodiscard]] bool is_baked(const ExrFile& file);

/// The map in such a picture. Throws Error with `path` as its place when it is none or damaged.
[[nodiscard]] Lightmap baked_lightmap(ExrFile file, const std::filesystem::path& path);

} // namespace estampe
