// SPDX-License-Identifier: MIT
#pragma once

// Lighting of each pixel: the sun with its shadow, and any number of local lights, culled per tile. Also the
// style's sections `light` and `tone`.

#include <optional>
#include <vector>

#include <estampe/scene.hpp>

#include "gpu/graph/graph.hpp"
#include "scene/view_analysis/view_analysis.hpp"
#include "shaders/tone.glsl.h"
#include "style/parameter.hpp"
#include "techniques/light/light.glsl.h"

namespace estampe::light {

enum class LightSource : uint8_t { automatic, scene, sun };

/// Source of the exposure: the scene's lights, the page's brightness, or a value of the style.
enum class Metering : uint8_t { lights, page, manual };

/// The decrease of the file's lights with distance: as in the file, or by one of the laws of LightFalloff.
enum class Attenuation : uint8_t { file, inverse_square, unit_volume };

/// The lit volume of spots: as in the file, or one of SpotShape.
enum class SpotVolume : uint8_t { file, cone, pyramid };

/// Changes to lights and objects of a file. The picture's values apply to all lights and objects, and
/// overrides to single ones. The defaults change nothing.
struct LightChanges {
    bool enabled = true;
    float intensity = 1.0F; ///< factor on the light's intensity
    float range_m = -1.0F;  ///< range of the light; -1: as in the file
    float radius_m = -1.0F; ///< radius of the light; -1: as in the file
    Attenuation attenuation = Attenuation::file;
    SpotVolume spot_volume = SpotVolume::file;
    bool receives_shadows = true;
    std::string groups;        ///< numbers of the light groups, such as "1+3"; empty: as in the file
    std::string shadow_groups; ///< numbers of the groups that cast shadows; empty: as in the file

