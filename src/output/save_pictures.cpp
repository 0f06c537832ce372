// SPDX-License-Identifier: MIT
#include <estampe/image.hpp>
#include <estampe/linear_image.hpp>

#include "output/pictures.hpp"
#include "output/save_as.hpp"

namespace estampe {

void save_jpeg(const Image& image, const std::filesystem::path& path, int quality)
{
    output::save_as(path, [&] { return output::encode_jpeg(image, quality); });
}

void save_webp(const Image& image, const std::filesystem::path& path, std::optional<int> quality)
{
    output::save_as(path, [&] { return output::encode_webp(image, quality); });
}

void save_png(const LinearImage& image, const std::filesystem::path& path)
{
    output::save_as(path, [&] { return output::encode_deep_png(image); });
}

void save_exr(const LinearImage& image, const std::filesystem::path& path, ExrNumbers numbers)
{
    output::save_as(path, [&] { return output::encode_picture_exr(image, numbers); });
}

} // namespace estampe
