// SPDX-License-Identifier: MIT
#include "output/pictures.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <csetjmp>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <span>

#include <fmt/format.h>
#include <jpeglib.h>
#include <lcms2.h>
#include <webp/encode.h>
#include <webp/mux.h>

#include <estampe/error.hpp>
#include <estampe/image.hpp>
#include <estampe/linear_image.hpp>

#include "core/color.hpp"
#include "core/exr.hpp"
#include "core/image_codec.hpp"
#include "output/layer_bytes.hpp"

namespace estampe::output {
namespace {

struct CloseProfile {
    void operator()(void* profile) const { cmsCloseProfile(profile); }
};

std::vector<std::byte> make_srgb_profile()
{
    const std::unique_ptr<void, CloseProfile> profile(cmsCreate_sRGBProfile());
    cmsUInt32Number size = 0;
    std::vector<std::byte> bytes;
    if (profile && cmsSaveProfileToMem(profile.get(), nullptr, &size) != 0) {
        bytes.resize(size);
    }
    if (bytes.empty() || cmsSaveProfileToMem(profile.get(), bytes.data(), &size) == 0) {
        throw Error("cannot make a colour profile");
    }
    // Sets the date in the profile to 1 January 2000. Otherwise the library stores the current date, and the
    // same picture would not always have the same bytes.
    constexpr size_t date_place = 24;
    constexpr std::array<uint8_t, 12> date{0x07, 0xD0, 0, 1, 0, 1, 0, 0, 0, 0, 0, 0};
    std::ranges::transform(date, bytes.begin() + date_place, [](uint8_t byte) { return std::byte(byte); });
    return bytes;
}

} // namespace

const std::vector<std::byte>& srgb_profile()
{
    static const std::vector<std::byte> profile = make_srgb_profile();
    return profile;
}

namespace {

/// State of libjpeg, whose error function must not return: objects with destructors live here, outside the
/// stack frame that longjmp leaves.
struct JpegWriter {
    jpeg_compress_struct jpeg{};
    jpeg_error_mgr errors{};
    std::jmp_buf jump;
    char message[JMSG_LENGTH_MAX] = {};
    unsigned char* data = nullptr;
    unsigned long size = 0;

