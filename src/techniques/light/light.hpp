// SPDX-License-Identifier: MIT
#pragma once

// Lighting of each pixel: the sun with its shadow, and any number of local lights, culled per tile; and the
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

/// Determines the exposure: from the scene's lights, from the page's brightness, or from the style.
enum class Metering : uint8_t { lights, page, manual };

/// How the lights of a file decrease with distance: as the file says, or by one of the laws of LightFalloff.
enum class Attenuation : uint8_t { file, inverse_square, unit_volume };

/// The lit volume of a spot: as the file says, or one of SpotShape.
enum class SpotVolume : uint8_t { file, cone, pyramid };

/// Changes to lights and objects of a file. The values of the picture apply to all lights and objects, and
/// overrides to single ones. The defaults change nothing.
struct LightChanges {
    bool enabled = true;
    float intensity = 1.0F; ///< factor
    float range_m = -1.0F;  ///< -1: as in the file
    float radius_m = -1.0F; ///< -1: as in the file
    Attenuation attenuation = Attenuation::file;
    SpotVolume spot_volume = SpotVolume::file;
    bool receives_shadows = true;
    std::string groups;        ///< numbers, "1+3"; empty: as in the file
    std::string shadow_groups; ///< numbers; empty: as in the file

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

/// The lights of a frame. Directional lights come first; the strongest of them is the sun, which casts the
/// shadow.
struct Lighting {
    std::vector<shared::LightRecord> records;
    uint32_t directional_count = 0;
    glm::dvec3 towards_sun{0.0, 1.0, 0.0}; ///< towards the first directional light; straight up without one
    glm::vec3 ambient{0.0F};
    float exposure = 1.0F;           ///< factor on the intensities of the scene's lights
    Groups sun_casters = all_groups; ///< groups that cast shadows for the first directional light
    bool has_groups = false;         ///< some light does not light all groups
    bool indoors = false;            ///< the lights are the default lamp of an interior
};

/// The exposure key and the scene it was computed from, kept from frame to frame.
struct ExposureKeyCache {
    std::vector<shared::LightRecord> records;
    ScenePose pose;
    glm::dvec3 anchor{0.0};
    float key = 1.0F;
    std::vector<shared::LightRecord> room; ///< unused storage, reused for the next Lighting's records
};

/// Places the scene's lights in anchor space. A scene without lights gets the style's sun, which turns with
/// the front of the `analysis`; an interior gets a lamp, and daylight through an opening. Intensities (lux,
/// candela) are scaled so that the scene's well-lit parts reach about one in any unit. A light without a
/// range ends where it falls below 1/400 of that. Cost: linear in lights times visible nodes, unless the
/// exposure is manual or `memory` holds the unchanged scene.
[[nodiscard]] Lighting gather_lights(const Scene& scene, const ScenePose& pose, const Bounds& bounds,
                                     const glm::dvec3& anchor, const LightStyle& style,
                                     const ViewAnalysis& analysis = {}, ExposureKeyCache* memory = nullptr);

/// Share of sunlight that returns to the sun's shadow on the blank ground. It grows linearly from 0 below the
/// middle of the scene to `most` at the end of the shadow of the scene's bounds, so that the shadow is
/// darkest at the foot of its object, as in drawings.
struct Paling {
    glm::vec3 share_per_m{0.0F};
    float share_at_anchor = 0.0F;
};

[[nodiscard]] Paling ground_paling(const Bounds& bounds, const glm::dvec3& anchor,
                                   const glm::dvec3& towards_sun, float most);

/// Ambient light on surfaces that face up and down.
struct SkyAndGround {
    glm::vec3 sky{0.0F};
    glm::vec3 ground{0.0F};
};

/// Splits a share of ambient light: a quarter brighter from above, a quarter darker from below.
[[nodiscard]] SkyAndGround sky_and_ground(const glm::vec3& ambient, float share = 1.0F);

/// Converts the style's tone curve to shader constants.
[[nodiscard]] shared::ToneConstants tone_constants(const ToneStyle& style);

/// The shadow maps of all lights.
struct ShadowMaps {
    gpu::BufferId sun;           ///< reversed depth, row by row
    gpu::BufferId sun_globals;   ///< SunShadow, see shadow/shadow.glsl.h
    gpu::BufferId local;         ///< near distance over distance, for all maps of local lights
    gpu::BufferId local_shadows; ///< LocalShadow, see shadow/shadow.glsl.h
    gpu::BufferId edge_profile;  ///< EdgeProfile, see shadow/shadow.glsl.h
    bool has_sun = false;
    bool has_local = false;
    uint32_t variant = 0; ///< see shadow/shadow_style.hpp
};

struct LightInputs {
    gpu::BufferId frame;    ///< FrameGlobals
    gpu::BufferId lighting; ///< LightGlobals
    gpu::BufferId lights;   ///< LightRecord
    gpu::ImageId draw;
    gpu::ImageId depth;
    gpu::ImageId normal;
    gpu::BufferId draws;
    gpu::BufferId materials;
    gpu::ImageId coordinate;
    gpu::ImageId footprint;
    ShadowMaps shadows;
    std::optional<gpu::ImageId> lightmap; ///< baked light; replaces ambient where alpha is 1
    /// r16f: share of sunlight that terrain, smoke and clouds let through.
    std::optional<gpu::ImageId> sun_share;
    std::optional<gpu::ImageId> occlusion; ///< ambient visibility
    bool occludes_all = false;             ///< occlusion applies to all light, not only to ambient
    std::optional<gpu::ImageId> bounced;   ///< light that occluders reflect, as a share of ambient
    std::optional<gpu::ImageId> points; ///< positions to light in anchor space, instead of those from depth
    std::optional<gpu::BufferId> tiles; ///< only these tiles are lit, see shaders/tiles.glsl.h
    uint32_t local_count = 0; ///< number of point and spot lights, which follow the directional lights
    bool has_emissive = false;
    bool keeps_strongest = false; ///< outputs the direction of the strongest light
    bool keeps_sun = false;       ///< outputs the visible share of the first directional light
    bool counts_visits = false;   ///< outputs counts of local lights instead of light: tested, and in range
    bool looks_at_all = false;    ///< tests every light at every pixel, for comparison
    bool has_links = false;       ///< matches lights and draw calls by their groups
    glm::uvec2 size_px{0};
};

struct LitPixels {
    /// rgba16f: irradiance over pi, at most 65504, and its luminance; 1 for unlit materials and the
    /// background.
    gpu::ImageId light;
    /// r32ui: octahedral direction towards the strongest light if it is local, else 0; one texel unless
    /// `keeps_strongest`.
    gpu::ImageId strongest;
    /// r32f: share of the first directional light that is not in shadow; negative where the light is absent
    /// or grazing; one texel unless `keeps_sun`.
    gpu::ImageId sun;
};

/// Lights the surface.
///
/// Cost    one full-screen dispatch; local lights cost only where they reach. From 65 local lights on, a
///         small dispatch first lists them for large tiles, linear in lights and tiles of 64 pixels
/// Source  tiled culling after Olsson and Assarsson, "Tiled Shading", 2011; the depth mask after Harada, "A
///         2.5D Culling for Forward+", 2012
[[nodiscard]] LitPixels add_light(gpu::Graph& graph, const LightInputs& in);

} // namespace estampe::light
