// SPDX-License-Identifier: MIT
#pragma once

// Every parameter of a style, and where single materials and objects are drawn otherwise than the rest.

#include <cstdint>
#include <string>
#include <vector>

#include <estampe/scene.hpp>

#include "features/common/drawing.hpp"
#include "style/schema.hpp"
#include "techniques/bleed/bleed.hpp"
#include "techniques/cloth/cloth_style.hpp"
#include "techniques/contour/contour.hpp"
#include "techniques/focus/focus.hpp"
#include "techniques/hatch/hatch.hpp"
#include "techniques/haze/haze.hpp"
#include "techniques/ink/ink_style.hpp"
#include "techniques/lens/lens.hpp"
#include "techniques/light/daylight.hpp"
#include "techniques/light/light.hpp"
#include "techniques/lightmap/lightmap.hpp"
#include "techniques/motion_blur/motion_blur.hpp"
#include "techniques/occlusion/occlusion.hpp"
#include "techniques/paper/paper.hpp"
#include "techniques/particles/particle_style.hpp"
#include "techniques/pose/mesh_data.hpp"
#include "techniques/shadow/shadow_style.hpp"
#include "techniques/sky/clouds/clouds.hpp"
#include "techniques/sky/sky.hpp"
#include "techniques/smoke/smoke_style.hpp"
#include "techniques/subsurface/subsurface.hpp"
#include "techniques/tam/tam_style.hpp"
#include "techniques/terrain/drift/drift.hpp"
#include "techniques/transparency/transparency.hpp"
#include "techniques/wash/wash.hpp"

namespace estampe::features {

/// What belongs to no technique: what stands on the page.
struct PictureStyle {
    style::AutoToggle ground = style::AutoToggle::automatic;
};

[[nodiscard]] const style::Table<PictureStyle>& picture_table();

/// Every parameter of every technique.
struct StyleTables {
    DrawingStyle drawing;
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
    focus::FocusStyle focus_lines;
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

/// The description of every parameter, made once, with the readers and writers of StyleTables:
/// `style_schema().set(tables, "hatch.width_mm=0.5")`.
[[nodiscard]] const style::Schema<StyleTables>& style_schema();

/// The styles that occur in a picture, and which surface has which.
struct StyleVariants {
    std::vector<StyleTables> styles;       ///< the first is that of the picture
    std::vector<uint32_t> variant_of_draw; ///< numbers of `styles`; empty where there is but one
    /// What is to be found of lines, for whichever variant: kinds have the width of their widest.
    contour::ContourStyle lines;

    [[nodiscard]] bool has_several() const { return styles.size() > 1; }
};

/// Draws of which the same overrides speak share a variant. The list of styles takes `room`. Cost: linear in
/// draws times overrides.
[[nodiscard]] StyleVariants style_variants(const pose::MeshData& meshes, const Scene& scene,
                                           const StyleTables& style, std::vector<StyleTables> room = {});

/// The variant of each node by itself, as `styles` of them: what hangs on a node is meant with it. Cost:
/// linear in nodes times overrides.
[[nodiscard]] StyleVariants style_variants_of_nodes(const Scene& scene, const StyleTables& style);

/// Of the patterns of the style's overrides those that name nothing in the scene, a line each.
[[nodiscard]] std::vector<std::string> idle_overrides(const Scene& scene, const StyleTables& style);

/// Whether a pattern of a style speaks of a node, or of one that it belongs to.
[[nodiscard]] bool is_named(const Scene& scene, Index node, const std::string& pattern);

} // namespace estampe::features
