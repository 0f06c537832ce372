// SPDX-License-Identifier: MIT
#include <estampe/layers.hpp>

#include "output/layer_files.hpp"
#include "output/save_as.hpp"

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
