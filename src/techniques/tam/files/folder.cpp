// SPDX-License-Identifier: MIT
#include "techniques/tam/files/map_files.hpp"

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <map>
#include <optional>
#include <system_error>

#include <fcntl.h>
#include <unistd.h>

#include <fmt/format.h>

#include <estampe/error.hpp>

#include "core/child/child.hpp"
#include "core/file.hpp"
#include "core/image_codec.hpp"
#include "core/read_scope.hpp"
#include "techniques/tam/painted/painted_strokes.hpp"

namespace estampe {

// Lists of members, for send() and receive() of core/child/exchange.hpp.

template <Either<TonalArtMap> T>
auto members(T& map)
{
    auto& [size_px, darkness, level_of_tone, threshold_of_level] = map;
    return std::tie(size_px, darkness, level_of_tone, threshold_of_level);
}

template <Either<PaintedMap> T>
auto members(T& painted)
{
    auto& [map, warnings] = painted;
    return std::tie(map, warnings);
}

} // namespace estampe

namespace estampe::tam {
namespace {

namespace fs = std::filesystem;

constexpr const char* manifest_name = "tam.toml";
constexpr uint64_t max_image_bytes = uint64_t{1} << 27;
constexpr const char* naming =
    "name them tone1.png, tone2.png, ... or tone1_level0.png, tone1_level1.png, ...";

/// Returns the numbers in a file name without extension, from left to right. For "tone1_level0", returns {1,
/// 0}.
std::vector<size_t> numbers_in(const std::string& stem)
{
    constexpr size_t most = 100000;
    std::vector<size_t> numbers;
    bool inside = false;
    for (const char letter : stem) {
        if (std::isdigit(static_cast<unsigned char>(letter)) == 0) {
            inside = false;
            continue;
        }
        if (!inside) {
            numbers.push_back(0);
        }
        inside = true;
        numbers.back() = std::min(most, numbers.back() * 10 + static_cast<size_t>(letter - '0'));
    }
    return numbers;
}

/// Image files, sorted by the numbers of tone and mip level in their names. A file name with only one number
/// is level 0 of that tone.
using Placed = std::map<std::pair<size_t, size_t>, fs::path>;

Placed placed_files(const fs::path& folder, const std::string& extension)
{
    Placed placed;
    std::optional<size_t> numbers_wanted;
    std::error_code failure;
    fs::directory_iterator entries(folder, failure);
    if (failure) {
        throw Error(fmt::format("cannot read this folder: {}", failure.message()), folder.string());
    }
    for (const fs::directory_entry& entry : entries) {
        const fs::path& file = entry.path();
        if (lower_extension(file) != extension || file.stem().string().starts_with("threshold")) {
            continue;
        }
        const std::vector<size_t> numbers = numbers_in(file.stem().string());
        if (numbers.empty() || numbers.size() > 2 ||
            numbers.size() != numbers_wanted.value_or(numbers.size())) {
            throw Error("does not tell tone and level as the other names do", file.string(), naming);
        }
        numbers_wanted = numbers.size();
        const std::pair<size_t, size_t> place(numbers[0], numbers.size() == 2 ? numbers[1] : 0);
        if (!placed.emplace(place, file).second) {
            throw Error(fmt::format("is the same tone and level as {}", placed[place].filename().string()),
                        file.string(), naming);
        }
    }
    return placed;
}

PaintedMap read_png_folder(const fs::path& folder, const Placed& files, const ReadScope& scope)
{
    std::vector<std::vector<Gray8>> level_of_tone;
    std::optional<size_t> tone;
    uint32_t size_px = 0;
    for (const auto& [place, file] : files) {
        if (place.first != tone) {
            level_of_tone.emplace_back();
            tone = place.first;
        }
        std::vector<Gray8>& levels = level_of_tone.back();
        if (place.second != levels.size()) {
            throw Error(fmt::format("level {} of this tone is missing", levels.size()), file.string(),
                        "levels count from 0, the finest, without a gap");
        }
        Square square = decode_square(read_file(file, max_image_bytes, scope), file.string());
        size_px = size_px == 0 ? square.size_px : size_px;
        if (levels.size() >= level_count(size_px) || square.size_px != size_px >> levels.size()) {
            throw Error(
                fmt::format("is {} px wide", square.size_px), file.string(),
                fmt::format("level 0 is {} px, and each level half as wide as the one before", size_px));
        }
        levels.push_back(std::move(square.coverage));
    }
    std::vector<float> darkness;
    if (const fs::path manifest = folder / manifest_name; fs::exists(manifest)) {
        const std::vector<std::byte> text = read_file(manifest, uint64_t{1} << 16, scope);
        darkness = parse_manifest(std::string(reinterpret_cast<const char*>(text.data()), text.size()),
                                  manifest.string())
                       .darkness;
    }
    return complete_map(std::move(level_of_tone), size_px, std::move(darkness), folder.string());
}

PaintedMap read_dds_folder(const fs::path& folder, const Placed& files, const ReadScope& scope)
{
    std::vector<std::vector<Gray8>> level_of_tone;
    uint32_t size_px = 0;
    for (const auto& [place, file] : files) {
        DdsImages images = decode_dds(read_file(file, max_image_bytes, scope), file.string());
        size_px = size_px == 0 ? images.size_px : size_px;
        if (images.level_of_layer.size() != 1 || images.size_px != size_px) {
            throw Error(fmt::format("has {} layers of {} px", images.level_of_layer.size(), images.size_px),
                        file.string(), "in a folder each DDS file is one tone, all as large");
        }
        level_of_tone.push_back(std::move(images.level_of_layer.front()));
    }
    return complete_map(std::move(level_of_tone), size_px, {}, folder.string());
}

/// Throws Error if the folder cannot be read or lies outside of `scope`.
void check_folder(const fs::path& folder, const ReadScope& scope)
{
    const int opened = open_to_read(folder, scope, O_RDONLY | O_DIRECTORY);
    if (opened < 0) {
        throw Error(fmt::format("cannot read this folder: {}", std::generic_category().message(errno)),
                    folder.string());
    }
    close(opened);
}

PaintedMap read_folder(const fs::path& folder, const ReadScope& scope)
{
    check_folder(folder, scope);
    const Placed pictures = placed_files(folder, ".png");
    const Placed textures = placed_files(folder, ".dds");
    if (pictures.empty() == textures.empty()) {
        throw Error(pictures.empty() ? "holds no PNG or DDS files" : "holds both PNG and DDS files",
                    folder.string(), naming);
    }
    return pictures.empty() ? read_dds_folder(folder, textures, scope)
                            : read_png_folder(folder, pictures, scope);
}

/// Adds to each tone the ink of all lighter tones, so that a darker tone never has less ink at any texel.
void nest(PaintedMap& painted)
{
    constexpr double worth_a_word = 0.001;
    std::vector<std::vector<Gray8>>& tones = painted.map.level_of_tone;
    for (size_t tone = 1; tone < tones.size(); ++tone) {
        size_t ink = 0;
        size_t lacking = 0;
        for (size_t level = 0; level < tones[tone].size(); ++level) {
            for (size_t texel = 0; texel < tones[tone][level].size(); ++texel) {
                const uint8_t lighter = tones[tone - 1][level][texel];
                uint8_t& darker = tones[tone][level][texel];
                ink += lighter > 127 ? 1 : 0;
                lacking += lighter > 127 && darker <= 127 ? 1 : 0;
                darker = std::max(darker, lighter);
            }
        }
        if (static_cast<double>(lacking) > worth_a_word * static_cast<double>(ink)) {
            painted.warnings.push_back(
                fmt::format("tone {} lacked {:.1f} % of the ink of tone {}: added", tone + 1,
                            100.0 * static_cast<double>(lacking) / static_cast<double>(ink), tone));
        }
    }
}

void write_folder(const TonalArtMap& map, const fs::path& folder)
{
    const std::string manifest = manifest_of(map);
    write_file_atomically(folder / manifest_name, std::as_bytes(std::span(manifest)));
    for (size_t tone = 0; tone < map.level_of_tone.size(); ++tone) {
        for (size_t level = 0; level < map.level_of_tone[tone].size(); ++level) {
            save_png(picture_of(map.level_of_tone[tone][level], map.size_px >> level),
                     folder / image_name(tone, level));
        }
    }
}

void write_folder_at_once(const TonalArtMap& map, fs::path folder)
{
    if (!folder.has_filename()) {
        folder = folder.parent_path();
    }
    std::error_code failure;
    if (fs::exists(folder, failure) && !fs::is_empty(folder, failure)) {
        throw Error("exists and is not empty", folder.string(),
                    "remove it, or give the name of a new folder");
    }
    AtomicFile pending = AtomicFile::folder(folder);
    write_folder(map, pending.path());
    fs::permissions(pending.path(), fs::perms(0755), failure);
    pending.publish();
}

} // namespace

PaintedMap complete_map(std::vector<std::vector<Gray8>> level_of_tone, uint32_t size_px,
                        std::vector<float> darkness, const std::string& where)
{
    if (level_of_tone.empty() || level_of_tone.size() > max_tones || size_px < min_size_px) {
        throw Error(
            fmt::format("holds {} tones of {} px", level_of_tone.size(), size_px), where,
            fmt::format("allowed: 1 to {} tones of {} to {} px", max_tones, min_size_px, max_size_px));
    }
    PaintedMap painted;
    TonalArtMap& map = painted.map;
    map.size_px = size_px;
    map.level_of_tone = std::move(level_of_tone);
    size_t painted_levels = level_count(size_px);
    for (const std::vector<Gray8>& levels : map.level_of_tone) {
        painted_levels = std::min(painted_levels, levels.size());
    }
    for (std::vector<Gray8>& levels : map.level_of_tone) {
        levels.resize(painted_levels);
    }
    nest(painted);
    const bool measured = darkness.empty();
    for (size_t tone = 0; measured && tone < map.level_of_tone.size(); ++tone) {
        map.darkness.push_back(static_cast<float>(mean_coverage(map.level_of_tone[tone].front())));
        if (map.darkness[tone] >= 1.0F || map.darkness[tone] <= (tone == 0 ? 0.0F : map.darkness[tone - 1])) {
            throw Error(fmt::format("tone {} has {:.1f} % ink, no more than the tone before it, or all",
                                    tone + 1, 100.0F * map.darkness[tone]),
                        where, "tones must darken in the order of their numbers, black on white");
        }
    }
    if (!measured) {
        map.darkness = std::move(darkness);
    }
    if (painted_levels < level_count(size_px)) {
        derive_levels(map);
        painted.warnings.push_back(
            fmt::format("levels of {} px and less were derived", size_px >> painted_levels));
    }
    check_map(map, where);
    return painted;
}

namespace {

PaintedMap decode_map(const fs::path& path, const ReadScope& scope)
{
    constexpr uint64_t max_file_bytes = uint64_t{1} << 29;
    if (fs::is_directory(path)) {
        return read_folder(path, scope);
    }
    if (lower_extension(path) == ".tam") {
        return {load_tam(path, scope), {}};
    }
    if (lower_extension(path) == ".dds") {
        DdsImages images = decode_dds(read_file(path, max_file_bytes, scope), path.string());
        return complete_map(std::move(images.level_of_layer), images.size_px, {}, path.string());
    }
    static_cast<void>(read_file(path, max_file_bytes, scope)); // throws an Error if the file does not exist
    throw Error("is no tonal art map", path.string(), "give a folder of PNG files, a .dds or a .tam file");
}

} // namespace

PaintedMap read_map(const fs::path& path, const ReadScope& scope)
{
    PaintedMap painted =
        run_in_child([&] { return decode_map(path, scope); }, limits_for_file(path, scope), path.string());
    check_map(painted.map, path.string());
    return painted;
}

bool is_folder_name(const fs::path& path)
{
    return !path.has_filename() || fs::is_directory(path) || path.extension().empty();
}

void write_map(const TonalArtMap& map, const fs::path& path)
{
    check_map(map, {});
    if (is_folder_name(path)) {
        write_folder_at_once(map, path);
    } else if (lower_extension(path) == ".dds") {
        write_file_atomically(path, encode_dds(map));
    } else {
        save_tam(map, path);
    }
}

} // namespace estampe::tam
