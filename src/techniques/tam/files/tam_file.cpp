// SPDX-License-Identifier: MIT
#include "techniques/tam/files/tam_file.hpp"

#include <algorithm>
#include <memory>

#include <estampe/error.hpp>
#include <fmt/format.h>
#include <zip.h>

#include "core/file.hpp"
#include "core/image_codec.hpp"
#include "core/zip_writer.hpp"
#include "techniques/tam/files/images.hpp"

namespace estampe::tam {
namespace {

constexpr const char* manifest_entry = "tam.toml";
constexpr uint64_t max_manifest_bytes = uint64_t{1} << 16;
constexpr uint64_t max_entry_bytes = uint64_t{1} << 25;
constexpr uint64_t max_file_bytes = uint64_t{1} << 29;
constexpr zip_int64_t max_entries = 1024;

struct Discard {
    void operator()(zip_t* archive) const { zip_discard(archive); }

    void operator()(zip_source_t* source) const { zip_source_free(source); }

    void operator()(zip_file_t* file) const { zip_fclose(file); }
};

using Archive = std::unique_ptr<zip_t, Discard>;
using ZipSource = std::unique_ptr<zip_source_t, Discard>;
using ZipFile = std::unique_ptr<zip_file_t, Discard>;

std::string threshold_name(size_t level)
{
    return fmt::format("threshold_level{}.png", level);
}

std::string text_of(zip_error_t& error)
{
    std::string text = zip_error_strerror(&error);
    zip_error_fini(&error);
    return text;
}

/// A zip archive that is read from memory.
class ZipReader {
public:
    ZipReader(std::span<const std::byte> bytes, std::string name) : name_(std::move(name))
    {
        zip_error_t error;
        zip_error_init(&error);
        ZipSource source(zip_source_buffer_create(bytes.data(), bytes.size(), 0, &error));
        archive_.reset(source ? zip_open_from_source(source.get(), ZIP_RDONLY | ZIP_CHECKCONS, &error)
                              : nullptr);
        if (!archive_) {
            throw Error(fmt::format("is not a .tam file, or a damaged one: {}", text_of(error)), name_,
                        "estampe tam writes one anew");
        }
        static_cast<void>(source.release()); // the archive frees it
        zip_error_fini(&error);
        if (zip_get_num_entries(archive_.get(), 0) > max_entries) {
            throw Error(fmt::format("holds more than {} files", max_entries), name_);
        }
    }

    [[nodiscard]] std::string place(const std::string& entry) const { return name_ + "#/" + entry; }

    [[nodiscard]] std::vector<std::byte> read(const std::string& entry, uint64_t max_bytes)
    {
        zip_stat_t status;
        zip_stat_init(&status);
        if (zip_stat(archive_.get(), entry.c_str(), 0, &status) != 0 || (status.valid & ZIP_STAT_SIZE) == 0) {
            throw Error("is missing", place(entry), "every tone needs an image for every level");
        }
        if (status.size > max_bytes) {
            throw Error(fmt::format("is {} bytes long, more than the limit of {}", status.size, max_bytes),
                        place(entry));
        }
        const ZipFile file(zip_fopen(archive_.get(), entry.c_str(), 0));
        std::vector<std::byte> bytes(status.size + 1);
        uint64_t filled = 0;
        for (zip_int64_t count = file ? 1 : -1; count != 0; filled += static_cast<uint64_t>(count)) {
            count = file ? zip_fread(file.get(), bytes.data() + filled, bytes.size() - filled) : -1;
            if (count < 0 || filled + static_cast<uint64_t>(count) > status.size) {
                throw Error("is damaged, or packed in a way that cannot be read", place(entry));
            }
        }
        bytes.resize(filled);
        return bytes;
    }

private:
    std::string name_;
    Archive archive_;
};

/// In a picture of thresholds what turns to ink first is black.
Gray8 inverted(Gray8 image)
{
    std::transform(image.begin(), image.end(), image.begin(),
                   [](uint8_t texel) { return static_cast<uint8_t>(255 - texel); });
    return image;
}

Gray8 read_level(ZipReader& archive, const std::string& entry, uint32_t size_px)
{
    Square square = decode_square(archive.read(entry, max_entry_bytes), archive.place(entry));
    if (square.size_px != size_px) {
        throw Error(fmt::format("is {} px wide", square.size_px), archive.place(entry),
                    fmt::format("this level is {} px", size_px));
    }
    return std::move(square.coverage);
}

} // namespace

std::vector<std::byte> encode_tam(const TonalArtMap& map)
{
    check_map(map, {});
    const std::string manifest = manifest_of(map);
    std::vector<std::pair<std::string, std::vector<std::byte>>> images;
    const auto add = [&](const std::string& name, const Gray8& image, size_t level) {
        images.emplace_back(name, encode_png(picture_of(image, map.size_px >> level)));
    };
    for (size_t tone = 0; tone < map.level_of_tone.size(); ++tone) {
        for (size_t level = 0; level < map.level_of_tone[tone].size(); ++level) {
            add(image_name(tone, level), map.level_of_tone[tone][level], level);
        }
    }
    for (size_t level = 0; level < map.threshold_of_level.size(); ++level) {
        add(threshold_name(level), inverted(map.threshold_of_level[level]), level);
    }
    ZipWriter archive;
    archive.add(manifest_entry, std::as_bytes(std::span(manifest)), true);
    for (const auto& [name, bytes] : images) {
        archive.add(name, bytes, false);
    }
    return archive.finish();
}

TonalArtMap decode_tam(std::span<const std::byte> bytes, const std::string& name)
{
    ZipReader archive(bytes, name);
    const std::vector<std::byte> text = archive.read(manifest_entry, max_manifest_bytes);
    const Manifest manifest = parse_manifest(
        std::string(reinterpret_cast<const char*>(text.data()), text.size()), archive.place(manifest_entry));
    TonalArtMap map;
    map.size_px = manifest.size_px;
    map.darkness = manifest.darkness;
    const size_t levels = level_count(map.size_px);
    for (size_t tone = 0; tone < map.darkness.size(); ++tone) {
        std::vector<Gray8>& images = map.level_of_tone.emplace_back();
        for (size_t level = 0; level < levels; ++level) {
            images.push_back(read_level(archive, image_name(tone, level), map.size_px >> level));
        }
    }
    for (size_t level = 0; manifest.has_thresholds && level < levels; ++level) {
        map.threshold_of_level.push_back(
            inverted(read_level(archive, threshold_name(level), map.size_px >> level)));
    }
    check_map(map, name);
    return map;
}

void save_tam(const TonalArtMap& map, const std::filesystem::path& path)
{
    write_file_atomically(path, encode_tam(map));
}

TonalArtMap load_tam(const std::filesystem::path& path)
{
    return decode_tam(read_file(path, max_file_bytes), path.string());
}

} // namespace estampe::tam
