// SPDX-License-Identifier: MIT
// PNG encoding: a whole picture with its rows deflated on all cores, or a file row by row.
#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <future>
#include <new>
#include <span>
#include <thread>
#include <vector>

#include <fmt/format.h>
#include <png.h>
#include <zlib.h>

#include <estampe/error.hpp>

#include "core/file.hpp"
#include "core/image_codec.hpp"
#include "core/image_formats.hpp"
#include "core/long_jobs.hpp"

namespace estampe {

/// Header of a PNG file.
struct PngHead {
    uint32_t width = 0;
    uint32_t height = 0;
    uint32_t channels = 4;
    uint32_t bits = 8;
    uint32_t dots_per_m = 0; ///< Print resolution in dots per metre; 0: not stored in the file
};

namespace {

/// Compression level of deflate. On drawings it is as fast as level 3 and gives smaller files.
constexpr int png_level = 4;

/// Writes the header of a PNG file, marked as sRGB, and sets the compression. May longjmp; see CodecFailure.
void png_write_head(png_structp png, png_infop info, const PngHead& head)
{
    png_set_compression_level(png, png_level);
    png_set_filter(png, PNG_FILTER_TYPE_BASE, PNG_FILTER_SUB);
    png_set_IHDR(png, info, head.width, head.height, static_cast<int>(head.bits),
                 head.channels == 4 ? PNG_COLOR_TYPE_RGBA : PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    png_set_sRGB_gAMA_and_cHRM(png, info, PNG_sRGB_INTENT_PERCEPTUAL);
    if (head.dots_per_m > 0) {
        png_set_pHYs(png, info, head.dots_per_m, head.dots_per_m, PNG_RESOLUTION_METER);
    }
    png_write_info(png, info);
}

/// Pixels to encode: rows in memory without gaps, with 8 or 16 bits per sample.
struct PngPixels {
    uint32_t width = 0;
    uint32_t height = 0;
    uint32_t channels = 4;
    uint32_t bits = 8;
    std::span<const std::byte> bytes;

    [[nodiscard]] uint32_t pixel_bytes() const { return channels * bits / 8; }

    [[nodiscard]] uint64_t row_bytes() const { return uint64_t{width} * pixel_bytes(); }
};

// Size in bytes of the strips of rows that threads compress; a strip has at least one row.
constexpr uint64_t strip_bytes = 1U << 20U;
constexpr size_t window_bytes = 32768; // Window of deflate in bytes: how far back repeated data is found
// First two bytes of zlib data: 32 KiB window, fast level.
constexpr std::array zlib_head{std::byte{0x78}, std::byte{0x5e}};

/// Applies PNG's Sub filter to rows, for deflate: the filter byte, then each byte minus the byte of the pixel
/// to the left.
std::vector<std::byte> filtered(const PngPixels& pixels, uint64_t first, uint64_t end)
{
    constexpr std::byte less_left{1};
    const uint64_t row_bytes = pixels.row_bytes();
    const uint32_t step = pixels.pixel_bytes();
    const bool swaps = pixels.bits == 16 && std::endian::native == std::endian::little;
    std::vector<std::byte> rows((row_bytes + 1) * (end - first));
    std::vector<std::byte> row(row_bytes);
    auto* to = rows.data();
    for (uint64_t y = first; y < end; ++y) {
        std::ranges::copy(pixels.bytes.subspan(y * row_bytes, row_bytes), row.begin());
        for (size_t i = 0; swaps && i < row.size(); i += 2) {
            std::swap(row[i], row[i + 1]);
        }
        *to++ = less_left;
        to = std::copy_n(row.begin(), step, to);
        const auto* left = reinterpret_cast<const uint8_t*>(row.data());
        for (size_t i = step; i < row.size(); ++i) {
            *to++ = static_cast<std::byte>(left[i] - left[i - step]);
        }
    }
    return rows;
}

struct Strip {
    std::vector<std::byte> deflated;
    uLong checksum = 0;
    uint64_t filtered_bytes = 0;
};

struct Deflater {
    z_stream stream{};

    Deflater()
    {
        if (deflateInit2(&stream, png_level, Z_DEFLATED, -MAX_WBITS, MAX_MEM_LEVEL, Z_FILTERED) != Z_OK) {
            throw std::bad_alloc();
        }
    }

    ~Deflater() { deflateEnd(&stream); }

    Deflater(const Deflater&) = delete;
    Deflater& operator=(const Deflater&) = delete;
};

Strip deflated(const PngPixels& pixels, uint64_t first, uint64_t end)
{
    const uint64_t row_bytes = pixels.row_bytes() + 1;
    const uint64_t known_rows = std::min(first, (window_bytes + row_bytes - 1) / row_bytes);
    std::vector<std::byte> rows = filtered(pixels, first - known_rows, end);
    auto* bytes = reinterpret_cast<Bytef*>(rows.data());
    const uint64_t known = known_rows * row_bytes;
    Deflater deflater;
    z_stream& stream = deflater.stream;
    if (known > 0) {
        const auto window = static_cast<uInt>(std::min<uint64_t>(known, window_bytes));
        deflateSetDictionary(&stream, bytes + known - window, window);
    }
    Strip strip;
    strip.filtered_bytes = rows.size() - known;
    strip.checksum = adler32_z(adler32_z(0, nullptr, 0), bytes + known, strip.filtered_bytes);
    strip.deflated.resize(deflateBound(&stream, strip.filtered_bytes) + 16);
    stream.next_in = bytes + known;
    stream.avail_in = static_cast<uInt>(strip.filtered_bytes);
    stream.next_out = reinterpret_cast<Bytef*>(strip.deflated.data());
    stream.avail_out = static_cast<uInt>(strip.deflated.size());
    const bool is_last = end == pixels.height;
    const int result = deflate(&stream, is_last ? Z_FINISH : Z_SYNC_FLUSH);
    if (result != (is_last ? Z_STREAM_END : Z_OK) || stream.avail_in != 0) {
        throw Error("cannot deflate the rows of a PNG");
    }
    strip.deflated.resize(stream.total_out);
    return strip;
}

/// Compresses all strips of rows with deflate, using one thread per core.
std::vector<Strip> deflate_all(const PngPixels& pixels, uint64_t rows_each)
{
    std::vector<Strip> strips((pixels.height + rows_each - 1) / rows_each);
    std::atomic<size_t> next = 0;
    const auto work = [&] {
        for (size_t i = next++; i < strips.size(); i = next++) {
            strips[i] =
                deflated(pixels, i * rows_each, std::min<uint64_t>((i + 1) * rows_each, pixels.height));
        }
    };
    std::vector<std::future<void>> others;
    const size_t cores = std::max(1U, std::thread::hardware_concurrency());
    while (others.size() + 1 < std::min(cores, strips.size())) {
        others.push_back(std::async(launch_if_possible, work));
    }
    work();
    for (std::future<void>& other : others) {
        other.get();
    }
    return strips;
}

/// Returns the content of each IDAT chunk of a PNG file, in order. Rows get the Sub filter and are compressed
/// with deflate, for speed rather than size, in strips on all cores. The bytes do not depend on the number of
/// cores. Throws Error if memory runs out. Cost: 65 ms of one core per megapixel of a drawing.
///
/// Source  the PNG specification, 9 (filters); Adler's pigz, 2007 (strips that use the 32 KiB before them as
/// dictionary)
std::vector<std::vector<std::byte>> deflate_png_rows(const PngPixels& pixels)
{
    const uint64_t rows_each = std::max<uint64_t>(strip_bytes / (pixels.row_bytes() + 1), 1);
    std::vector<Strip> strips = deflate_all(pixels, rows_each);
    std::vector<std::byte>& head = strips.front().deflated;
    head.insert(head.begin(), zlib_head.begin(), zlib_head.end());
    uLong checksum = strips.front().checksum;
    for (size_t i = 1; i < strips.size(); ++i) {
        checksum =
            adler32_combine(checksum, strips[i].checksum, static_cast<z_off_t>(strips[i].filtered_bytes));
    }
    for (const unsigned shift : {24U, 16U, 8U, 0U}) {
        strips.back().deflated.push_back(static_cast<std::byte>(checksum >> shift & 0xffU));
    }
    std::vector<std::vector<std::byte>> chunks;
    chunks.reserve(strips.size());
    for (Strip& strip : strips) {
        chunks.push_back(std::move(strip.deflated));
    }
    return chunks;
}

struct PngWriter {
    png_structp png = nullptr;
    png_infop info = nullptr;
    CodecFailure failure;
    std::vector<std::byte> bytes;

    ~PngWriter() { png_destroy_write_struct(&png, &info); }
};

void append(png_structp png, png_bytep data, png_size_t count)
{
    auto* bytes = static_cast<std::vector<std::byte>*>(png_get_io_ptr(png));
    const auto* first = reinterpret_cast<const std::byte*>(data);
    bytes->insert(bytes->end(), first, first + count);
}

bool write(PngWriter& writer, const PngHead& head, const std::vector<std::vector<std::byte>>& rows)
{
    if (setjmp(writer.failure.jump) != 0) {
        return false;
    }
    png_set_write_fn(writer.png, &writer.bytes, append, nullptr);
    png_write_head(writer.png, writer.info, head);
    for (const std::vector<std::byte>& part : rows) {
        png_write_chunk(writer.png, reinterpret_cast<png_const_bytep>("IDAT"),
                        reinterpret_cast<png_const_bytep>(part.data()), part.size());
    }
    // Writes the last chunk of the file directly: png_write_end() would fail, because libpng itself has
    // written no rows.
    png_write_chunk(writer.png, reinterpret_cast<png_const_bytep>("IEND"), nullptr, 0);
    return true;
}

std::vector<std::byte> encode(const PngPixels& pixels, uint32_t dots_per_m)
{
    if (pixels.bytes.empty() || pixels.bytes.size() != pixels.row_bytes() * pixels.height) {
        throw Error(fmt::format("an image of {} x {} pixels with {} bytes cannot be written", pixels.width,
                                pixels.height, pixels.bytes.size()));
    }
    PngWriter writer;
    writer.png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &writer.failure, png_failed, png_warned);
    writer.info = writer.png == nullptr ? nullptr : png_create_info_struct(writer.png);
    if (writer.info == nullptr) {
        throw std::bad_alloc();
    }
    writer.bytes.reserve(pixels.bytes.size() / 4);
    const PngHead head{.width = pixels.width,
                       .height = pixels.height,
                       .channels = pixels.channels,
                       .bits = pixels.bits,
                       .dots_per_m = dots_per_m};
    if (!write(writer, head, deflate_png_rows(pixels))) {
        throw Error(fmt::format("cannot encode PNG: {}", writer.failure.message));
    }
    return std::move(writer.bytes);
}

} // namespace

std::vector<std::byte> encode_png(const Image& image, uint32_t dots_per_m)
{
    return encode(
        {.width = image.width, .height = image.height, .bytes = std::as_bytes(std::span(image.rgba))},
        dots_per_m);
}

std::vector<std::byte> encode_png(uint32_t width, uint32_t height, uint32_t channels,
                                  std::span<const uint16_t> values, uint32_t dots_per_m)
{
    return encode(
        {.width = width, .height = height, .channels = channels, .bits = 16, .bytes = std::as_bytes(values)},
        dots_per_m);
}

struct PngFile::Writer {
    explicit Writer(const std::filesystem::path& path) : target(path), pending(AtomicFile::file(path)) {}

