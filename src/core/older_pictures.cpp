// SPDX-License-Identifier: MIT
// Older picture formats that FBX, DAE and OBJ files often use for textures: TGA, BMP, GIF and PSD.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include <estampe/error.hpp>
#include <estampe/image.hpp>

#include "core/image_formats.hpp"

namespace estampe {
namespace {

/// Bounds-checked access to the bytes of a file.
class PictureBytes {
public:
    PictureBytes(std::span<const std::byte> data, const char* format, const std::string& name)
        : data_(data), format_(format), name_(name)
    {
    }

    [[nodiscard]] size_t size() const { return data_.size(); }

    /// Returns the bytes from `place` on; need() checks that they exist.
    [[nodiscard]] const std::byte* at(size_t place) const { return data_.data() + place; }

    [[nodiscard]] uint32_t byte(size_t at) const
    {
        need(at, 1);
        return static_cast<uint32_t>(data_[at]);
    }

    [[nodiscard]] uint32_t little16(size_t at) const { return byte(at) | byte(at + 1) << 8U; }

    [[nodiscard]] uint32_t little32(size_t at) const { return little16(at) | little16(at + 2) << 16U; }

    [[nodiscard]] uint32_t big16(size_t at) const { return byte(at) << 8U | byte(at + 1); }

    [[nodiscard]] uint32_t big32(size_t at) const { return big16(at) << 16U | big16(at + 2); }

    void need(uint64_t at, uint64_t count) const
    {
        if (at > data_.size() || count > data_.size() - at)
            throw Error(fmt::format("corrupt {}: the data ends too early", format_), name_);
    }

    [[noreturn]] void refuse(const std::string& why) const
    {
        throw Error(fmt::format("{} {}", format_, why), name_);
    }

private:
    std::span<const std::byte> data_;
    const char* format_;
    const std::string& name_;
};

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

/// Unpacks one row of one channel of a PSD file, which is stored as runs of equal bytes; missing pixels stay
/// zero.
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

/// Removes white from the colours of transparent pixels, because Photoshop has composited these pixels onto
/// white.
void take_white_away(Image& image)
{
    for (size_t i = 0; i < image.rgba.size(); i += 4) {
        const int alpha = image.rgba[i + 3];
        for (size_t channel = i; alpha > 0 && alpha < 255 && channel < i + 3; ++channel)
            image.rgba[channel] =
                static_cast<uint8_t>(std::clamp(255 - (255 - image.rgba[channel]) * 255 / alpha, 0, 255));
    }
}

/// Decodes the flattened picture of a PSD file: RGB with 8 or 16 bits per channel, and alpha as the fourth
/// channel. Throws Error with `name` as its place if the data is damaged or of another kind.
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

} // namespace
} // namespace estampe

#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_ONLY_TGA
#define STBI_ONLY_BMP
#define STBI_ONLY_GIF
#define STBI_NO_STDIO
#define STBI_NO_LINEAR
#define STBI_NO_HDR
#define STBI_MAX_DIMENSIONS 16384
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#include <stb/stb_image.h>
#pragma GCC diagnostic pop

namespace estampe {
namespace {

static_assert(STBI_MAX_DIMENSIONS == max_image_side);

bool starts_with(std::span<const std::byte> data, std::string_view magic)
{
    return data.size() >= magic.size() && std::memcmp(data.data(), magic.data(), magic.size()) == 0;
}

struct TgaHead {
    static constexpr size_t bytes = 18;
    uint32_t map_type = 0;
    /// Picture type of a TGA file: 1 colour-mapped, 2 true-colour, 3 grey; plus 8 if run-length encoded.
    uint32_t kind = 0;
    uint32_t map_first = 0;
    uint32_t map_entries = 0;
    uint32_t map_bits = 0;
    uint32_t width = 0;
    uint32_t height = 0;
    uint32_t bits = 0;
    uint32_t descriptor = 0;

    [[nodiscard]] uint32_t kind_without_runs() const { return kind & 7U; }

