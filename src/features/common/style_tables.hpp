// SPDX-License-Identifier: MIT
#pragma once

// Every parameter of a style, and the overrides for single materials and objects.

#include <cstdint>
#include <string>
#include <vector>

#include <estampe/scene.hpp>
#include <estampe/terrain.hpp>

#include "features/common/drawing.hpp"
#include "style/material_kind.hpp"
#include "style/schema.hpp"
#include "style/wind.hpp"
#include "techniques/bleed/bleed.hpp"
#include "techniques/cells/culling_style.hpp"
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
#include "techniques/pigment/pigment.hpp"
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

/// Style parameters of the picture as a whole, which belong to no technique.
struct PictureStyle {
    style::AutoToggle ground = style::AutoToggle::automatic;
};

[[nodiscard]] const style::Table<PictureStyle>& picture_table();

/// A style: the parameters of all techniques, and the overrides for single materials and objects.
struct StyleTables {
    DrawingStyle drawing;
    PictureStyle picture;
    cells::CullingStyle culling;
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
    pigment::PigmentStyle pigment;
    ink::InkStyle ink;
    smoke::SmokeStyle smoke;
    focus::FocusStyle focus_lines;
    wash::WashStyle wash;
    haze::HazeStyle haze;
    lens::LensStyle lens;
    motion_blur::MotionBlurStyle motion_blur;
    terrain::DriftStyle drift;
    wind::WindStyle wind;
    cloth::ClothStyle cloth;
    particles::ParticleStyle particles;
    sky::SkyStyle sky;
    sky::CloudStyle clouds;
    paper::PaperStyle paper;
    std::vector<style::Override> overrides; ///< Parameter values of single materials and objects
};

/// Returns the description of every style parameter; built once. The schema reads and writes StyleTables:
/// `style_schema().set(tables, "hatch.width_mm=0.5")`.
[[nodiscard]] const style::Schema<StyleTables>& style_schema();

/// Limits the files that parameters name: pictures are only read within `scope`.
void limit_files(StyleTables& style, const ReadScope& scope);

/// Copies sections that several features read to the tables of those features: the wind to hatch, clouds,
/// smoke and particles, and the fading of paint and hatching in haze to wash and hatch. If wind.from is auto,
/// the wind of `terrain` (which may be null) replaces that of the style. Returns `style` itself if wind and
/// fading have their default values; otherwise returns `room`, which then holds the changed style. `style`
/// may be `room`.
[[nodiscard]] const StyleTables& with_shared_sections(const StyleTables& style, const Terrain* terrain,
                                                      StyleTables& room);

/// The distinct styles within one picture, and the style of each draw call.
struct StyleVariants {
    /// All distinct styles in the picture; the first is the picture's own style.
    std::vector<StyleTables> styles;
    /// Number of the style in `styles` for each draw call; empty if there is only one style.
    std::vector<uint32_t> variant_of_draw;
    /// The lines to search for, for all style variants together. A kind of line is searched if any variant
    /// draws it, with the largest width of all variants.
    contour::ContourStyle lines;

    [[nodiscard]] bool has_several() const { return styles.size() > 1; }

    /// Returns whether a kind of line has an ink of its own in some style variant.
    [[nodiscard]] bool has_inks_by_kind() const;

    /// Returns whether the device needs the widths and inks of lines for each style variant
    /// (shared::VariantLines).
    [[nodiscard]] bool need_variant_lines() const { return has_several() || has_inks_by_kind(); }
};

/// Finds the style variant of each draw call. Draw calls with the same overrides share a variant; overrides
/// of lights, ink zones and emitters of particles make no variant. The list of styles reuses the memory of
/// `room`. Cost: linear in draw calls times overrides.
[[nodiscard]] StyleVariants style_variants(const pose::MeshData& meshes, const Scene& scene,
                                           const StyleTables& style, std::vector<StyleTables> room = {});

/// Finds the style variant of each node: `variant_of_draw` has one entry per node. An override of a node also
/// applies to the node's descendants. Cost: linear in nodes times overrides.
[[nodiscard]] StyleVariants style_variants_of_nodes(const Scene& scene, const StyleTables& style);

/// Returns the kind of a material of the scene, see style::kind_of().
[[nodiscard]] std::optional<std::string_view> kind_of(const Material& material);

/// Returns one message for each pattern of the style's overrides that matches nothing in the scene. Kinds of
/// material, as in `kind:wood`, need no material. If an override changes lights, its pattern must match a
/// light.
[[nodiscard]] std::vector<std::string> idle_overrides(const Scene& scene, const StyleTables& style);

/// Returns whether a pattern matches the name of a node, or the name of one of the node's ancestors.
[[nodiscard]] bool is_named(const Scene& scene, Index node, const std::string& pattern);

/// Returns whether a pattern matches the name of a light, or the name of a node with that light or of one of
/// its ancestors.
[[nodiscard]] bool is_named_light(const Scene& scene, Index light, const std::string& pattern);

} // namespace estampe::features