    ~JpegWriter()
    {
        jpeg_destroy_compress(&jpeg);
        std::free(data);
    }
};

[[noreturn]] void failed(j_common_ptr jpeg)
{
    auto* writer = static_cast<JpegWriter*>(jpeg->client_data);
    jpeg->err->format_message(jpeg, writer->message);
    std::longjmp(writer->jump, 1);
}

void warned(j_common_ptr /*jpeg*/, int /*level*/) {}

bool write(JpegWriter& writer, const Image& image, int quality, uint32_t dots_per_m,
           std::span<const std::byte> profile)
{
    if (setjmp(writer.jump) != 0) {
        return false;
    }
    jpeg_compress_struct& jpeg = writer.jpeg;
    jpeg_create_compress(&jpeg);
    jpeg.client_data = &writer;
    jpeg_mem_dest(&jpeg, &writer.data, &writer.size);
    jpeg.image_width = image.width;
    jpeg.image_height = image.height;
    jpeg.input_components = 4;
    jpeg.in_color_space = JCS_EXT_RGBX;
    jpeg_set_defaults(&jpeg);
    jpeg_set_quality(&jpeg, quality, TRUE);
    jpeg.dct_method = JDCT_ISLOW;
    jpeg.optimize_coding = TRUE;
    // Stores chroma at full resolution: coloured ink lines are thin, and chroma at half the resolution would
    // spread beyond the lines.
    jpeg.comp_info[0].h_samp_factor = 1;
    jpeg.comp_info[0].v_samp_factor = 1;
    if (dots_per_m > 0) {
        constexpr double inches_a_m = 1000.0 / 25.4;
        jpeg.density_unit = 1; // The unit is dots per inch
        jpeg.X_density = jpeg.Y_density = static_cast<UINT16>(std::lround(dots_per_m / inches_a_m));
    }
    jpeg_start_compress(&jpeg, TRUE);
    jpeg_write_icc_profile(&jpeg, reinterpret_cast<const JOCTET*>(profile.data()),
                           static_cast<unsigned int>(profile.size()));
    while (jpeg.next_scanline < jpeg.image_height) {
        auto* row = const_cast<JSAMPLE*>(image.rgba.data() + size_t{jpeg.next_scanline} * image.width * 4);
        jpeg_write_scanlines(&jpeg, &row, 1);
    }
    jpeg_finish_compress(&jpeg);
    return true;
}

} // namespace

std::vector<std::byte> encode_jpeg(const Image& image, int quality, uint32_t dots_per_m)
{
    // Longest side of a picture in libjpeg; the JPEG format itself allows 65535.
    constexpr uint32_t longest_side = JPEG_MAX_DIMENSION;
    if (image.empty() || image.rgba.size() != uint64_t{image.width} * image.height * 4) {
        throw Error("an empty image cannot be written");
    }
    if (image.width > longest_side || image.height > longest_side) {
        throw Error(
            fmt::format("JPEG is written with no side of more than {} pixels, and the picture has {} x {}",
                        longest_side, image.width, image.height),
            {}, "write it as PNG or OpenEXR");
    }
    if (quality < 1 || quality > 100) {
        throw Error(fmt::format("a quality of {} is not 1 to 100", quality));
    }
    JpegWriter writer;
    writer.jpeg.err = jpeg_std_error(&writer.errors);
    writer.errors.error_exit = failed;
    writer.errors.emit_message = warned;
    if (!write(writer, image, quality, dots_per_m, srgb_profile())) {
        throw Error(fmt::format("cannot encode JPEG: {}", writer.message));
    }
    const auto* first = reinterpret_cast<const std::byte*>(writer.data);
    return {first, first + writer.size};
}

namespace {

struct Release {
    void operator()(WebPMux* mux) const { WebPMuxDelete(mux); }

    void operator()(WebPMemoryWriter* writer) const { WebPMemoryWriterClear(writer); }

    void operator()(WebPPicture* picture) const { WebPPictureFree(picture); }

