// SPDX-License-Identifier: MIT
#include <estampe/image.hpp>

#include <estampe/error.hpp>

#include "core/file.hpp"
#include "core/image_codec.hpp"

namespace estampe {

void save_png(const Image& image, const std::filesystem::path& path)
{
    std::vector<std::byte> bytes;
    try {
        bytes = encode_png(image);
    } catch (const Error& error) {
        throw Error(error.what(), path.string());
    }
    write_file_atomically(path, bytes);
}

Image load_image(const std::filesystem::path& path)
{
    constexpr uint64_t max_file_bytes = uint64_t{1} << 31;
    return decode_image(read_file(path, max_file_bytes), path.string());
}

} // namespace estampe
