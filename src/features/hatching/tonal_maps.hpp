// SPDX-License-Identifier: MIT
#pragma once

// The tonal art map that a style asks for.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "features/common/style_tables.hpp"
#include "techniques/hatch/map_data.hpp"

namespace estampe::features {

/// What a map depends on.
struct MapChoice {
    std::string file; ///< empty: drawn as `drawn` says
    tam::TamStyle drawn;
    hatch::MapTone tone = hatch::MapTone::order;
    float contrast = 1.0F;

    bool operator==(const MapChoice&) const = default;
};

[[nodiscard]] MapChoice map_choice(const StyleTables& style);

/// Reads the file, or draws the map. A map that was drawn is kept in `estampe` under $XDG_CACHE_HOME, or
/// ~/.cache, and read from there the next time; where that cannot be it is drawn again. Throws Error naming
/// the file when it is not a map, or the style when it cannot be drawn. Cost: about a second to draw 512 px
/// and six tones; 50 ms to read them.
[[nodiscard]] hatch::MapData load_map(const MapChoice& choice);

/// The maps of a picture's looks on the device, kept from picture to picture.
class TonalMaps {
public:
    /// Loads what the styles of looks ask for and is not there yet. Throws Error as load_map().
    void ensure(gpu::Device& device, const std::vector<StyleTables>& looks);

    /// That of a look; null where its strokes come from none.
    [[nodiscard]] hatch::MapImages* of_look(size_t look)
    {
        return place_of_look_.at(look) ? &maps_.at(*place_of_look_[look]).images : nullptr;
    }

private:
    struct Loaded {
        MapChoice choice;
        hatch::MapImages images;
    };

    std::vector<Loaded> maps_;
    std::vector<std::optional<size_t>> place_of_look_;
};

/// Where load_map() keeps the map of `style`; empty when there is no place for it.
[[nodiscard]] std::filesystem::path kept_map(const tam::TamStyle& style);

} // namespace estampe::features
