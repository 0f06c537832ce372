// SPDX-License-Identifier: MIT
#include "core/png_file.hpp"

#include <cerrno>
#include <cstdio>
#include <cstring>

#include <fmt/format.h>

#include <estampe/error.hpp>

#include "core/atomic_file.hpp"
#include "core/codec_failure.hpp"
#include "core/png_head.hpp"

namespace estampe {

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
        throw Error("out of memory");
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
    const size_t rows = rgba.size() / row_bytes;
    if (rgba.size() % row_bytes != 0 || rows > writer.head.height - writer.next_row) {
        throw Error("these are no rows of the picture", writer.target.string());
    }
    if (setjmp(writer.failure.jump) != 0) {
        writer.fail();
    }
    for (size_t row = 0; row < rows; ++row) {
        png_write_row(writer.png, rgba.data() + row_bytes * row);
    }
    writer.next_row += static_cast<uint32_t>(rows);
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
