// SPDX-License-Identifier: MIT
#include "core/zip_writer.hpp"

#include <algorithm>

#include <estampe/error.hpp>
#include <fmt/format.h>
#include <zip.h>

namespace estampe {
namespace {

struct Discard {
    void operator()(zip_t* archive) const { zip_discard(archive); }

    void operator()(zip_source_t* source) const { zip_source_free(source); }
};

} // namespace

struct ZipWriter::Impl {
    [[noreturn]] void fail() const
    {
        throw Error(
            fmt::format("cannot make an archive: {}", zip_error_strerror(zip_get_error(archive.get()))));
    }

    std::unique_ptr<zip_source_t, Discard> source;
    std::unique_ptr<zip_t, Discard> archive;
};

ZipWriter::ZipWriter() : impl_(std::make_unique<Impl>())
{
    zip_error_t error;
    zip_error_init(&error);
    impl_->source.reset(zip_source_buffer_create(nullptr, 0, 0, &error));
    impl_->archive.reset(impl_->source ? zip_open_from_source(impl_->source.get(), ZIP_TRUNCATE, &error)
                                       : nullptr);
    const std::string reason = zip_error_strerror(&error);
    zip_error_fini(&error);
    if (!impl_->archive) {
        throw Error(fmt::format("cannot make an archive: {}", reason));
    }
    zip_source_keep(impl_->source.get());
}

ZipWriter::~ZipWriter() = default;

void ZipWriter::add(const std::string& entry, std::span<const std::byte> bytes, bool compress)
{
    constexpr zip_uint16_t no_time = 0;
    constexpr zip_uint16_t first_of_january_1980 = 0x21;
    zip_t* const archive = impl_->archive.get();
    zip_source_t* data = zip_source_buffer(archive, bytes.data(), bytes.size(), 0);
    const zip_int64_t index =
        data == nullptr ? -1 : zip_file_add(archive, entry.c_str(), data, ZIP_FL_ENC_UTF_8);
    if (index < 0) {
        zip_source_free(data);
        impl_->fail();
    }
    const auto number = static_cast<zip_uint64_t>(index);
    if (zip_set_file_compression(archive, number, compress ? ZIP_CM_DEFLATE : ZIP_CM_STORE, 0) != 0 ||
        zip_file_set_dostime(archive, number, no_time, first_of_january_1980, 0) != 0) {
        impl_->fail();
    }
}

std::vector<std::byte> ZipWriter::finish()
{
    if (zip_close(impl_->archive.get()) != 0) {
        impl_->fail();
    }
    static_cast<void>(impl_->archive.release());
    zip_source_t* source = impl_->source.get();
    if (zip_source_open(source) != 0 || zip_source_seek(source, 0, SEEK_END) != 0) {
        throw Error("cannot make an archive");
    }
    std::vector<std::byte> bytes(static_cast<size_t>(std::max<zip_int64_t>(0, zip_source_tell(source))));
    if (zip_source_seek(source, 0, SEEK_SET) != 0 ||
        zip_source_read(source, bytes.data(), bytes.size()) != static_cast<zip_int64_t>(bytes.size())) {
        throw Error("cannot make an archive");
    }
    zip_source_close(source);
    return bytes;
}

} // namespace estampe
