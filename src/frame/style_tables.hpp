// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "style/sheet.hpp"
#include "techniques/bleed/bleed.hpp"
#include "techniques/cloth/wind_style.hpp"
#include "techniques/contour/contour.hpp"
#include "techniques/focus/focus.hpp"
#include "techniques/hatch/hatch.hpp"
#include "techniques/haze/haze.hpp"
#include "techniques/ink/ink_style.hpp"
#include "techniques/lens/lens_style.hpp"
#include "techniques/light/light_style.hpp"
#include "techniques/light/sun_style.hpp"
#include "techniques/lightmap/lightmap.hpp"
#include "techniques/motion_blur/motion_blur_style.hpp"
#include "techniques/occlusion/occlusion_style.hpp"
#include "techniques/paper/paper.hpp"
#include "techniques/particles/particle_style.hpp"
#include "techniques/screen/screen.hpp"
#include "techniques/shadow/shadow_style.hpp"
#include "techniques/sky/clouds/cloud_style.hpp"
#include "techniques/sky/sky.hpp"
#include "techniques/smoke/smoke_style.hpp"
#include "techniques/subsurface/subsurface_style.hpp"
#include "techniques/tam/tam_style.hpp"
#include "techniques/terrain/drift/drift.hpp"
#include "techniques/wash/wash.hpp"

namespace estampe::frame {

enum class Ground : uint8_t { automatic, drawn, none };

/// What belongs to no technique: what stands on the page.
struct PictureStyle {
    Ground ground = Ground::automatic;
};

inline const style::Table<PictureStyle>& picture_table()
{
    static const auto table =
        style::Table<PictureStyle>("picture", "What stands on the page")
            .choice("ground", &PictureStyle::ground,
                    {{"auto", Ground::automatic}, {"drawn", Ground::drawn}, {"none", Ground::none}},
                    "A blank ground that takes the scene's shadow: drawn, none, or (auto) where the "
                    "scene brings no camera of its own and is no room");
    return table;
}

/// Every parameter of every technique.
struct StyleTables {
    PictureStyle picture;
    light::LightStyle light;
    light::SunStyle sun;
    shadow::ShadowStyle shadow;
    lightmap::LightmapStyle lightmap;
    occlusion::OcclusionStyle occlusion;
    subsurface::SubsurfaceStyle subsurface;
    light::ToneStyle tone;
    screen::ScreenStyle screen;
    hatch::HatchStyle hatch;
    tam::TamStyle tam;
    contour::ContourStyle contour;
    bleed::BleedStyle bleed;
    ink::InkStyle ink;
    smoke::SmokeStyle smoke;
    focus::FocusStyle focus;
    wash::WashStyle wash;
    haze::HazeStyle haze;
    lens::LensStyle lens;
    motion_blur::MotionBlurStyle motion_blur;
    terrain::DriftStyle drift;
    cloth::WindStyle wind;
    cloth::ClothStyle cloth;
    particles::ParticleStyle particles;
    sky::SkyStyle sky;
    sky::CloudStyle clouds;
    paper::PaperStyle paper;
    std::vector<style::Override> overrides; ///< what single materials and objects have otherwise
};

/// The readers and writers of `tables`, which must outlive the sheet.
[[nodiscard]] inline style::Sheet sheet_of(StyleTables& tables)
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
    sheet.bind(screen::screen_table(), tables.screen);
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

} // namespace estampe::frame