    void operator()(WebPData* data) const { WebPDataClear(data); }
};

WebPConfig config_of(std::optional<int> quality)
{
    WebPConfig config;
    bool is_valid = false;
    if (quality) {
        is_valid = WebPConfigPreset(&config, WEBP_PRESET_DRAWING, static_cast<float>(*quality)) != 0;
        config.use_sharp_yuv = 1; // Scales chroma down more exactly, so that thin lines keep their colour
    } else {
        constexpr int quick = 3;
        is_valid = WebPConfigInit(&config) != 0 && WebPConfigLosslessPreset(&config, quick) != 0;
        config.exact = 1;
    }
    if (!is_valid || WebPValidateConfig(&config) == 0) {
        throw Error("cannot encode WebP: the library is of another version");
    }
    return config;
}

/// Encodes the picture as WebP without a colour profile.
void encode_frame(const Image& image, std::optional<int> quality, WebPMemoryWriter& writer)
{
    const WebPConfig config = config_of(quality);
    WebPPicture picture;
    if (WebPPictureInit(&picture) == 0) {
        throw Error("cannot encode WebP: the library is of another version");
    }
    const std::unique_ptr<WebPPicture, Release> freed(&picture);
    picture.width = static_cast<int>(image.width);
    picture.height = static_cast<int>(image.height);
    picture.use_argb = 1;
    picture.writer = WebPMemoryWrite;
    picture.custom_ptr = &writer;
    const int stride = static_cast<int>(image.width) * 4;
    if (WebPPictureImportRGBA(&picture, image.rgba.data(), stride) == 0 ||
        WebPEncode(&config, &picture) == 0) {
        throw Error(fmt::format("cannot encode WebP: error {}", static_cast<int>(picture.error_code)));
    }
}

} // namespace

std::vector<std::byte> encode_webp(const Image& image, std::optional<int> quality)
{
    if (image.empty() || image.rgba.size() != uint64_t{image.width} * image.height * 4) {
        throw Error("an empty image cannot be written");
    }
    if (image.width > WEBP_MAX_DIMENSION || image.height > WEBP_MAX_DIMENSION) {
        throw Error(fmt::format("WebP holds no side of more than {} pixels, and the picture has {} x {}",
                                WEBP_MAX_DIMENSION, image.width, image.height),
                    {}, "write it as PNG, JPEG or OpenEXR");
    }
    if (quality && (*quality < 0 || *quality > 100)) {
        throw Error(fmt::format("a quality of {} is not 0 to 100", *quality));
    }
    WebPMemoryWriter writer;
    WebPMemoryWriterInit(&writer);
    const std::unique_ptr<WebPMemoryWriter, Release> cleared(&writer);
    encode_frame(image, quality, writer);

    const std::unique_ptr<WebPMux, Release> mux(WebPMuxNew());
    const WebPData frame{writer.mem, writer.size};
    const std::vector<std::byte>& profile = srgb_profile();
    const WebPData icc{reinterpret_cast<const uint8_t*>(profile.data()), profile.size()};
    WebPData file;
    WebPDataInit(&file);
    const std::unique_ptr<WebPData, Release> freed(&file);
    if (!mux || WebPMuxSetImage(mux.get(), &frame, 0) != WEBP_MUX_OK ||
        WebPMuxSetChunk(mux.get(), "ICCP", &icc, 0) != WEBP_MUX_OK ||
        WebPMuxAssemble(mux.get(), &file) != WEBP_MUX_OK) {
        throw Error("cannot encode WebP: out of memory");
    }
    const auto* first = reinterpret_cast<const std::byte*>(file.bytes);
    return {first, first + file.size};
}

// Functions for pictures with more than eight bits per channel.

void check_pixels(const LinearImage& image)
{
    if (image.empty() || image.pixels.size() != uint64_t{image.width} * image.height) {
        throw Error(fmt::format("a picture of {} x {} with {} pixels cannot be written", image.width,
                                image.height, image.pixels.size()));
    }
}

std::vector<std::byte> encode_deep_png(const LinearImage& image, uint32_t dots_per_m)
{
    check_pixels(image);
    std::vector<uint16_t> values;
    if (image.paper) {
        const Arithmetic in(16);
        values.reserve(4 * image.pixels.size());
        for (const glm::vec4& pixel : image.pixels) {
            const glm::ivec4 numbers = straight(pixel, *image.paper, in);
            for (int channel = 0; channel < 4; ++channel) {
                values.push_back(static_cast<uint16_t>(numbers[channel]));
            }
        }
        return encode_png(image.width, image.height, 4, values, dots_per_m);
    }
    values.reserve(3 * image.pixels.size());
    for (const glm::vec4& pixel : image.pixels) {
        for (int channel = 0; channel < 3; ++channel) {
            const float encoded = srgb_from_linear(std::clamp(pixel[channel], 0.0F, 1.0F));
            values.push_back(static_cast<uint16_t>(std::lround(65535.0F * encoded)));
        }
    }
    return encode_png(image.width, image.height, 3, values, dots_per_m);
}

std::vector<std::byte> encode_picture_exr(const LinearImage& image, ExrNumbers numbers)
{
    check_pixels(image);
    std::vector<ExrChannel> channels;
    const int count = image.paper ? 4 : 3;
    channels.reserve(static_cast<size_t>(count));
    for (int channel = 0; channel < count; ++channel) {
        channels.push_back(
            {std::string(1, "RGBA"[channel]), [&image, channel](uint32_t y, std::span<float> row) {
                 const glm::vec4* pixels = image.pixels.data() + size_t{y} * image.width;
                 std::transform(pixels, pixels + image.width, row.begin(),
                                [channel](const glm::vec4& pixel) { return pixel[channel]; });
             }});
    }
    return encode_exr(image.width, image.height, channels, numbers);
}

} // namespace estampe::output

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
