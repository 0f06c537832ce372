// SPDX-License-Identifier: MIT
#include "features/hatching/tonal_maps.hpp"

#include <algorithm>
#include <system_error>

#include <estampe/error.hpp>
#include <fmt/format.h>

#include "core/file.hpp"
#include "core/hash.hpp"
#include "style/sheet.hpp"
#include "techniques/tam/files/folder.hpp"
#include "techniques/tam/files/tam_file.hpp"
#include "techniques/tam/maker.hpp"

namespace estampe::features {
namespace {

tam::TonalArtMap drawn_or_kept(const tam::TamStyle& style)
{
    const std::filesystem::path path = kept_map(style);
    std::error_code missing;
    if (!path.empty() && std::filesystem::exists(path, missing)) {
        try {
            return tam::load_tam(path);
        } catch (const Error&) {
            // Damaged: drawn and kept anew below.
        }
    }
    tam::TonalArtMap map = tam::make_map(style);
    if (!path.empty()) {
        try {
            std::filesystem::create_directories(path.parent_path());
            tam::save_tam(map, path);
        } catch (const std::exception&) {
            // A full or read-only disk costs a second the next time, and nothing else.
        }
    }
    return map;
}

} // namespace

MapChoice map_choice(const StyleTables& style)
{
    return {.file = style.hatch.map,
            .drawn = style.tam,
            .tone = style.hatch.map_tone,
            .contrast = style.hatch.map_contrast};
}

std::filesystem::path kept_map(const tam::TamStyle& style)
{
    const std::filesystem::path folder = user_cache_folder();
    if (folder.empty()) {
        return {};
    }
    tam::TamStyle values = style;
    style::Sheet sheet;
    sheet.bind(tam::tam_table(), values);
    Hash hash;
    hash.add_text(sheet.to_toml());
    return folder / "estampe" / fmt::format("map-{}-{:016x}.tam", tam::drawing_version, hash.value());
}

hatch::MapData load_map(const MapChoice& choice)
{
    tam::TonalArtMap map = choice.file.empty() ? drawn_or_kept(choice.drawn) : tam::read_map(choice.file).map;
    std::vector<std::vector<uint8_t>> thresholds = tam::threshold_levels(map);
    return {.size_px = map.size_px,
            .level_of_tone = std::move(map.level_of_tone),
            .threshold_of_level = std::move(thresholds)};
}

void TonalMaps::ensure(gpu::Device& device, const std::vector<StyleTables>& looks)
{
    place_of_look_.assign(looks.size(), std::nullopt);
    std::vector<Loaded> wanted;
    for (size_t look = 0; look < looks.size(); ++look) {
        const hatch::HatchStyle& hatch = looks[look].hatch;
        if (!hatch.drawn || hatch.strokes != hatch::Strokes::map) {
            continue;
        }
        MapChoice choice = map_choice(looks[look]);
        const auto is_choice = [&](const Loaded& loaded) { return loaded.choice == choice; };
        const auto ready = std::ranges::find_if(wanted, is_choice);
        place_of_look_[look] = static_cast<size_t>(ready - wanted.begin());
        if (ready != wanted.end()) {
            continue;
        }
        if (const auto kept = std::ranges::find_if(maps_, is_choice); kept != maps_.end()) {
            wanted.push_back(std::move(*kept));
            maps_.erase(kept);
        } else {
            hatch::MapImages images =
                hatch::upload_map(device, load_map(choice), choice.tone, choice.contrast);
            wanted.push_back({std::move(choice), std::move(images)});
        }
    }
    maps_ = std::move(wanted);
}

} // namespace estampe::features
