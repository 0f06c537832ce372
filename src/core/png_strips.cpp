// SPDX-License-Identifier: MIT
#include "core/png_strips.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <future>
#include <thread>

#include <zlib.h>

#include <estampe/error.hpp>

#include "core/at_once.hpp"
#include "core/png_head.hpp"

namespace estampe {
namespace {

constexpr uint64_t strip_bytes = 1U << 20U;                       // of rows, or a single row
constexpr size_t window_bytes = 32768;                            // how far deflate looks back
constexpr std::array zlib_head{std::byte{0x78}, std::byte{0x5e}}; // a window of that size, a fast level

/// Rows ready to deflate: each behind the number of its filter, each byte less the one a pixel before it.
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
            throw Error("out of memory");
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

/// All strips, by as many threads as there are cores.
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
        others.push_back(std::async(at_once, work));
    }
    work();
    for (std::future<void>& other : others) {
        other.get();
    }
    return strips;
}

} // namespace

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

} // namespace estampe