    ~Writer()
    {
        png_destroy_write_struct(&png, &info);
        if (file != nullptr) {
            std::fclose(file);
        }
    }

    Writer(const Writer&) = delete;
    Writer& operator=(const Writer&) = delete;

    [[noreturn]] void fail() const
    {
        throw Error(fmt::format("cannot write: {}", failure.message), target.string(),
                    "make room, or write elsewhere");
    }

    std::filesystem::path target;
    AtomicFile pending;
    std::FILE* file = nullptr;
    png_structp png = nullptr;
    png_infop info = nullptr;
    CodecFailure failure;
    PngHead head;
    uint32_t next_row = 0;
};

namespace {

void write_to_file(png_structp png, png_bytep data, png_size_t count)
{
    if (std::fwrite(data, 1, count, static_cast<std::FILE*>(png_get_io_ptr(png))) != count) {
        png_error(png, std::strerror(errno));
    }
}

void flush_nothing(png_structp /*png*/) {}

} // namespace

PngFile::PngFile(const std::filesystem::path& path, uint32_t width, uint32_t height, uint32_t dots_per_m)
    : writer_(std::make_unique<Writer>(path))
{
    Writer& writer = *writer_;
    writer.head = {.width = width, .height = height, .dots_per_m = dots_per_m};
    writer.file = std::fopen(writer.pending.path().c_str(), "wb");
    if (writer.file == nullptr) {
        throw Error(fmt::format("cannot write: {}", std::strerror(errno)), path.string());
    }
    writer.png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &writer.failure, png_failed, png_warned);
    writer.info = writer.png == nullptr ? nullptr : png_create_info_struct(writer.png);
    if (writer.info == nullptr) {
        throw std::bad_alloc();
    }
    if (setjmp(writer.failure.jump) != 0) {
        writer.fail();
    }
    png_set_write_fn(writer.png, writer.file, write_to_file, flush_nothing);
    png_set_user_limits(writer.png, PNG_UINT_31_MAX, PNG_UINT_31_MAX);
    png_write_head(writer.png, writer.info, writer.head);
}

PngFile::~PngFile() = default;

void PngFile::add_rows(std::span<const uint8_t> rgba)
{
    Writer& writer = *writer_;
    const size_t row_bytes = size_t{4} * writer.head.width;
    if (rgba.size() % row_bytes != 0 || rgba.size() / row_bytes > writer.head.height - writer.next_row) {
        throw Error("these are no rows of the picture", writer.target.string());
    }
    if (setjmp(writer.failure.jump) != 0) {
        writer.fail();
    }
    for (size_t at = 0; at < rgba.size(); at += row_bytes) {
        png_write_row(writer.png, rgba.data() + at);
        ++writer.next_row;
    }
}

void PngFile::publish()
{
    Writer& writer = *writer_;
    if (writer.next_row != writer.head.height) {
        throw Error("rows of the picture are missing", writer.target.string());
    }
    if (setjmp(writer.failure.jump) != 0) {
        writer.fail();
    }
    png_write_end(writer.png, writer.info);
    std::FILE* const file = writer.file;
    writer.file = nullptr;
    if (std::fclose(file) != 0) {
        throw Error(fmt::format("cannot write: {}", std::strerror(errno)), writer.target.string(),
                    "make room, or write elsewhere");
    }
    writer.pending.publish();
}

} // namespace estampe
