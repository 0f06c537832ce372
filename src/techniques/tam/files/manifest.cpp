// SPDX-License-Identifier: MIT
#include <bit>
#include <cmath>
#include <optional>

#include <estampe/error.hpp>
#include <fmt/format.h>

#include "style/raw.hpp"
#include "techniques/tam/files/tam_file.hpp"

namespace estampe::tam {
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

} // namespace estampe::tam
