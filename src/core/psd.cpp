// SPDX-License-Identifier: MIT
#include "core/psd.hpp"

#include <algorithm>
#include <vector>

#include "core/new_image.hpp"

namespace estampe {
namespace {

struct Head {
    uint64_t channels = 0;
    uint64_t width = 0;
    uint64_t height = 0;
    uint64_t sample_bytes = 1;
    uint64_t data_at = 0;
};

Head read_head(const PictureBytes& bytes)
{
    constexpr uint32_t rgb = 3;
    const uint32_t depth = bytes.big16(22);
    Head head{.channels = bytes.big16(12),
              .width = bytes.big32(18),
              .height = bytes.big32(14),
              .sample_bytes = depth / 8,
              .data_at = 26};
    if (bytes.big16(4) != 1 || bytes.big16(24) != rgb || (depth != 8 && depth != 16) || head.channels < 3)
        bytes.refuse("is not RGB with 8 or 16 bits per channel");
    for (int section = 0; section < 3; ++section)
        head.data_at += 4 + uint64_t{bytes.big32(head.data_at)};
    return head;
}

/// Unpacks runs of one row of one channel; what is missing stays zero.
void unpack_row(const PictureBytes& bytes, uint64_t at, uint64_t packed, std::vector<uint8_t>& row)
{
    size_t filled = 0;
    const uint64_t end = at + packed;
    while (at < end && filled < row.size()) {
        const uint32_t code = bytes.byte(at++);
        const size_t wanted = code < 128 ? code + 1 : code > 128 ? 257 - code : 0;
        const size_t count = std::min(wanted, row.size() - filled);
        if (code < 128) {
            for (size_t i = 0; i < count; ++i)
                row[filled + i] = static_cast<uint8_t>(bytes.byte(at + i));
            at += wanted;
        } else if (wanted > 0) {
            std::fill_n(row.begin() + static_cast<std::ptrdiff_t>(filled), count,
                        static_cast<uint8_t>(bytes.byte(at++)));
        }
        filled += count;
    }
    if (filled < row.size())
        bytes.refuse("is corrupt: a row is too short");
}

/// Photoshop has laid what is clear over white.
void take_white_away(Image& image)
{
    for (size_t i = 0; i < image.rgba.size(); i += 4) {
        const int alpha = image.rgba[i + 3];
        for (size_t channel = i; alpha > 0 && alpha < 255 && channel < i + 3; ++channel)
            image.rgba[channel] =
                static_cast<uint8_t>(std::clamp(255 - (255 - image.rgba[channel]) * 255 / alpha, 0, 255));
    }
}

} // namespace

Image decode_psd(const PictureBytes& bytes, const std::string& name)
{
    const Head head = read_head(bytes);
    check_image_size(head.width, head.height, name);
    const uint64_t row_bytes = head.width * head.sample_bytes;
    const uint64_t rows = head.channels * head.height;
    const uint32_t compression = bytes.big16(head.data_at);
    if (compression > 1)
        bytes.refuse("is packed in a way that is not read");
    const uint64_t table_at = head.data_at + 2;
    uint64_t at = table_at + (compression == 1 ? 2 * rows : 0);
    bytes.need(table_at, compression == 1 ? 2 * rows : rows * row_bytes);
    Image image = new_image(head.width, head.height, name);
    std::vector<uint8_t> row(row_bytes);
    for (uint64_t index = 0; index < std::min<uint64_t>(head.channels, 4) * head.height; ++index) {
        const uint64_t packed = compression == 1 ? bytes.big16(table_at + 2 * index) : row_bytes;
        bytes.need(at, packed);
        if (compression == 1)
            unpack_row(bytes, at, packed, row);
        else
            std::transform(bytes.at(at), bytes.at(at) + static_cast<std::ptrdiff_t>(row_bytes), row.begin(),
                           [](std::byte value) { return static_cast<uint8_t>(value); });
        at += packed;
        uint8_t* const first =
            image.rgba.data() + 4 * head.width * (index % head.height) + index / head.height;
        for (uint64_t x = 0; x < head.width; ++x)
            first[4 * x] = row[x * head.sample_bytes];
    }
    if (head.channels > 3)
        take_white_away(image);
    else
        for (size_t i = 3; i < image.rgba.size(); i += 4)
            image.rgba[i] = 255;
    return image;
}

} // namespace estampe
