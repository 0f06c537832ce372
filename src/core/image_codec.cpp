// SPDX-License-Identifier: MIT
#include "core/image_codec.hpp"

#include <algorithm>
#include <bit>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <new>

#include <fmt/format.h>
#include <jpeglib.h>
#include <lcms2.h>
#include <png.h>
#include <webp/decode.h>

#include <estampe/error.hpp>
#include <estampe/image.hpp>

#include "core/child/child.hpp"
#include "core/file.hpp"
#include "core/image_formats.hpp"

namespace estampe {
namespace {

struct CloseProfile {
    void operator()(void* profile) const { cmsCloseProfile(profile); }
};

struct DeleteTransform {
    void operator()(void* transform) const { cmsDeleteTransform(transform); }
};

using ColorProfile = std::unique_ptr<void, CloseProfile>;
using ColorTransform = std::unique_ptr<void, DeleteTransform>;

/// Makes the conversion from an ICC profile to sRGB; null if the profile is damaged or not for CMYK.
ColorTransform transform_of(std::span<const std::byte> bytes, bool inverted)
{
    if (bytes.empty())
        return nullptr;
    const ColorProfile profile(
        cmsOpenProfileFromMem(bytes.data(), static_cast<cmsUInt32Number>(bytes.size())));
    if (profile == nullptr || cmsGetColorSpace(profile.get()) != cmsSigCmykData)
        return nullptr;
    const ColorProfile srgb(cmsCreate_sRGBProfile());
    return ColorTransform(cmsCreateTransform(profile.get(), inverted ? TYPE_CMYK_8_REV : TYPE_CMYK_8,
                                             srgb.get(), TYPE_RGBA_8, INTENT_RELATIVE_COLORIMETRIC,
                                             cmsFLAGS_BLACKPOINTCOMPENSATION));
}

} // namespace

void inks_to_rgb(std::span<uint8_t> pixels, bool inverted, std::span<const std::byte> profile)
{
    const ColorTransform transform = transform_of(profile, inverted);
    if (transform != nullptr)
        cmsDoTransform(transform.get(), pixels.data(), pixels.data(),
                       static_cast<cmsUInt32Number>(pixels.size() / 4));
    for (size_t i = 0; i + 3 < pixels.size(); i += 4) {
        const uint32_t flip = inverted ? 0U : 255U;
        const uint32_t black = pixels[i + 3] ^ flip;
        for (size_t channel = i; transform == nullptr && channel < i + 3; ++channel)
            pixels[channel] = static_cast<uint8_t>(((pixels[channel] ^ flip) * black + 127) / 255);
        pixels[i + 3] = 255;
    }
}

namespace {

struct PngSource {
    std::span<const std::byte> data;
    size_t position = 0;
};

struct PngReader {
    png_structp png = nullptr;
    png_infop info = nullptr;
    CodecFailure failure;
    PngSource source;
    std::vector<png_bytep> rows;

    ~PngReader() { png_destroy_read_struct(&png, &info, nullptr); }
};

void png_take(png_structp png, png_bytep target, png_size_t count)
{
    auto* source = static_cast<PngSource*>(png_get_io_ptr(png));
    if (count > source->data.size() - source->position) {
        png_error(png, "the data ends too early");
    }
    std::memcpy(target, source->data.data() + source->position, count);
    source->position += count;
}

bool read_png_header(PngReader& reader)
{
    if (setjmp(reader.failure.jump) != 0) {
        return false;
    }
    // libpng's own size limits are removed, because check_image_size() checks this program's limits.
    png_set_user_limits(reader.png, PNG_UINT_31_MAX, PNG_UINT_31_MAX);
    png_set_chunk_malloc_max(reader.png, png_alloc_size_t{1} << 24);
    png_set_crc_action(reader.png, PNG_CRC_ERROR_QUIT, PNG_CRC_QUIET_USE);
    png_set_read_fn(reader.png, &reader.source, png_take);
    png_read_info(reader.png, reader.info);
    return true;
}

/// Tells libpng to convert all pictures to RGBA. libpng allocates a row here.
bool ask_for_rgba(PngReader& reader, bool is_deep)
{
    if (setjmp(reader.failure.jump) != 0) {
        return false;
    }
    png_set_expand(reader.png);
    if (!is_deep) {
        png_set_scale_16(reader.png);
    } else if (std::endian::native == std::endian::little) {
        png_set_swap(reader.png);
    }
    png_set_gray_to_rgb(reader.png);
    png_set_add_alpha(reader.png, 0xFFFF, PNG_FILLER_AFTER);
    png_set_interlace_handling(reader.png);
    png_read_update_info(reader.png, reader.info);
    return true;
}

bool read_png_pixels(PngReader& reader)
{
    if (setjmp(reader.failure.jump) != 0) {
        return false;
    }
    png_read_image(reader.png, reader.rows.data());
    return true;
}

/// Reads the pixels of a PNG. `Picture` has 8 bits per channel, or 16 for 16-bit data.
template <class Picture>
Picture decode_png(std::span<const std::byte> data, const std::string& name)
{
    using Value = typename decltype(Picture::rgba)::value_type;
    PngReader reader;
    reader.source.data = data;
    reader.png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &reader.failure, png_failed, png_warned);
    reader.info = reader.png == nullptr ? nullptr : png_create_info_struct(reader.png);
    if (reader.info == nullptr) {
        throw std::bad_alloc();
    }
    if (!read_png_header(reader)) {
        throw Error(fmt::format("corrupt PNG: {}", reader.failure.message), name);
    }
    const uint64_t width = png_get_image_width(reader.png, reader.info);
    const uint64_t height = png_get_image_height(reader.png, reader.info);
    check_image_size(width, height, name);
    if (!ask_for_rgba(reader, sizeof(Value) == 2)) {
        throw Error(fmt::format("corrupt PNG: {}", reader.failure.message), name);
    }
    const uint64_t bits = uint64_t{png_get_channels(reader.png, reader.info)} * 8 * sizeof(Value);
    constexpr uint64_t best_deflate_ratio = 1040;
    if (width * height * bits / 8 > 64 * best_deflate_ratio * data.size()) {
        throw Error(
            fmt::format("corrupt PNG: {} x {} pixels cannot come from {} bytes", width, height, data.size()),
            name);
    }
    auto image = new_image<Picture>(width, height, name);
    for (uint64_t row = 0; row < height; ++row) {
        reader.rows.push_back(reinterpret_cast<png_bytep>(image.rgba.data() + row * width * 4));
    }
    if (!read_png_pixels(reader)) {
        throw Error(fmt::format("corrupt PNG: {}", reader.failure.message), name);
    }
    return image;
}

struct JpegReader {
    jpeg_decompress_struct jpeg{};
    jpeg_error_mgr errors{};
    jpeg_progress_mgr progress{};
    CodecFailure failure;

