// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "style/sheet.hpp"
#include "techniques/bleed/bleed.hpp"
#include "techniques/cloth/air/wind_style.hpp"
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
#include "techniques/shadow/shadow_style.hpp"
#include "techniques/sky/clouds/cloud_style.hpp"
#include "techniques/sky/sky.hpp"
#include "techniques/smoke/smoke_style.hpp"
#include "techniques/subsurface/subsurface_style.hpp"
#include "techniques/tam/tam_style.hpp"
#include "techniques/terrain/drift/drift.hpp"
#include "techniques/transparency/transparency.hpp"
#include "techniques/wash/wash.hpp"

namespace estampe::features {

enum class Ground : uint8_t { automatic, drawn, none };

/// What belongs to no technique: what stands on the page.
struct PictureStyle {
    Ground ground = Ground::automatic;
};

[[nodiscard]] const style::Table<PictureStyle>& picture_table();

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
    transparency::TransparencyStyle transparency;
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
[[nodiscard]] style::Sheet sheet_of(StyleTables& tables);

} // namespace estampe::features
