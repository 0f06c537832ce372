// SPDX-License-Identifier: MIT
#pragma once

// Layers and masks as the bytes of files.

#include <cstddef>
#include <string>
#include <vector>

#include <estampe/layers.hpp>

#include "core/file.hpp"

namespace estampe::output {

/// As save_openraster() and save_layers_exr() write them. Throw Error as those do, but name no file.
[[nodiscard]] std::vector<std::byte> encode_openraster(const LayeredImage& image);
[[nodiscard]] std::vector<std::byte> encode_layers_exr(const LayeredImage& image, ExrNumbers numbers);

/// The folder of save_layers() before it has its name.
[[nodiscard]] AtomicFile pending_layers(const LayeredImage& image, std::filesystem::path folder, int bits);

/// A layer or mask as a picture of its own, and where it lies.
struct LayerFile {
    std::string name;
    std::string blend; ///< "normal" or "multiply"
    bool is_visible = true;
    bool is_object = false; ///< a mask of one
    uint32_t x = 0;
    uint32_t y = 0;
    uint32_t width = 0;
    uint32_t height = 0;
    std::vector<std::byte> png;
};

/// All of them from the bottom up, layers of `bits` a channel. Masks are flat: each object in a colour of its
/// own, the shadow black, and their cover is alpha.
[[nodiscard]] std::vector<LayerFile> layer_files(const LayeredImage& image, int bits);

/// What layers.json says of them, all but the pixels.
[[nodiscard]] std::string manifest_of(const LayeredImage& image, const std::vector<LayerFile>& files,
                                      const std::vector<std::string>& file_names);

} // namespace estampe::output
