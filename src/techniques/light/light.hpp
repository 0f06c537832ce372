// SPDX-License-Identifier: MIT
#pragma once

// Light that arrives at each pixel: the sun with its shadow, and any number of local lights, found per tile;
// what the style says of it, and of how light becomes tone.

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

/// What sets the exposure: the lights that there are, what is on the page, or the style.
enum class Metering : uint8_t { lights, page, manual };

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
    std::string lights;
    std::string objects;
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

/// The lights of a frame: directional ones first, the strongest first of all, because it throws the shadow.
struct Lighting {
    std::vector<shared::LightRecord> records;
    uint32_t directional_count = 0;
    glm::dvec3 towards_sun{0.0, 1.0, 0.0}; ///< of the first directional light; straight up when there is none
    glm::vec3 ambient{0.0F};
    float exposure = 1.0F;           ///< what the intensities of the scene's lights were multiplied by
    Groups sun_casters = all_groups; ///< whose shadows the first directional light throws
    bool has_groups = false;         ///< some light does not light all groups
    bool indoors = false;            ///< the lamp of a shelter, not of the scene
};

/// The exposure key and the scene it was computed from, kept from frame to frame.
struct ExposureKeyCache {
    std::vector<shared::LightRecord> records;
    ScenePose pose;
    glm::dvec3 anchor{0.0};
    float key = 1.0F;
    std::vector<shared::LightRecord> room; ///< of a Lighting's records that is done with, for the next
};

/// Places the scene's lights in anchor space. Where it has none it gets the style's sun, which turns with the
/// front of the `analysis`, or under a shelter a lamp, with daylight where that can come in. Intensities
/// (lux, candela) are scaled so that the scene's well-lit parts come to about one, whatever units the file
/// was made in. A light without a range gets one where it falls under 1/400 of that. Cost: linear in lights
/// times nodes that show something, unless the exposure is manual or `memory` knows the scene as it stands.
[[nodiscard]] Lighting gather_lights(const Scene& scene, const ScenePose& pose, const Bounds& bounds,
                                     const glm::dvec3& anchor, const LightStyle& style,
                                     const ViewAnalysis& analysis = {}, ExposureKeyCache* memory = nullptr);

/// How much of the sun's light comes back to the shadow on the blank ground, linear over the ground: none
/// below the middle of the scene, `most` where the shadow of its bounds ends. So the shadow is darkest where
/// its thing stands, as it is on paper.
struct Paling {
    glm::vec3 share_per_m{0.0F};
    float share_at_anchor = 0.0F;
};

[[nodiscard]] Paling ground_paling(const Bounds& bounds, const glm::dvec3& anchor,
                                   const glm::dvec3& towards_sun, float most);

/// Light from everywhere, as surfaces get it that face up and down.
struct SkyAndGround {
    glm::vec3 sky{0.0F};
    glm::vec3 ground{0.0F};
};

/// A share of ambient light, a quarter brighter from above and darker from below.
[[nodiscard]] SkyAndGround sky_and_ground(const glm::vec3& ambient, float share = 1.0F);

/// The style's tone curve as the shaders want it.
[[nodiscard]] shared::ToneConstants tone_constants(const ToneStyle& style);

/// How far the lights see.
struct ShadowMaps {
    gpu::BufferId sun;           ///< reversed depth, row by row
    gpu::BufferId sun_globals;   ///< SunShadow, see shadow/shadow.glsl.h
    gpu::BufferId local;         ///< near distance over distance, of all maps of local lights
    gpu::BufferId local_shadows; ///< LocalShadow, see shadow/shadow.glsl.h
    gpu::BufferId edge_look;     ///< EdgeLook, see shadow/shadow.glsl.h
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
    std::optional<gpu::ImageId> lightmap;  ///< light known ahead: takes the place of ambient where alpha is 1
    std::optional<gpu::ImageId> sun_share; ///< r16f: how much of the sun terrain, smoke and clouds leave
    std::optional<gpu::ImageId> occlusion; ///< share of the light from everywhere that arrives
    bool occludes_all = false;             ///< it takes of all light
    std::optional<gpu::ImageId> bounced;   ///< ambient light that what occludes bounces back, as a share
    std::optional<gpu::ImageId> points;    ///< places in anchor space to light, in place of what depths say;
                                           ///< at every light
    std::optional<gpu::BufferId> tiles;    ///< to light, see shaders/tiles.glsl.h; elsewhere nothing is
                                           ///< written
    uint32_t local_count = 0;              ///< point and spot lights, after the directional ones
    bool has_emissive = false;
    bool keeps_strongest = false; ///< the direction of the strongest light is wanted
    bool keeps_sun = false;       ///< how much is seen of the first directional light is wanted
    bool counts_visits = false; ///< instead of light: local lights looked at, and those whose range holds it
    bool looks_at_all = false;  ///< every pixel at every light, for comparison
    bool has_links = false;     ///< lights and draws are to be matched by their groups
    glm::uvec2 size_px{0};
};

struct LitPixels {
    gpu::ImageId light; ///< rgba16f: irradiance over pi, at most 65504, and its luminance; 1 where a material
                        ///< is unlit or nothing is seen
    gpu::ImageId strongest; ///< r32ui: octahedral direction towards the strongest light, where that is a
                            ///< local one, else 0; a single texel unless `keeps_strongest`
    gpu::ImageId sun; ///< r32f: share of the first directional light that shadows leave; negative where it
                      ///< lights nothing or only grazes; a single texel unless `keeps_sun`
};

/// Lights the surface.
///
/// Cost    one full-screen dispatch; local lights cost where they reach. From 65 of them on a small dispatch
///         lists them for large tiles first, linear in lights and tiles of 64 pixels
/// Source  tiled culling after Olsson and Assarsson, "Tiled Shading", 2011; the depth mask after Harada, "A
///         2.5D Culling for Forward+", 2012
[[nodiscard]] LitPixels add_light(gpu::Graph& graph, const LightInputs& in);

} // namespace estampe::light