    ~JpegReader() { jpeg_destroy_decompress(&jpeg); }
};

[[noreturn]] void jpeg_failed(j_common_ptr jpeg)
{
    auto* failure = static_cast<CodecFailure*>(jpeg->client_data);
    char message[JMSG_LENGTH_MAX] = {};
    jpeg->err->format_message(jpeg, message);
    std::snprintf(failure->message, sizeof failure->message, "%s", message);
    std::longjmp(failure->jump, 1);
}

/// Handles a message of libjpeg. A negative level is a warning of corrupt or truncated data, for which
/// libjpeg would paint grey.
void jpeg_warned(j_common_ptr jpeg, int level)
{
    if (level < 0) {
        jpeg_failed(jpeg);
    }
}

/// Limits the number of scans in a progressive JPEG, because each scan processes all pixels.
void jpeg_progressed(j_common_ptr jpeg)
{
    constexpr int max_scans = 200;
    if (jpeg->is_decompressor && reinterpret_cast<j_decompress_ptr>(jpeg)->input_scan_number > max_scans) {
        auto* failure = static_cast<CodecFailure*>(jpeg->client_data);
        std::snprintf(failure->message, sizeof failure->message, "more than %d scans", max_scans);
        std::longjmp(failure->jump, 1);
    }
}

/// Returns whether the JPEG stores printing inks: CMYK, or YCCK (black, and the other inks as YCbCr).
bool holds_inks(const jpeg_decompress_struct& jpeg)
{
    return jpeg.jpeg_color_space == JCS_CMYK || jpeg.jpeg_color_space == JCS_YCCK;
}

bool read_jpeg_header(JpegReader& reader, std::span<const std::byte> data)
{
    if (setjmp(reader.failure.jump) != 0) {
        return false;
    }
    jpeg_create_decompress(&reader.jpeg);
    reader.jpeg.client_data = &reader.failure;
    reader.jpeg.progress = &reader.progress;
    reader.jpeg.mem->max_memory_to_use = 1L << 29;
    jpeg_mem_src(&reader.jpeg, reinterpret_cast<const unsigned char*>(data.data()), data.size());
    constexpr unsigned longest_marker = 0xffff;
    // Keeps the markers that hold colour profiles.
    jpeg_save_markers(&reader.jpeg, JPEG_APP0 + 2, longest_marker);
    jpeg_read_header(&reader.jpeg, TRUE);
    return true;
}

bool read_jpeg_pixels(JpegReader& reader, Image& image)
{
    if (setjmp(reader.failure.jump) != 0) {
        return false;
    }
    reader.jpeg.out_color_space = holds_inks(reader.jpeg) ? JCS_CMYK : JCS_EXT_RGBA;
    reader.jpeg.dct_method = JDCT_ISLOW;
    jpeg_start_decompress(&reader.jpeg);
    while (reader.jpeg.output_scanline < reader.jpeg.output_height) {
        JSAMPROW row = image.rgba.data() + size_t{reader.jpeg.output_scanline} * image.width * 4;
        jpeg_read_scanlines(&reader.jpeg, &row, 1);
    }
    jpeg_finish_decompress(&reader.jpeg);
    return true;
}

using JpegProfile = std::unique_ptr<JOCTET, decltype(&std::free)>;

/// Reads the colour profile of a JPEG. libjpeg allocates the memory of the profile.
bool read_jpeg_profile(JpegReader& reader, JOCTET** profile, unsigned* bytes)
{
    if (setjmp(reader.failure.jump) != 0) {
        return false;
    }
    return jpeg_read_icc_profile(&reader.jpeg, profile, bytes) != 0;
}

Image decode_jpeg(std::span<const std::byte> data, const std::string& name)
{
    JpegReader reader;
    reader.jpeg.err = jpeg_std_error(&reader.errors);
    reader.jpeg.client_data = &reader.failure;
    reader.errors.error_exit = jpeg_failed;
    reader.errors.emit_message = jpeg_warned;
    reader.progress.progress_monitor = jpeg_progressed;
    if (!read_jpeg_header(reader, data)) {
        throw Error(fmt::format("corrupt JPEG: {}", reader.failure.message), name);
    }
    Image image = new_image(reader.jpeg.image_width, reader.jpeg.image_height, name);
    const bool has_inks = holds_inks(reader.jpeg);
    JOCTET* found = nullptr;
    unsigned profile_bytes = 0;
    if (has_inks) { // The profile is read before the pixels, because libjpeg loses it afterwards
        (void)read_jpeg_profile(reader, &found, &profile_bytes);
    }
    const JpegProfile profile(found, std::free);
    if (!read_jpeg_pixels(reader, image)) {
        throw Error(fmt::format("corrupt JPEG: {}", reader.failure.message), name);
    }
    if (has_inks) {
        // Adobe's programs store inverted inks in a JPEG: the value 255 means no ink.
        const bool inverted = reader.jpeg.saw_Adobe_marker != 0;
        inks_to_rgb(image.rgba, inverted, std::as_bytes(std::span(profile.get(), profile_bytes)));
    }
    return image;
}

Image decode_webp(std::span<const std::byte> data, const std::string& name)
{
    const auto* bytes = reinterpret_cast<const uint8_t*>(data.data());
    int width = 0;
    int height = 0;
    if (WebPGetInfo(bytes, data.size(), &width, &height) == 0 || width <= 0 || height <= 0) {
        throw Error("corrupt WebP: bad header", name);
    }
    Image image = new_image(static_cast<uint64_t>(width), static_cast<uint64_t>(height), name);
    if (WebPDecodeRGBAInto(bytes, data.size(), image.rgba.data(), image.rgba.size(), width * 4) == nullptr) {
        throw Error("corrupt WebP: the data is damaged or ends too early", name);
    }
    return image;
}

bool starts_with(std::span<const std::byte> data, size_t offset, std::string_view magic)
{
    return data.size() >= offset + magic.size() &&
           std::memcmp(data.data() + offset, magic.data(), magic.size()) == 0;
}

bool is_png(std::span<const std::byte> data)
{
    return starts_with(data, 0, "\x89PNG\r\n\x1a\n");
}

} // namespace

