// SPDX-License-Identifier: MIT
// Reads and writes DDS files of uncompressed images. No library in Debian reads and writes DDS arrays with
// custom mip levels, and the required part of the format is small.
#include "techniques/tam/files/map_files.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <optional>
#include <utility>

#include <estampe/error.hpp>
#include <fmt/format.h>

namespace estampe::tam {
namespace {

constexpr size_t header_bytes = 128; ///< size of the header, including the four letters of the file type
constexpr size_t dx10_bytes = 20;

// Positions of the 32-bit words of the header, in bytes from the start of the file.
namespace at {
constexpr size_t magic = 0;
constexpr size_t size = 4;
constexpr size_t flags = 8;
constexpr size_t height = 12;
constexpr size_t width = 16;
constexpr size_t pitch = 20;
constexpr size_t depth = 24;
constexpr size_t levels = 28;
constexpr size_t format_size = 76;
constexpr size_t format_flags = 80;
constexpr size_t format_letters = 84;
constexpr size_t format_bits = 88;
constexpr size_t masks = 92; ///< position of the first of four masks: red, green, blue, alpha
constexpr size_t caps = 108;
constexpr size_t caps2 = 112;
constexpr size_t dxgi_format = 128;
constexpr size_t dimension = 132;
constexpr size_t array_size = 140;
} // namespace at

constexpr uint32_t magic_letters = 0x20534444; // the letters "DDS "
constexpr uint32_t dx10_letters = 0x30315844;  // the letters "DX10"
constexpr uint32_t has_letters = 0x4;          // flag DDPF_FOURCC: the pixel format is named by four letters
constexpr uint32_t has_alpha = 0x1;            // flag DDPF_ALPHAPIXELS: pixels have colour and alpha
constexpr uint32_t only_alpha = 0x2;           // flag DDPF_ALPHA: pixels have only alpha
constexpr uint32_t volume = 0x200000;          // flag DDSCAPS2_VOLUME: the file is a volume texture
constexpr uint32_t dimension_2d = 3;           // value D3D10_RESOURCE_DIMENSION_TEXTURE2D
constexpr uint32_t r8_unorm = 61;
constexpr uint32_t max_layers = max_tones;

/// Describes how the bytes of a texel are converted to brightness (0 to 255) and opacity.
struct Layout {
    uint32_t bytes = 1;
    std::array<uint32_t, 3> channel{0, 0, 0}; ///< positions in the texel of the bytes for red, green and blue
    std::optional<uint32_t> alpha;
    bool is_coverage = false; ///< the byte is coverage by ink (255 is black), not brightness
};

class DdsReader {
public:
    DdsReader(std::span<const std::byte> bytes, std::string name) : bytes_(bytes), name_(std::move(name))
    {
        if (bytes.size() < header_bytes || word(at::magic) != magic_letters || word(at::size) != 124 ||
            word(at::format_size) != 32) {
            throw Error("is not a DDS file, or a truncated one", name_);
        }
        extended_ = (word(at::format_flags) & has_letters) != 0 && word(at::format_letters) == dx10_letters;
        if (extended_ && bytes.size() < header_bytes + dx10_bytes) {
            throw Error("is a truncated DDS file", name_);
        }
        layout_ = extended_ ? dx10_layout() : masked_layout();
    }

    [[nodiscard]] DdsImages read()
    {
        DdsImages images;
        images.size_px = word(at::width);
        if (images.size_px != word(at::height) || !std::has_single_bit(images.size_px) ||
            images.size_px > max_size_px) {
            throw Error(fmt::format("is {} x {} pixels", images.size_px, word(at::height)), name_,
                        fmt::format("a map is square, its side a power of two up to {}", max_size_px));
        }
        const bool is_volume = !extended_ && (word(at::caps2) & volume) != 0;
        const uint32_t layers = is_volume ? word(at::depth) : (extended_ ? word(at::array_size) : 1U);
        const auto most_levels = static_cast<uint32_t>(level_count(images.size_px));
        const uint32_t levels = std::max(1U, word(at::levels));
        if (layers < 1 || layers > max_layers || levels > most_levels) {
            throw Error(fmt::format("has {} layers of {} levels", layers, levels), name_,
                        fmt::format("at most {} layers of {} levels can be read", max_layers, most_levels));
        }
        size_t place = header_bytes + (extended_ ? dx10_bytes : 0);
        if (is_volume) {
            images.level_of_layer = volume_levels({images.size_px, layers, levels}, place);
            return images;
        }
        for (uint32_t layer = 0; layer < layers; ++layer) {
            std::vector<Gray8>& chain = images.level_of_layer.emplace_back();
            for (uint32_t level = 0; level < levels; ++level) {
                chain.push_back(image(images.size_px >> level, place));
            }
        }
        return images;
    }

private:
    [[nodiscard]] uint32_t word(size_t place) const
    {
        uint32_t value = 0;
        for (size_t i = 0; i < 4; ++i) {
            value |= std::to_integer<uint32_t>(bytes_[place + i]) << (8 * i);
        }
        return value;
    }

