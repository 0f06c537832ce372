// SPDX-License-Identifier: MIT
#include "frame/tonal_maps.hpp"

#include "techniques/tam/maker.hpp"
#include "techniques/tam/tam_file.hpp"

namespace estampe::frame {

MapChoice map_choice(const StyleTables& style)
{
    return {.file = style.hatch.map,
            .drawn = style.tam,
            .tone = style.hatch.map_tone,
            .contrast = style.hatch.map_contrast};
}

hatch::MapData load_map(const MapChoice& choice)
{
    tam::TonalArtMap map = choice.file.empty() ? tam::make_map(choice.drawn) : tam::load_tam(choice.file);
    std::vector<std::vector<uint8_t>> thresholds = tam::threshold_levels(map);
    return {.size_px = map.size_px,
            .level_of_tone = std::move(map.level_of_tone),
            .threshold_of_level = std::move(thresholds)};
}

} // namespace estampe::frame
