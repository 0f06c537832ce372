// SPDX-License-Identifier: MIT
// The public door to tonal art maps.
#include <estampe/tonal_art_map.hpp>

#include "features/common/style_tables.hpp"
#include "techniques/tam/files/folder.hpp"
#include "techniques/tam/maker.hpp"
#include "techniques/tam/preview.hpp"

namespace estampe {

TonalArtMap draw_tonal_art_map(const Style& style, const Image* stroke)
{
    return tam::make_map(style.tables().tam, stroke);
}

PaintedMap load_tonal_art_map(const std::filesystem::path& path)
{
    return tam::read_map(path);
}

void save_tonal_art_map(const TonalArtMap& map, const std::filesystem::path& path)
{
    tam::write_map(map, path);
}

bool is_map_folder(const std::filesystem::path& path)
{
    return tam::is_folder_name(path);
}

Image map_sheet(const TonalArtMap& map, const Style& style)
{
    tam::check_map(map, {});
    const paper::PaperStyle& page = style.tables().paper;
    return tam::preview_sheet(map, page.color, page.ink);
}

} // namespace estampe