    [[noreturn]] void refuse_format() const
    {
        throw Error("is a DDS file in a format that cannot be read", name_,
                    "save it uncompressed: 8-bit luminance, R8, RGB8 or RGBA8");
    }

    /// Position in the texel of the byte that `mask` selects. Returns `otherwise` if the mask is empty.
    [[nodiscard]] uint32_t byte_of(uint32_t mask, uint32_t bytes, uint32_t otherwise) const
    {
        if (mask == 0) {
            return otherwise;
        }
        for (uint32_t place = 0; place < bytes; ++place) {
            if (mask == 0xFFU << (8 * place)) {
                return place;
            }
        }
        refuse_format();
    }

    [[nodiscard]] Layout masked_layout() const
    {
        const uint32_t bits = word(at::format_bits);
        const uint32_t flags = word(at::format_flags);
        if ((flags & has_letters) != 0 || (bits != 8 && bits != 16 && bits != 24 && bits != 32)) {
            refuse_format();
        }
        Layout layout{.bytes = bits / 8};
        if ((flags & only_alpha) != 0) {
            layout.is_coverage = true;
            return layout;
        }
        const uint32_t red = byte_of(word(at::masks), layout.bytes, 0);
        layout.channel = {red, byte_of(word(at::masks + 4), layout.bytes, red),
                          byte_of(word(at::masks + 8), layout.bytes, red)};
        if ((flags & has_alpha) != 0) {
            layout.alpha = byte_of(word(at::masks + 12), layout.bytes, layout.bytes - 1);
        }
        return layout;
    }

    [[nodiscard]] Layout dx10_layout() const
    {
        if (word(at::dimension) != dimension_2d) {
            refuse_format();
        }
        switch (word(at::dxgi_format)) {
        case r8_unorm:
            return {};
        case 28: // DXGI format R8G8B8A8_UNORM
        case 29: // DXGI format R8G8B8A8_UNORM_SRGB
            return {.bytes = 4, .channel = {0, 1, 2}, .alpha = 3U};
        case 87: // DXGI format B8G8R8A8_UNORM
        case 91: // DXGI format B8G8R8A8_UNORM_SRGB
            return {.bytes = 4, .channel = {2, 1, 0}, .alpha = 3U};
        case 65: // A8_UNORM
            return {.is_coverage = true};
        default:
            refuse_format();
        }
    }

    [[nodiscard]] Gray8 image(uint32_t size_px, size_t& place) const
    {
        const size_t texels = size_t{size_px} * size_px;
        if (bytes_.size() - place < texels * layout_.bytes) {
            throw Error("is a truncated DDS file", name_);
        }
        Gray8 coverage(texels);
        for (uint8_t& texel : coverage) {
            texel = coverage_at(bytes_.subspan(place, layout_.bytes));
            place += layout_.bytes;
        }
        return coverage;
    }

    struct VolumeSize {
        uint32_t size_px = 0;
        uint32_t slices = 0;
        uint32_t levels = 0;
    };

