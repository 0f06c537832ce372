// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <memory>
#include <optional>

#include <fmt/format.h>
#include <zip.h>

#include <estampe/error.hpp>

#include "core/file.hpp"
#include "core/image_codec.hpp"
#include "core/zip_writer.hpp"
#include "style/toml.hpp"
#include "techniques/tam/files/map_files.hpp"

namespace estampe::tam {
namespace {

/// Reads a big-endian number from the header of a PNG. The width is stored at byte 16, the height at byte 20.
uint32_t header_number(std::span<const std::byte> png, size_t at)
{
    uint32_t value = 0;
    for (size_t i = 0; i < 4; ++i) {
        value = value << 8U | std::to_integer<uint32_t>(png[at + i]);
    }
    return value;
}

} // namespace

Image picture_of(const Gray8& coverage, uint32_t size_px)
{
    Image picture{.width = size_px, .height = size_px, .rgba = {}};
    picture.rgba.reserve(coverage.size() * 4);
    for (const uint8_t texel : coverage) {
        const auto grey = static_cast<uint8_t>(255 - texel);
        picture.rgba.insert(picture.rgba.end(), {grey, grey, grey, 255});
    }
    return picture;
}

Gray8 coverage_of(const Image& picture)
{
    Gray8 coverage;
    coverage.reserve(picture.rgba.size() / 4);
    for (size_t i = 0; i + 3 < picture.rgba.size(); i += 4) {
        const uint32_t light = (2U * picture.rgba[i] + 5U * picture.rgba[i + 1] + picture.rgba[i + 2]) / 8U;
        coverage.push_back(static_cast<uint8_t>(((255U - light) * picture.rgba[i + 3] + 127U) / 255U));
    }
    return coverage;
}

Square decode_square(std::span<const std::byte> png, const std::string& name)
{
    constexpr std::array<uint8_t, 8> signature{0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n'};
    constexpr size_t header_end = 24;
    const bool is_png =
        png.size() >= header_end &&
        std::equal(signature.begin(), signature.end(), png.begin(),
                   [](uint8_t wanted, std::byte found) { return std::byte{wanted} == found; });
    if (!is_png) {
        throw Error("is not a PNG image", name);
    }
    const uint32_t width = header_number(png, 16);
    const uint32_t height = header_number(png, 20);
    if (width != height || !std::has_single_bit(width) || width > max_size_px) {
        throw Error(fmt::format("is {} x {} pixels", width, height), name,
                    fmt::format("a level is square, its side a power of two up to {}", max_size_px));
    }
    return {width, coverage_of(decode_image(png, name))};
}

namespace {

constexpr int64_t format_version = 1;

[[noreturn]] void refuse(const style::Entry& entry, const std::string& remedy)
{
    throw Error(fmt::format("{}.{} = {} cannot be", entry.section, entry.key, entry.raw.shown),
                entry.value_where, remedy);
}

int64_t whole(const style::Entry& entry, int64_t least, int64_t most)
{
    const auto* value = std::get_if<int64_t>(&entry.raw.value);
    if (value == nullptr || *value < least || *value > most) {
        refuse(entry, fmt::format("allowed: {} to {}", least, most));
    }
    return *value;
}

void read_map_entry(const style::Entry& entry, Manifest& manifest, bool& versioned)
{
    if (entry.key == "version") {
        static_cast<void>(whole(entry, format_version, format_version));
        versioned = true;
    } else if (entry.key == "size_px") {
        manifest.size_px = static_cast<uint32_t>(whole(entry, min_size_px, max_size_px));
        if (!std::has_single_bit(manifest.size_px)) {
            refuse(entry, "a power of two is wanted");
        }
    } else if (entry.key == "thresholds") {
        const auto* value = std::get_if<bool>(&entry.raw.value);
        if (value == nullptr) {
            refuse(entry, "allowed: true or false");
        }
        manifest.has_thresholds = *value;
    } else {
        refuse(entry, "known keys are version, size_px and thresholds");
    }
}

void read_darkness(const style::Entry& entry, Manifest& manifest)
{
    const std::string wanted = fmt::format("tone{}", manifest.darkness.size() + 1);
    if (entry.key != wanted || manifest.darkness.size() >= max_tones) {
        refuse(entry, fmt::format("{} is wanted here, of at most {}", wanted, max_tones));
    }
    const auto* real = std::get_if<double>(&entry.raw.value);
    const float last = manifest.darkness.empty() ? 0.0F : manifest.darkness.back();
    if (real == nullptr || !(static_cast<float>(*real) > last && static_cast<float>(*real) < 1.0F)) {
        refuse(entry, "darkness must rise from tone to tone, between 0 and 1");
    }
    manifest.darkness.push_back(static_cast<float>(*real));
}

} // namespace

std::string image_name(size_t tone, size_t level)
{
    return fmt::format("tone{}_level{}.png", tone + 1, level);
}

std::string manifest_of(const TonalArtMap& map)
{
    std::string text = fmt::format(
        "# A tonal art map: strokes that nest from tone to tone and from level to level. Black is ink.\n"
        "[map]\nversion = {}\nsize_px = {}\nthresholds = {}\n\n"
        "[darkness] # mean ink of each tone\n",
        format_version, map.size_px, !map.threshold_of_level.empty());
    for (size_t tone = 0; tone < map.darkness.size(); ++tone) {
        text += fmt::format("tone{} = {:#.9g}\n", tone + 1, map.darkness[tone]);
    }
    return text;
}

Manifest parse_manifest(const std::string& text, const std::string& name)
{
    Manifest manifest;
    bool versioned = false;
    for (const style::Entry& entry : style::parse_toml(text, name).entries) {
        if (entry.section == "map") {
            read_map_entry(entry, manifest, versioned);
        } else if (entry.section == "darkness") {
            read_darkness(entry, manifest);
        } else {
            throw Error(fmt::format("unknown key {}", style::in_quotes(entry.key)), entry.key_where,
                        "sections are [map] and [darkness]");
        }
    }
    if (!versioned || manifest.size_px == 0 || manifest.darkness.size() < min_tones) {
        throw Error("version, size_px or the darknesses are missing", name,
                    "[map] names version and size_px, [darkness] each tone");
    }
    return manifest;
}

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

/// A zip archive in memory, opened for reading.
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
        static_cast<void>(source.release()); // the archive now owns the source and frees it
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

/// Converts thresholds to a picture and back: in the picture, texels that turn to ink first are black.
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

TonalArtMap load_tam(const std::filesystem::path& path, const ReadScope& scope)
{
    return decode_tam(read_file(path, max_file_bytes, scope), path.string());
}

} // namespace estampe::tam
