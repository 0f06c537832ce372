// SPDX-License-Identifier: MIT
// Texture formats other than PNG, JPEG and WebP.
#include <cstdlib>
#include <functional>
#include <random>
#include <string>

#include <gtest/gtest.h>

#include <jpeglib.h>
#include <lcms2.h>
#include <tiffio.h>

#include <estampe/error.hpp>

#include "core/file.hpp"
#include "core/image_codec.hpp"
#include "core/image_formats.hpp"
#include "support/folder.hpp"

namespace estampe {
namespace {

using Pixel = std::array<int, 4>;

constexpr Pixel red{255, 0, 0, 255};
constexpr Pixel green{0, 255, 0, 255};
constexpr Pixel blue{0, 0, 255, 255};
constexpr Pixel white{255, 255, 255, 255};

std::string bytes(std::initializer_list<int> values)
{
    std::string text;
    for (const int value : values)
        text += static_cast<char>(value);
    return text;
}

std::string little16(uint32_t value)
{
    return bytes({static_cast<int>(value & 255), static_cast<int>(value >> 8)});
}

std::string little32(uint32_t value)
{
    return little16(value & 0xffff) + little16(value >> 16);
}

Image decode(const std::string& file)
{
    return decode_image(std::as_bytes(std::span(file)), "picture");
}

Pixel pixel_at(const Image& image, uint32_t x, uint32_t y)
{
    const uint8_t* const first = image.rgba.data() + 4 * (size_t{y} * image.width + x);
    return {first[0], first[1], first[2], first[3]};
}

/// Expects four pixels: red and green above, blue and white below.
void expect_four(const Image& image)
{
    ASSERT_EQ(image.width, 2U);
    ASSERT_EQ(image.height, 2U);
    EXPECT_EQ(pixel_at(image, 0, 0), red);
    EXPECT_EQ(pixel_at(image, 1, 0), green);
    EXPECT_EQ(pixel_at(image, 0, 1), blue);
    EXPECT_EQ(pixel_at(image, 1, 1), white);
}

/// Expects an Error with the file's name for every truncation of the file.
void expect_refused_when_cut(const std::string& file, size_t from = 0)
{
    for (size_t size = from; size < file.size(); ++size) {
        const std::string cut = file.substr(0, size);
        try {
            (void)decode(cut);
            ADD_FAILURE() << size << " of " << file.size() << " bytes are taken for a whole file";
        } catch (const Error& error) {
            EXPECT_EQ(error.where(), "picture");
        }
    }
}

std::string tga(int kind, int bits, const std::string& pixels, int descriptor, const std::string& map = "",
                int map_entries = 0, int map_bits = 0)
{
    return bytes({0, map.empty() ? 0 : 1, kind, 0, 0, map_entries, 0, map_bits, 0, 0, 0, 0, 2, 0, 2, 0, bits,
                  descriptor}) +
           map + pixels;
}

constexpr int from_the_top = 0x20;
constexpr int from_the_right = 0x10;

// TGA and BMP store blue, green, red.
const std::string r3 = bytes({0, 0, 255});
const std::string g3 = bytes({0, 255, 0});
const std::string b3 = bytes({255, 0, 0});
const std::string w3 = bytes({255, 255, 255});

TEST(TextureFormats, TgaFromTopBottomAndRight)
{
    expect_four(decode(tga(2, 24, r3 + g3 + b3 + w3, from_the_top)));
    expect_four(decode(tga(2, 24, b3 + w3 + r3 + g3, 0)));
    expect_four(decode(tga(2, 24, g3 + r3 + w3 + b3, from_the_top | from_the_right)));
}

TEST(TextureFormats, TgaDepths)
{
    expect_four(decode(
        tga(2, 16, little16(31 << 10) + little16(31 << 5) + little16(31) + little16(32767), from_the_top)));
    const std::string x = bytes({0});
    expect_four(
        // The fourth byte is not alpha.
        decode(tga(2, 32, r3 + x + g3 + x + b3 + x + w3 + x, from_the_top)));
    const Image clear = decode(tga(2, 32, r3 + x + g3 + bytes({128}) + b3 + x + w3 + x, from_the_top | 8));
    EXPECT_EQ(pixel_at(clear, 0, 0), (Pixel{255, 0, 0, 0}));
    EXPECT_EQ(pixel_at(clear, 1, 0), (Pixel{0, 255, 0, 128}));
    const Image grey = decode(tga(3, 8, bytes({10, 20, 30, 40}), from_the_top));
    EXPECT_EQ(pixel_at(grey, 1, 1), (Pixel{40, 40, 40, 255}));
}

TEST(TextureFormats, TgaWithRunsAndColorMaps)
{
    const std::string map = r3 + g3 + b3 + w3;
    expect_four(decode(tga(1, 8, bytes({0, 1, 2, 3}), from_the_top, map, 4, 24)));
    const std::string runs = bytes({0x80}) + r3 + bytes({0x02}) + g3 + b3 + w3;
    expect_four(decode(tga(10, 24, runs, from_the_top)));
    expect_four(decode(tga(9, 8, bytes({0x03, 0, 1, 2, 3}), from_the_top, map, 4, 24)));
    const Image same = decode(tga(11, 8, bytes({0x83, 77}), 0));
    EXPECT_EQ(pixel_at(same, 1, 0), (Pixel{77, 77, 77, 255}));
    expect_refused_when_cut(tga(10, 24, runs, from_the_top));
    expect_refused_when_cut(tga(9, 8, bytes({0x03, 0, 1, 2, 3}), from_the_top, map, 4, 24));
    expect_refused_when_cut(tga(2, 24, r3 + g3 + b3 + w3, from_the_top));
}

std::string bmp(int height, uint32_t bits, const std::string& map, const std::string& pixels,
                uint32_t compression = 0)
{
    const auto at_byte = static_cast<uint32_t>(54 + map.size());
    return "BM" + little32(at_byte + static_cast<uint32_t>(pixels.size())) + little32(0) + little32(at_byte) +
           little32(40) + little32(2) + little32(static_cast<uint32_t>(height)) + little16(1) +
           little16(bits) + little32(compression) + std::string(12, '\0') +
           little32(static_cast<uint32_t>(map.size() / 4)) + little32(0) + map + pixels;
}

TEST(TextureFormats, Bmp)
{
    const std::string pad(2, '\0');
    expect_four(decode(bmp(2, 24, "", b3 + w3 + pad + r3 + g3 + pad)));
    expect_four(decode(bmp(-2, 24, "", r3 + g3 + pad + b3 + w3 + pad)));
    const std::string x(1, '\0');
    const std::string map = r3 + x + g3 + x + b3 + x + w3 + x;
    expect_four(decode(bmp(2, 8, map, bytes({2, 3, 0, 0, 0, 1, 0, 0}))));
    expect_four(decode(bmp(2, 4, map, bytes({0x23, 0, 0, 0, 0x01, 0, 0, 0}))));
    expect_refused_when_cut(bmp(2, 24, "", b3 + w3 + pad + r3 + g3 + pad));
    try {
        (void)decode(bmp(2, 8, map, bytes({2, 3, 0, 0, 0, 1, 0, 0}), 1));
        ADD_FAILURE() << "runs are not read";
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("run-length"), std::string::npos) << error.what();
    }
}

TEST(TextureFormats, GifGivesItsFirstFrame)
{
    const std::string palette = bytes({255, 0, 0, 0, 255, 0, 0, 0, 255, 255, 255, 255});
    // 3-bit codes: clear, 0, 1, clear, 2, 3, end.
    const auto codes = [](std::initializer_list<uint32_t> list) {
        uint32_t packed = 0;
        uint32_t shift = 0;
        for (const uint32_t code : list) {
            packed |= code << shift;
            shift += 3;
        }
        return bytes({2, 3}) + little32(packed).substr(0, 3) + bytes({0});
    };
    const std::string head = "GIF89a" + bytes({2, 0, 2, 0, 0x81, 0, 0}) + palette;
    const std::string frame = bytes({0x2c, 0, 0, 0, 0, 2, 0, 2, 0, 0});
    const std::string control = bytes({0x21, 0xf9, 4, 0, 0, 0, 0, 0});
    const std::string first = head + control + frame + codes({4, 0, 1, 4, 2, 3, 5});
    const std::string file = first + frame + codes({4, 3, 3, 4, 3, 3, 5}) + ";";
    expect_four(decode(file));
    expect_refused_when_cut(first);
}

std::string big16(uint32_t value)
{
    return bytes({static_cast<int>(value >> 8), static_cast<int>(value & 255)});
}

std::string big32(uint32_t value)
{
    return big16(value >> 16) + big16(value & 0xffff);
}

TEST(TextureFormats, Psd)
{
    const auto psd = [](uint32_t mode, const std::string& data) {
        return "8BPS" + big16(1) + std::string(6, '\0') + big16(3) + big32(2) + big32(2) + big16(8) +
               big16(mode) + big32(0) + big32(0) + big32(0) + data;
    };
    const std::string planes = bytes({255, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 255});
    expect_four(decode(psd(3, big16(0) + planes)));
    expect_refused_when_cut(psd(3, big16(0) + planes));
    std::string packed = big16(1);
    for (int row = 0; row < 6; ++row)
        packed += big16(3);
    for (size_t row = 0; row < 6; ++row)
        packed += bytes({1}) + planes.substr(2 * row, 2);
    expect_four(decode(psd(3, packed)));
    expect_refused_when_cut(psd(3, packed));
    EXPECT_THROW((void)decode(psd(4, big16(0) + planes)), Error) << "CMYK";
}

/// Writes a TIFF of 2 x 2 pixels; `fill` sets its tags and writes the pixels.
std::string tiff(const std::function<void(TIFF*)>& fill, const char* mode = "w")
{
    const test::Folder folder;
    const std::filesystem::path path = folder / "t.tif";
    TIFF* const file = TIFFOpen(path.c_str(), mode);
    TIFFSetField(file, TIFFTAG_IMAGEWIDTH, 2);
    TIFFSetField(file, TIFFTAG_IMAGELENGTH, 2);
    TIFFSetField(file, TIFFTAG_PLANARCONFIG, PLANARCONFIG_CONTIG);
    fill(file);
    TIFFClose(file);
    const std::vector<std::byte> read = read_file(path);
    return {reinterpret_cast<const char*>(read.data()), read.size()};
}

void set_samples(TIFF* file, int samples, int bits, int photometric, int compression)
{
    TIFFSetField(file, TIFFTAG_SAMPLESPERPIXEL, samples);
    TIFFSetField(file, TIFFTAG_BITSPERSAMPLE, bits);
    TIFFSetField(file, TIFFTAG_PHOTOMETRIC, photometric);
    TIFFSetField(file, TIFFTAG_COMPRESSION, compression);
}

void write_rows(TIFF* file, std::string rows)
{
    TIFFSetField(file, TIFFTAG_ROWSPERSTRIP, 1);
    TIFFWriteScanline(file, rows.data(), 0, 0);
    TIFFWriteScanline(file, rows.data() + rows.size() / 2, 1, 0);
}

const std::string rgb_rows = bytes({255, 0, 0, 0, 255, 0, 0, 0, 255, 255, 255, 255});

TEST(TextureFormats, TiffOfEitherByteOrderPackedOrNot)
{
    for (const char* const mode : {"wl", "wb", "w8"})
        for (const int compression :
             {COMPRESSION_NONE, COMPRESSION_LZW, COMPRESSION_ADOBE_DEFLATE, COMPRESSION_PACKBITS})
            expect_four(decode(tiff(
                [&](TIFF* file) {
                    set_samples(file, 3, 8, PHOTOMETRIC_RGB, compression);
                    write_rows(file, rgb_rows);
                },
                mode)));
}

TEST(TextureFormats, TiffTilesPalettesAndSixteenBits)
{
    expect_four(decode(tiff([](TIFF* file) {
        set_samples(file, 3, 8, PHOTOMETRIC_RGB, COMPRESSION_NONE);
        TIFFSetField(file, TIFFTAG_TILEWIDTH, 16);
        TIFFSetField(file, TIFFTAG_TILELENGTH, 16);
        std::string tile(3 * 256, '\0');
        tile.replace(0, 6, rgb_rows.substr(0, 6));
        tile.replace(48, 6, rgb_rows.substr(6));
        TIFFWriteTile(file, tile.data(), 0, 0, 0, 0);
    })));
    expect_four(decode(tiff([](TIFF* file) {
        set_samples(file, 1, 8, PHOTOMETRIC_PALETTE, COMPRESSION_NONE);
        std::vector<uint16_t> r(256), g(256), b(256);
        r[0] = g[1] = b[2] = r[3] = g[3] = b[3] = 65535;
        TIFFSetField(file, TIFFTAG_COLORMAP, r.data(), g.data(), b.data());
        write_rows(file, bytes({0, 1, 2, 3}));
    })));
    std::string doubled;
    for (const char value : rgb_rows)
        doubled += std::string(2, value);
    expect_four(decode(tiff([&](TIFF* file) {
        set_samples(file, 3, 16, PHOTOMETRIC_RGB, COMPRESSION_NONE);
        write_rows(file, doubled);
    })));
}

TEST(TextureFormats, TiffAlphaStaysStraight)
{
    const auto with_alpha = [](uint16_t kind, const std::string& rows) {
        return decode(tiff([&](TIFF* file) {
            set_samples(file, 4, 8, PHOTOMETRIC_RGB, COMPRESSION_NONE);
            TIFFSetField(file, TIFFTAG_EXTRASAMPLES, 1, &kind);
            write_rows(file, rows);
        }));
    };
    const std::string rows = bytes({200, 100, 50, 0, 200, 100, 50, 128, 1, 2, 3, 255, 9, 9, 9, 255});
    const Image straight = with_alpha(EXTRASAMPLE_UNASSALPHA, rows);
    EXPECT_EQ(pixel_at(straight, 0, 0), (Pixel{200, 100, 50, 0}));
    EXPECT_EQ(pixel_at(straight, 1, 0), (Pixel{200, 100, 50, 128}));
    const Image multiplied =
        with_alpha(EXTRASAMPLE_ASSOCALPHA, bytes({0, 0, 0, 0, 100, 50, 25, 128, 1, 2, 3, 255, 9, 9, 9, 255}));
    EXPECT_EQ(pixel_at(multiplied, 1, 0), (Pixel{199, 100, 50, 128}));
    EXPECT_EQ(pixel_at(multiplied, 0, 1), (Pixel{1, 2, 3, 255}));
}

/// Encodes rows of floating-point numbers as a TIFF.
template <class Number>
std::string float_tiff(const std::vector<Number>& numbers, int photometric, int compression,
                       const char* mode = "wl", int extra_kind = -1)
{
    return tiff(
        [&](TIFF* file) {
            set_samples(file, static_cast<int>(numbers.size() / 4), 8 * sizeof(Number), photometric,
                        compression);
            TIFFSetField(file, TIFFTAG_SAMPLEFORMAT, SAMPLEFORMAT_IEEEFP);
            const auto kind = static_cast<uint16_t>(std::max(extra_kind, 0));
            if (extra_kind >= 0)
                TIFFSetField(file, TIFFTAG_EXTRASAMPLES, 1, &kind);
            write_rows(file,
                       {reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(Number)});
        },
        mode);
}

TEST(TextureFormats, FloatTiffIsLinearAndClamped)
{
    const std::vector<double> corners{1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1};
    const std::vector<float> singles(corners.begin(), corners.end());
    std::vector<uint16_t> halves;
    for (const double value : corners)
        halves.push_back(value > 0.0 ? 0x3c00 : 0);
    for (const char* const mode : {"wl", "wb"})
        for (const int compression : {COMPRESSION_NONE, COMPRESSION_LZW, COMPRESSION_ADOBE_DEFLATE}) {
            expect_four(decode(float_tiff(corners, PHOTOMETRIC_RGB, compression, mode)));
            expect_four(decode(float_tiff(singles, PHOTOMETRIC_RGB, compression, mode)));
            expect_four(decode(float_tiff(halves, PHOTOMETRIC_RGB, compression, mode)));
        }
    const float not_a_number = std::numeric_limits<float>::quiet_NaN();
    const Image grey = decode(
        float_tiff<float>({0.2158605F, 7.0F, -1.0F, not_a_number}, PHOTOMETRIC_MINISBLACK, COMPRESSION_NONE));
    EXPECT_EQ(pixel_at(grey, 0, 0), (Pixel{128, 128, 128, 255})) << "the linear value of 128";
    EXPECT_EQ(pixel_at(grey, 1, 0), (Pixel{255, 255, 255, 255}));
    EXPECT_EQ(pixel_at(grey, 0, 1), (Pixel{0, 0, 0, 255}));
    EXPECT_EQ(pixel_at(grey, 1, 1), (Pixel{0, 0, 0, 255}));
    expect_refused_when_cut(float_tiff(singles, PHOTOMETRIC_RGB, COMPRESSION_NONE));
}

TEST(TextureFormats, FloatTiffHasStraightAlpha)
{
    const std::vector<float> pixels{1, 1, 1, 0.5F, 0, 0, 0, 0, 0.2158605F, 0, 1, 1, 0.1079302F, 0, 0, 0.5F};
    const Image straight =
        decode(float_tiff(pixels, PHOTOMETRIC_RGB, COMPRESSION_NONE, "wl", EXTRASAMPLE_UNASSALPHA));
    EXPECT_EQ(pixel_at(straight, 0, 0), (Pixel{255, 255, 255, 128}));
    EXPECT_EQ(pixel_at(straight, 1, 0), (Pixel{0, 0, 0, 0}));
    EXPECT_EQ(pixel_at(straight, 0, 1), (Pixel{128, 0, 255, 255}));
    const Image multiplied =
        decode(float_tiff(pixels, PHOTOMETRIC_RGB, COMPRESSION_NONE, "wl", EXTRASAMPLE_ASSOCALPHA));
    EXPECT_EQ(pixel_at(multiplied, 1, 1), (Pixel{128, 0, 0, 128})) << "divided by its alpha";
}

TEST(TextureFormats, CutAndAbsurdTiffIsRefused)
{
    const std::string whole = tiff([](TIFF* file) {
        set_samples(file, 3, 8, PHOTOMETRIC_RGB, COMPRESSION_NONE);
        write_rows(file, rgb_rows);
    });
    expect_refused_when_cut(whole);
    const std::string wide = tiff([](TIFF* file) {
        TIFFSetField(file, TIFFTAG_IMAGEWIDTH, 8000);
        TIFFSetField(file, TIFFTAG_IMAGELENGTH, 8000);
        set_samples(file, 1, 1, PHOTOMETRIC_MINISBLACK, COMPRESSION_NONE);
    });
    EXPECT_THROW((void)decode(wide), Error);
}

/// A JPEG of one CMYK colour; 0 is no ink and 255 full ink.
std::string ink_jpeg(const std::array<uint8_t, 4>& inks, bool adobe, bool as_ycck,
                     const std::vector<uint8_t>& profile = {})
{
    jpeg_compress_struct jpeg{};
    jpeg_error_mgr errors{};
    jpeg.err = jpeg_std_error(&errors);
    jpeg_create_compress(&jpeg);
    unsigned char* data = nullptr;
    unsigned long size = 0;
    jpeg_mem_dest(&jpeg, &data, &size);
    jpeg.image_width = 16;
    jpeg.image_height = 16;
    jpeg.input_components = 4;
    jpeg.in_color_space = JCS_CMYK;
    jpeg_set_defaults(&jpeg);
    jpeg_set_quality(&jpeg, 100, TRUE);
    if (as_ycck)
        jpeg_set_colorspace(&jpeg, JCS_YCCK);
    jpeg.write_Adobe_marker = adobe ? TRUE : FALSE;
    jpeg_start_compress(&jpeg, TRUE);
    if (!profile.empty())
        jpeg_write_icc_profile(&jpeg, profile.data(), static_cast<unsigned>(profile.size()));
    std::vector<uint8_t> row;
    for (int x = 0; x < 16; ++x)
        for (const uint8_t ink : inks)
            row.push_back(adobe ? static_cast<uint8_t>(255 - ink) : ink);
    for (int y = 0; y < 16; ++y) {
        JSAMPROW rows = row.data();
        jpeg_write_scanlines(&jpeg, &rows, 1);
    }
    jpeg_finish_compress(&jpeg);
    jpeg_destroy_compress(&jpeg);
    std::string file(reinterpret_cast<const char*>(data), size);
    std::free(data);
    return file;
}

void expect_about(const Pixel& found, const Pixel& wanted, int tolerance = 4)
{
    for (size_t channel = 0; channel < 4; ++channel)
        EXPECT_NEAR(found[channel], wanted[channel], tolerance) << channel;
}

TEST(TextureFormats, JpegOfInks)
{
    for (const bool as_ycck : {false, true}) {
        expect_about(pixel_at(decode(ink_jpeg({0, 0, 0, 0}, true, as_ycck)), 3, 3), white);
        expect_about(pixel_at(decode(ink_jpeg({0, 255, 255, 0}, true, as_ycck)), 3, 3), red);
        expect_about(pixel_at(decode(ink_jpeg({51, 0, 0, 128}, true, as_ycck)), 3, 3), {102, 127, 127, 255});
    }
    expect_about(pixel_at(decode(ink_jpeg({0, 255, 255, 0}, false, false)), 3, 3), red);
}

/// A CMYK profile that maps cyan to dark grey and everything else to light grey.
std::vector<uint8_t> profile_of_inks()
{
    const cmsHPROFILE profile = cmsCreateProfilePlaceholder(nullptr);
    cmsSetProfileVersion(profile, 2.1);
    cmsSetDeviceClass(profile, cmsSigOutputClass);
    cmsSetColorSpace(profile, cmsSigCmykData);
    cmsSetPCS(profile, cmsSigLabData);
    cmsPipeline* const pipeline = cmsPipelineAlloc(nullptr, 4, 3);
    cmsStage* const grid = cmsStageAllocCLut16bit(nullptr, 2, 4, 3, nullptr);
    const auto fill = [](const cmsUInt16Number in[], cmsUInt16Number out[], void*) {
        const cmsCIELab lab{.L = in[0] > 0 ? 20.0 : 90.0, .a = 0.0, .b = 0.0};
        cmsFloat2LabEncodedV2(out, &lab);
        return 1;
    };
    cmsStageSampleCLut16bit(grid, fill, nullptr, 0);
    cmsPipelineInsertStage(pipeline, cmsAT_END, grid);
    cmsWriteTag(profile, cmsSigAToB0Tag, pipeline);
    cmsWriteTag(profile, cmsSigAToB1Tag, pipeline);
    cmsPipelineFree(pipeline);
    cmsUInt32Number size = 0;
    cmsSaveProfileToMem(profile, nullptr, &size);
    std::vector<uint8_t> saved(size);
    cmsSaveProfileToMem(profile, saved.data(), &size);
    cmsCloseProfile(profile);
    return saved;
}

TEST(TextureFormats, InksAreWhatTheProfileSays)
{
    const std::vector<uint8_t> profile = profile_of_inks();
    const Pixel dark = pixel_at(decode(ink_jpeg({255, 0, 0, 0}, true, false, profile)), 3, 3);
    const Pixel light = pixel_at(decode(ink_jpeg({0, 255, 255, 0}, true, false, profile)), 3, 3);
    EXPECT_NEAR(dark[0], dark[2], 4) << "grey, where the product would be cyan";
    EXPECT_NEAR(light[0], light[2], 4);
    EXPECT_LT(dark[0] + 100, light[0]);
    const std::vector<uint8_t> damaged(400, 7);
    expect_about(pixel_at(decode(ink_jpeg({0, 255, 255, 0}, true, false, damaged)), 3, 3), red);
}

TEST(TextureFormats, NoiseIsNoPicture)
{
    std::mt19937 random(7);
    for (int i = 0; i < 3000; ++i) {
        std::string noise;
        for (int k = 0; k < 200; ++k)
            noise += static_cast<char>(random());
        const char* const magics[] = {"BM", "GIF89a", "8BPS", "II*", "", ""};
        const std::string magic = magics[i % 6];
        noise.replace(0, magic.size(), magic);
        if (i % 6 == 3)
            noise[3] = '\0';
        try {
            (void)decode(noise);
        } catch (const Error& error) {
            EXPECT_EQ(error.where(), "picture");
        }
    }
}

} // namespace
} // namespace estampe