    /// Reads the mip levels of a volume, one tone per slice of level 0. A coarser level has half as many
    /// slices as the next finer level. So each tone of a coarser level is blended from the two slices nearest
    /// in darkness. Levels with a single slice are not read, because all tones would look equal.
    [[nodiscard]] std::vector<std::vector<Gray8>> volume_levels(const VolumeSize& size, size_t place) const
    {
        std::vector<std::vector<Gray8>> level_of_tone(size.slices);
        std::vector<double> darkness;
        for (uint32_t level = 0; level < size.levels && (level == 0 || size.slices >> level > 1); ++level) {
            std::vector<Gray8> slices;
            for (uint32_t slice = 0; slice < size.slices >> level; ++slice) {
                slices.push_back(image(size.size_px >> level, place));
            }
            for (uint32_t tone = 0; tone < size.slices; ++tone) {
                if (level == 0) {
                    darkness.push_back(mean_coverage(slices[tone]));
                }
                level_of_tone[tone].push_back(level == 0 ? slices[tone] : blended(slices, darkness[tone]));
            }
        }
        return level_of_tone;
    }

    /// Blends the slice that is next lighter and the slice that is next darker, so that the mean of the
    /// result is `darkness`. Blank paper counts as the slice before the first slice. A tone that is darker
    /// than the last slice is a copy of the last slice.
    [[nodiscard]] static Gray8 blended(const std::vector<Gray8>& slices, double darkness)
    {
        Gray8 lighter(slices.front().size(), 0);
        double darkness_of_lighter = 0.0;
        for (const Gray8& darker : slices) {
            const double darkness_of_darker = mean_coverage(darker);
            if (darkness_of_darker > darkness_of_lighter && darkness < darkness_of_darker) {
                const double share =
                    (darkness - darkness_of_lighter) / (darkness_of_darker - darkness_of_lighter);
                std::ranges::transform(lighter, darker, lighter.begin(), [&](uint8_t before, uint8_t after) {
                    return static_cast<uint8_t>(std::lround(std::lerp(before, after, share)));
                });
                return lighter;
            }
            lighter = darker;
            darkness_of_lighter = darkness_of_darker;
        }
        return lighter;
    }

    [[nodiscard]] uint8_t coverage_at(std::span<const std::byte> texel) const
    {
        const auto channel = [&](size_t i) { return std::to_integer<uint32_t>(texel[layout_.channel[i]]); };
        if (layout_.is_coverage) {
            return std::to_integer<uint8_t>(texel[0]);
        }
        const uint32_t light = (2 * channel(0) + 5 * channel(1) + channel(2)) / 8;
        const uint32_t shown = layout_.alpha ? std::to_integer<uint32_t>(texel[*layout_.alpha]) : 255U;
        return static_cast<uint8_t>(((255 - light) * shown + 127) / 255);
    }

    std::span<const std::byte> bytes_;
    std::string name_;
    bool extended_ = false;
    Layout layout_;
};

} // namespace

DdsImages decode_dds(std::span<const std::byte> bytes, const std::string& name)
{
    return DdsReader(bytes, name).read();
}

std::vector<std::byte> encode_dds(const TonalArtMap& map)
{
    check_map(map, {});
    // DDS header flags for the header fields that are set: capabilities, height, width, pitch, pixel format,
    // mip count.
    constexpr uint32_t flags = 0x1 | 0x2 | 0x4 | 0x8 | 0x1000 | 0x20000;
    constexpr uint32_t caps = 0x8 | 0x1000 | 0x400000; // capabilities: complex, texture, mipmap
    std::vector<std::byte> bytes(header_bytes + dx10_bytes);
    const auto put = [&](size_t place, uint32_t value) {
        for (size_t i = 0; i < 4; ++i) {
            bytes[place + i] = static_cast<std::byte>(value >> (8 * i) & 0xFFU);
        }
    };
    put(at::magic, magic_letters);
    put(at::size, 124);
    put(at::flags, flags);
    put(at::height, map.size_px);
    put(at::width, map.size_px);
    put(at::pitch, map.size_px);
    put(at::depth, 1);
    put(at::levels, static_cast<uint32_t>(level_count(map.size_px)));
    put(at::format_size, 32);
    put(at::format_flags, has_letters);
    put(at::format_letters, dx10_letters);
    put(at::caps, caps);
    put(at::dxgi_format, r8_unorm);
    put(at::dimension, dimension_2d);
    put(at::array_size, static_cast<uint32_t>(map.darkness.size()));
    for (const std::vector<Gray8>& levels : map.level_of_tone) {
        for (const Gray8& level : levels) {
            std::transform(level.begin(), level.end(), std::back_inserter(bytes),
                           [](uint8_t ink) { return static_cast<std::byte>(255 - ink); });
        }
    }
    return bytes;
}

} // namespace estampe::tam
