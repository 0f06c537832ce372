// SPDX-License-Identifier: MIT
#include "features/common/style_tables.hpp"

#include "style/parameter.hpp"

namespace estampe::features {

const style::Table<PictureStyle>& picture_table()
{
    static const auto table =
        style::Table<PictureStyle>("picture", "What stands on the page")
            .choice("ground", &PictureStyle::ground,
                    {{"auto", Ground::automatic}, {"drawn", Ground::drawn}, {"none", Ground::none}},
                    "A blank ground that takes the scene's shadow: drawn, none, or (auto) where the "
                    "scene brings no camera of its own and is no room");
    return table;
}

style::Sheet sheet_of(StyleTables& tables)
{
    style::Sheet sheet;
    sheet.bind(picture_table(), tables.picture);
    sheet.bind(light::light_table(), tables.light);
    sheet.bind(light::sun_table(), tables.sun);
    sheet.bind(shadow::shadow_table(), tables.shadow);
    sheet.bind(lightmap::lightmap_table(), tables.lightmap);
    sheet.bind(occlusion::occlusion_table(), tables.occlusion);
    sheet.bind(subsurface::subsurface_table(), tables.subsurface);
    sheet.bind(light::tone_table(), tables.tone);
    sheet.bind(transparency::transparency_table(), tables.transparency);
    sheet.bind(hatch::hatch_table(), tables.hatch);
    sheet.bind(tam::tam_table(), tables.tam);
    sheet.bind(contour::contour_table(), tables.contour);
    sheet.bind(bleed::bleed_table(), tables.bleed);
    sheet.bind(ink::ink_table(), tables.ink);
    sheet.bind(smoke::smoke_table(), tables.smoke);
    sheet.bind(focus::focus_table(), tables.focus);
    sheet.bind(wash::wash_table(), tables.wash);
    sheet.bind(haze::haze_table(), tables.haze);
    sheet.bind(lens::lens_table(), tables.lens);
    sheet.bind(motion_blur::motion_blur_table(), tables.motion_blur);
    sheet.bind(terrain::drift_table(), tables.drift);
    sheet.bind(cloth::wind_table(), tables.wind);
    sheet.bind(cloth::cloth_table(), tables.cloth);
    sheet.bind(particles::particle_table(), tables.particles);
    sheet.bind(sky::sky_table(), tables.sky);
    sheet.bind(sky::cloud_table(), tables.clouds);
    sheet.bind(paper::paper_table(), tables.paper);
    sheet.bind_overrides(tables.overrides);
    return sheet;
}

} // namespace estampe::features