std::optional<DeepImage> decode_deep_image(std::span<const std::byte> data, const std::string& name)
{
    // Offset of the bit depth in a PNG file, whose first chunk must be the header.
    constexpr size_t depth_at = 24;
    if (!is_png(data) || data.size() <= depth_at || data[depth_at] != std::byte{16}) {
        return std::nullopt;
    }
    return decode_png<DeepImage>(data, name);
}

Image decode_image(std::span<const std::byte> data, const std::string& name)
{
    if (is_png(data)) {
        return decode_png<Image>(data, name);
    }
    if (starts_with(data, 0, "\xFF\xD8\xFF")) {
        return decode_jpeg(data, name);
    }
    if (starts_with(data, 0, "RIFF") && starts_with(data, 8, "WEBP")) {
        return decode_webp(data, name);
    }
    if (is_tiff(data)) {
        return decode_tiff(data, name);
    }
    if (std::optional<Image> image = decode_older_picture(data, name)) {
        return std::move(*image);
    }
    throw Error("is not a PNG, JPEG, WebP, TIFF, TGA, BMP, GIF or PSD image", name);
}

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

Image read_image(const std::filesystem::path& path, const ReadScope& scope)
{
    constexpr uint64_t max_file_bytes = uint64_t{1} << 31;
    return decode_image(read_file(path, max_file_bytes, scope), path.string());
}

bool is_well_formed(const Image& image)
{
    return image.width > 0 && image.height > 0 && image.width <= max_image_side &&
           image.height <= max_image_side && image.rgba.size() == size_t{4} * image.width * image.height;
}

Image load_image(const std::filesystem::path& path, const ReadScope& scope)
{
    Image image =
        run_in_child([&] { return read_image(path, scope); }, limits_for_file(path, scope), path.string());
    if (!is_well_formed(image)) {
        throw Error("what was read from it came back damaged", path.string());
    }
    return image;
}

} // namespace estampe