    [[nodiscard]] bool has_runs() const { return (kind & 8U) != 0; }
};

TgaHead tga_head(const PictureBytes& bytes)
{
    return {.map_type = bytes.byte(1),
            .kind = bytes.byte(2),
            .map_first = bytes.little16(3),
            .map_entries = bytes.little16(5),
            .map_bits = bytes.byte(7),
            .width = bytes.little16(12),
            .height = bytes.little16(14),
            .bits = bytes.byte(16),
            .descriptor = bytes.byte(17)};
}

bool is_color_depth(uint32_t bits)
{
    return bits == 15 || bits == 16 || bits == 24 || bits == 32;
}

bool is_tga(std::span<const std::byte> data, const std::string& name)
{
    if (data.size() < TgaHead::bytes)
        return false;
    const TgaHead head = tga_head(PictureBytes(data, "TGA", name));
    const uint32_t kind = head.kind_without_runs();
    if ((head.kind & ~8U) != kind || kind < 1 || kind > 3 || head.width == 0 || head.height == 0 ||
        (head.descriptor & 0xc0U) != 0)
        return false;
    if (kind == 1)
        return head.map_type == 1 && head.map_entries > 0 && is_color_depth(head.map_bits) &&
               (head.bits == 8 || head.bits == 16);
    return head.map_type <= 1 && (kind == 2 ? is_color_depth(head.bits) : head.bits == 8 || head.bits == 16);
}

void check_tga(const PictureBytes& bytes)
{
    const TgaHead head = tga_head(bytes);
    if (head.kind_without_runs() == 1 && head.map_first != 0)
        bytes.refuse("has a colour map that does not begin at entry 0");
    const uint64_t map_bytes =
        head.map_type == 1 ? uint64_t{head.map_entries} * ((head.map_bits + 7) / 8) : 0;
    uint64_t at = TgaHead::bytes + bytes.byte(0) + map_bytes;
    const uint64_t each = (head.bits + 7) / 8;
    uint64_t left = uint64_t{head.width} * head.height;
    if (!head.has_runs()) {
        bytes.need(at, left * each);
        return;
    }
    while (left > 0) {
        const uint32_t packet = bytes.byte(at);
        const uint64_t count = 1 + (packet & 0x7fU);
        const uint64_t size = 1 + ((packet & 0x80U) != 0 ? each : count * each);
        bytes.need(at, size);
        at += size;
        left -= std::min(left, count);
    }
}

/// Corrects a TGA picture where stb_image ignores its header: an unused fourth byte, often zero, is no alpha,
/// and rows may run from right to left.
void finish_tga(const PictureBytes& bytes, Image& image)
{
    constexpr uint32_t right_to_left = 0x10;
    constexpr uint32_t alpha_bits = 0x0f;
    const TgaHead head = tga_head(bytes);
    bool is_clear = (head.descriptor & alpha_bits) == 0;
    for (size_t i = 3; is_clear && i < image.rgba.size(); i += 4)
        is_clear = image.rgba[i] == 0;
    for (size_t i = 3; is_clear && i < image.rgba.size(); i += 4)
        image.rgba[i] = 255;
    if ((head.descriptor & right_to_left) == 0)
        return;
    for (uint32_t y = 0; y < image.height; ++y)
        for (uint32_t x = 0; x < image.width / 2; ++x)
            for (size_t channel = 0; channel < 4; ++channel)
                std::swap(image.rgba[4 * (size_t{y} * image.width + x) + channel],
                          image.rgba[4 * (size_t{y} * image.width + image.width - 1 - x) + channel]);
}

void check_bmp(const PictureBytes& bytes)
{
    const uint64_t pixels_at = bytes.little32(10);
    const uint32_t head = bytes.little32(14);
    const bool is_old = head == 12;
    const uint64_t width = is_old ? bytes.little16(18) : bytes.little32(18);
    const auto rows = static_cast<int32_t>(is_old ? bytes.little16(20) : bytes.little32(22));
    const auto height = static_cast<uint64_t>(std::abs(int64_t{rows}));
    const uint64_t bits = is_old ? bytes.little16(24) : bytes.little16(28);
    const uint32_t compression = is_old ? 0 : bytes.little32(30);
    if (compression == 1 || compression == 2)
        bytes.refuse("has run-length encoded pixels, which are not read");
    if (compression != 0 && compression != 3)
        bytes.refuse("holds another format, which is not read");
    if (width > max_image_side || height > max_image_side)
        return; // The decoder rejects larger sizes with a better message
    bytes.need(pixels_at, (width * bits + 31) / 32 * 4 * height);
}

/// Checks that the bytes of a GIF are complete up to the end of its first picture.
void check_gif(const PictureBytes& bytes)
{
    const auto table_bytes = [](uint32_t flags) -> uint64_t {
        return (flags & 0x80U) != 0 ? uint64_t{3} << ((flags & 7U) + 1) : 0;
    };
    const auto skip_blocks = [&bytes](uint64_t at) {
        while (const uint32_t size = bytes.byte(at))
            at += 1 + size;
        return at + 1;
    };
    uint64_t at = 13 + table_bytes(bytes.byte(10));
    while (bytes.byte(at) == 0x21)
        at = skip_blocks(at + 2);
    if (bytes.byte(at) != 0x2c)
        bytes.refuse("has no picture");
    constexpr uint64_t best_lzw_ratio = 2800;
    if (uint64_t{bytes.little16(6)} * bytes.little16(8) > 64 * best_lzw_ratio * bytes.size())
        bytes.refuse("is corrupt: so many pixels cannot come from so few bytes");
    (void)skip_blocks(at + 10 + table_bytes(bytes.byte(at + 9)) + 1);
}

struct StbFree {
    void operator()(stbi_uc* pixels) const { stbi_image_free(pixels); }
};

Image decode_with_stb(std::span<const std::byte> data, const char* format, const std::string& name)
{
    const auto* const first = reinterpret_cast<const stbi_uc*>(data.data());
    const int size = static_cast<int>(data.size());
    int width = 0;
    int height = 0;
    int channels = 0;
    if (stbi_info_from_memory(first, size, &width, &height, &channels) == 0)
        throw Error(fmt::format("{} cannot be read: {}", format, stbi_failure_reason()), name);
    height = std::abs(height); // A BMP with rows from top to bottom has a negative height
    Image image = new_image(static_cast<uint64_t>(width), static_cast<uint64_t>(height), name);
    // Memory of the GIF decoder per pixel: the picture, the background, and flags.
    constexpr uint64_t bytes_of_decoder = 9;
    require_memory(bytes_of_decoder * image.width * image.height, fmt::format("decoding a {}", format), name);
    const std::unique_ptr<stbi_uc, StbFree> pixels(
        stbi_load_from_memory(first, size, &width, &height, &channels, 4));
    if (pixels == nullptr || static_cast<uint32_t>(width) != image.width ||
        static_cast<uint32_t>(height) != image.height)
        throw Error(fmt::format("{} cannot be read: {}", format,
                                pixels == nullptr ? stbi_failure_reason() : "two sizes"),
                    name);
    std::memcpy(image.rgba.data(), pixels.get(), image.rgba.size());
    return image;
}

} // namespace

std::optional<Image> decode_older_picture(std::span<const std::byte> data, const std::string& name)
{
    // Largest file for stb_image, which counts bytes with an int.
    constexpr size_t most_bytes = size_t{1} << 30;
    const bool is_gif = starts_with(data, "GIF87a") || starts_with(data, "GIF89a");
    const bool is_bmp = starts_with(data, "BM");
    const bool is_psd = starts_with(data, "8BPS");
    if (!is_gif && !is_bmp && !is_psd && !is_tga(data, name))
        return std::nullopt;
    const char* const format = is_gif ? "GIF" : is_bmp ? "BMP" : is_psd ? "PSD" : "TGA";
    const PictureBytes bytes(data, format, name);
    if (data.size() > most_bytes)
        bytes.refuse("is longer than 1 GiB");
    if (is_gif)
        check_gif(bytes);
    else if (is_bmp)
        check_bmp(bytes);
    else if (is_psd)
        return decode_psd(bytes, name);
    else
        check_tga(bytes);
    Image image = decode_with_stb(data, format, name);
    if (!is_gif && !is_bmp)
        finish_tga(bytes, image);
    return image;
}

} // namespace estampe
