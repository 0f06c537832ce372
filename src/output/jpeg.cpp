// SPDX-License-Identifier: MIT
#include <cmath>
#include <csetjmp>
#include <cstdio>
#include <cstdlib>
#include <span>

#include <jpeglib.h>

#include <estampe/error.hpp>
#include <fmt/format.h>

#include "output/pictures.hpp"

namespace estampe::output {
namespace {

/// libjpeg reports errors by a function that must not return: what has a destructor lives here, outside the
/// frame that longjmp leaves.
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
    // Coloured ink is thin: colour at half the size would bleed out of its lines.
    jpeg.comp_info[0].h_samp_factor = 1;
    jpeg.comp_info[0].v_samp_factor = 1;
    if (dots_per_m > 0) {
        constexpr double inches_a_m = 1000.0 / 25.4;
        jpeg.density_unit = 1; // an inch
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
    constexpr uint32_t longest_side = JPEG_MAX_DIMENSION; // of the library; the format's own is 65535
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

} // namespace estampe::output