    bool operator==(const LightChanges&) const = default;
};

struct LightStyle {
    LightSource source = LightSource::automatic;
    float sun_azimuth_deg = house_sun_azimuth_deg;
    float sun_elevation_deg = house_sun_elevation_deg;
    bool turn_sun = true;
    Metering metering = Metering::lights;
    float exposure_stops = 0.0F;
    float ev100 = 10.0F;
    float adapt_stops_per_s = 0.0F;
    float ambient = 0.15F;
    float fill = 0.2F;
    float falloff = 0.62F;
    float paling = 0.5F;
    bool shadows = true;
    int shadow_size = 0;
    LightChanges changes;
};

[[nodiscard]] const style::Table<LightStyle>& light_table();

enum class ToneCurve : uint8_t {
    gamma = shared::tone_gamma,
    linear = shared::tone_linear,
    filmic = shared::tone_filmic
};

struct ToneStyle {
    ToneCurve curve = ToneCurve::gamma;
    float exposure = 1.14F;
    float gamma = 0.8F;
    float contrast = 1.05F;
    float floor = 0.12F;
    float ceiling = 0.97F;
    float local_value = 0.3F;
    float occlusion = 1.0F;
};

[[nodiscard]] const style::Table<ToneStyle>& tone_table();

/// The lights of a frame. Directional lights come first; the strongest directional light, the sun, casts the
/// shadow.
struct Lighting {
    std::vector<shared::LightRecord> records;
    uint32_t directional_count = 0;
    /// Direction towards the first directional light; straight up without one.
    glm::dvec3 towards_sun{0.0, 1.0, 0.0};
    glm::vec3 ambient{0.0F};
    float exposure = 1.0F;           ///< factor on the intensities of the scene's lights
    Groups sun_casters = all_groups; ///< object groups that cast shadows in the first directional light
    bool has_groups = false;         ///< some light does not light all object groups
    bool indoors = false;            ///< the only light is the default lighting of an interior
};

/// The brightness on which the exposure is based, and the scene from which the brightness was computed, kept
/// from frame to frame.
struct ExposureKeyCache {
    std::vector<shared::LightRecord> records;
    ScenePose pose;
    glm::dvec3 anchor{0.0};
    float key = 1.0F;
    std::vector<shared::LightRecord> room; ///< spare memory for the records of the next Lighting
};

/// Places the scene's lights in anchor space (scene coordinates relative to a point near the camera). A scene
/// without lights gets the style's sun, which turns with the front of the `analysis`; an interior gets a
/// lamp, and daylight through an opening. Intensities (lux, candela) are scaled so that the scene's well-lit
/// parts reach about one in any unit. A light without a range ends where the light falls below 1/400 of the
/// well-lit parts' light. Cost: linear in lights times visible nodes, unless the exposure is manual or
/// `memory` holds the unchanged scene.
[[nodiscard]] Lighting gather_lights(const Scene& scene, const ScenePose& pose, const Bounds& bounds,
                                     const glm::dvec3& anchor, const LightStyle& style,
                                     const ViewAnalysis& analysis = {}, ExposureKeyCache* memory = nullptr);

/// Lightening of the sun's shadow on blank ground, as a share of sunlight. The lightening grows linearly from
/// 0 below the middle of the scene to `most` at the end of the shadow of the scene's bounds. So the shadow is
/// darkest at the foot of the object, as in drawings.
struct Paling {
    glm::vec3 share_per_m{0.0F};
    float share_at_anchor = 0.0F;
};

[[nodiscard]] Paling ground_paling(const Bounds& bounds, const glm::dvec3& anchor,
                                   const glm::dvec3& towards_sun, float most);

/// Ambient light on surfaces that face up (sky) and down (ground).
struct SkyAndGround {
    glm::vec3 sky{0.0F};
    glm::vec3 ground{0.0F};
};

/// Splits a share of ambient light into two: a quarter brighter from above, a quarter darker from below.
[[nodiscard]] SkyAndGround sky_and_ground(const glm::vec3& ambient, float share = 1.0F);

/// Converts the style's tone curve to shader constants.
[[nodiscard]] shared::ToneConstants tone_constants(const ToneStyle& style);

/// The shadow maps of all lights, and the data for looking up the maps.
struct ShadowMaps {
    gpu::BufferId sun;           ///< the sun's shadow map: reversed depth, row by row
    gpu::BufferId sun_globals;   ///< SunShadow record, see shadow/shadow.glsl.h
    gpu::BufferId local;         ///< shadow maps of all local lights: near distance over distance
    gpu::BufferId local_shadows; ///< LocalShadow records, see shadow/shadow.glsl.h
    gpu::BufferId edge_profile;  ///< EdgeProfile record, see shadow/shadow.glsl.h
    bool has_sun = false;
    bool has_local = false;
    uint32_t variant = 0; ///< bits of the lighting shader for shadows, see shadow/shadow_style.hpp
};

struct LightInputs {
    gpu::BufferId frame;    ///< buffer with a FrameGlobals record
    gpu::BufferId lighting; ///< buffer with a LightGlobals record
    gpu::BufferId lights;   ///< buffer of LightRecord
    gpu::ImageId draw;
    gpu::ImageId depth;
    gpu::ImageId normal;
    gpu::BufferId draws;
    gpu::BufferId materials;
    gpu::ImageId coordinate;
    gpu::ImageId footprint;
    ShadowMaps shadows;
    std::optional<gpu::ImageId> lightmap; ///< baked light; replaces ambient light where alpha is 1
    /// r16f: share of sunlight that terrain, smoke and clouds let through.
    std::optional<gpu::ImageId> sun_share;
    std::optional<gpu::ImageId> occlusion; ///< ambient visibility per pixel, from a technique of occlusion
    bool occludes_all = false;             ///< occlusion darkens all light, not only ambient light
    std::optional<gpu::ImageId> bounced;   ///< light that occluders reflect, as a share of ambient light
    /// Positions of points to light, in anchor space (scene coordinates relative to a point near the camera).
    /// If set, positions are not computed from depth.
    std::optional<gpu::ImageId> points;
    std::optional<gpu::BufferId> tiles; ///< list of the tiles to light, see shaders/tiles.glsl.h; empty: all
    uint32_t local_count = 0; ///< number of point and spot lights, which follow the directional lights
    bool has_emissive = false;
    bool keeps_strongest = false; ///< also outputs the direction of the strongest light
    bool keeps_sun = false;       ///< also outputs the visible share of the first directional light
    bool counts_visits = false;   ///< for tests: writes numbers of local lights, not light: how many are
                                  ///< tested, and how many are in range
    bool looks_at_all = false;    ///< tests every light at every pixel, as a reference
    bool has_links = false;       ///< a light lights only the draw calls that share a group with the light
    glm::uvec2 size_px{0};
};

struct LitPixels {
    /// rgba16f: irradiance divided by pi, at most 65504, and in alpha the luminance of that value; 1 for
    /// unlit materials and the background.
    gpu::ImageId light;
    /// r32ui: octahedral direction towards the strongest light if that light is local, else 0; an image of
    /// one texel unless `keeps_strongest`.
    gpu::ImageId strongest;
    /// r32f: share of the first directional light that is not in shadow; negative where there is no
    /// directional light, or where the light only grazes the surface; an image of one texel unless
    /// `keeps_sun`.
    gpu::ImageId sun;
};

/// Adds passes that light the visible surfaces.
///
/// Cost    one full-screen dispatch; local lights cost only where they reach. From 65 local lights on, a
///         small dispatch first lists them for large tiles, linear in lights and tiles of 64 pixels
/// Source  tiled culling after Olsson and Assarsson, "Tiled Shading", 2011; the depth mask after Harada, "A
///         2.5D Culling for Forward+", 2012
[[nodiscard]] LitPixels add_light(gpu::Graph& graph, const LightInputs& in);

} // namespace estampe::light
