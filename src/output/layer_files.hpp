// SPDX-License-Identifier: MIT
#pragma once

// Encodes layers and masks as files.

#include <cstddef>
#include <string>
#include <vector>

#include <estampe/layers.hpp>

#include "core/file.hpp"

namespace estampe::output {

/// Encode the files of save_openraster() and save_layers_exr(), and throw Error in the same cases as the save
/// functions, but without a file name.
[[nodiscard]] std::vector<std::byte> encode_openraster(const LayeredImage& image);
[[nodiscard]] std::vector<std::byte> encode_layers_exr(const LayeredImage& image, ExrNumbers numbers);

/// Writes the folder of save_layers() under a temporary name, to be published by the caller.
[[nodiscard]] AtomicFile pending_layers(const LayeredImage& image, std::filesystem::path folder, int bits);

/// A layer or mask encoded as a PNG, with its position.
struct LayerFile {
    std::string name;
    std::string blend; ///< How the layer is blended: "normal" or "multiply"
    bool is_visible = true;
    bool is_object = false; ///< The layer is the mask of an object
    uint32_t x = 0;
    uint32_t y = 0;
    uint32_t width = 0;
    uint32_t height = 0;
    std::vector<std::byte> png;
};

/// Encodes all layers and masks from bottom to top. `bits` is the number of bits per channel of layers. A
/// mask has its coverage as alpha and one flat colour: black for the shadow, another colour for each object.
[[nodiscard]] std::vector<LayerFile> layer_files(const LayeredImage& image, int bits);

/// Writes the content of layers.json: everything about the layers except their pixels.
[[nodiscard]] std::string manifest_of(const LayeredImage& image, const std::vector<LayerFile>& files,
                                      const std::vector<std::string>& file_names);

} // namespace estampe::output
