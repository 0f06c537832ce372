// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>
#include <tuple>
#include <utility>

#include "core/color.hpp"
#include "scene/light_sources.hpp"
#include "scene/pose.hpp"
#include "scene/view_analysis/surface_points.hpp"
#include "techniques/light/light.hpp"

namespace estampe::light {
namespace {

constexpr float least_light = 1.0F / 400.0F;

/// A light record with default values.
shared::LightRecord blank_record()
{
    shared::LightRecord record{};
    record.groups = 0xffffffffU;
    record.radius_m = -1.0F;
    return record;
}

bool is_unit_volume(const shared::LightRecord& record)
{
    return (record.type & shared::light_unit_volume) != 0;
}

glm::dvec3 axis_of(const glm::dmat4& world_from_node, const glm::dvec3& axis)
{
    return glm::normalize(glm::dvec3(world_from_node * glm::dvec4(axis, 0.0)));
}

uint32_t type_of(const Light& light)
{
    uint32_t type = shared::light_point;
    if (light.type == LightType::spot) {
        type = light.shape == SpotShape::pyramid ? shared::light_pyramid : shared::light_spot;
    }
    return type | (light.falloff == LightFalloff::unit_volume ? shared::light_unit_volume : 0U);
}

shared::LightRecord make_record(const Light& light, const glm::dmat4& world_from_node,
                                const glm::dvec3& anchor)
{
    const glm::dvec3 beam = axis_of(world_from_node, {0.0, 0.0, -1.0});
    shared::LightRecord record = blank_record();
    record.groups = light.groups | static_cast<uint32_t>(light.casters) << 16U;
    record.position = glm::vec3(glm::dvec3(world_from_node[3]) - anchor);
    record.range_m = light.range_m;
    record.color = light.color * light.intensity;
    if (light.type == LightType::directional) {
        record.type = shared::light_directional;
        record.direction = glm::vec3(-beam);
        return record;
    }
    record.type = type_of(light);
    record.radius_m = light.radius_m.value_or(-1.0F);
    record.direction = glm::vec3(beam);
    record.side = glm::vec3(axis_of(world_from_node, {1.0, 0.0, 0.0}));
    // Converts a spot's cone to the recommended angular falloff of KHR_lights_punctual, as scale and offset
    // of the cosine.
    const float inner = std::cos(light.inner_cone_rad);
    const float outer = std::cos(light.outer_cone_rad);
    record.cone_scale = 1.0F / std::max(0.001F, inner - outer);
    record.cone_offset = -outer * record.cone_scale;
    return record;
}

/// Share of a local light that arrives at a distance. For inverse-square lights, the window that fades the
/// light to 0 at the light's range is left out.
float weakened(const shared::LightRecord& record, float distance_2)
{
    return is_unit_volume(record) ? estampe::weakened(LightFalloff::unit_volume, record.range_m, distance_2)
                                  : estampe::weakened(LightFalloff::inverse_square, 0.0F, distance_2);
}

/// Share of a local light that leaves along the unit vector `along`, because of the light's cone or pyramid.
float share_along(const shared::LightRecord& record, const glm::vec3& along)
{
    const uint32_t type = record.type & shared::light_type_mask;
    if (type == shared::light_point) {
        return 1.0F;
    }
    return estampe::share_along(
        {.shape = type == shared::light_pyramid ? SpotShape::pyramid : SpotShape::cone,
         .direction = record.direction,
         .side = record.side,
         .cone_scale = record.cone_scale,
         .cone_offset = record.cone_offset},
        along);
}

/// Light of all lights that reaches a point, as if the surface faced every light.
float arriving(const std::vector<shared::LightRecord>& records, const glm::vec3& point)
{
    float sum = 0.0F;
    for (const shared::LightRecord& record : records) {
        if (record.type == shared::light_directional) {
            sum += luminance(record.color);
            continue;
        }
        const glm::vec3 to_light = record.position - point;
        const float distance_2 = std::max(glm::dot(to_light, to_light), 1e-6F);
        sum += luminance(record.color) * share_along(record, -to_light / std::sqrt(distance_2)) *
               weakened(record, distance_2);
    }
    return sum;
}

/// Brightness for the exposure: light at the brighter parts of the scene, the 80th percentile over a sample
/// of its vertices.
float exposure_key(const std::vector<shared::LightRecord>& records, const Scene& scene, const ScenePose& pose,
                   const glm::dvec3& anchor)
{
    constexpr size_t about_a_primitive = 64;
    std::vector<float> levels;
    visit_posed_samples(scene, pose, about_a_primitive, [&](const PosedPrimitive& posed) {
        for (const glm::dvec3& position : posed.positions) {
            levels.push_back(arriving(records, glm::vec3(position - anchor)));
        }
    });
    if (levels.empty()) {
        return 1.0F;
    }
    const auto key = levels.begin() + static_cast<std::ptrdiff_t>(levels.size() * 4 / 5);
    std::nth_element(levels.begin(), key, levels.end());
    return *key;
}

/// Brightness for the exposure like exposure_key(), but the cached value if nothing has changed.
float remembered_exposure_key(const std::vector<shared::LightRecord>& records, const Scene& scene,
                              const ScenePose& pose, const glm::dvec3& anchor, ExposureKeyCache& memory)
{
    const auto is_same = [](const shared::LightRecord& a, const shared::LightRecord& b) {
        // Numbers that are equal but have different bits, such as 0 and -0, cause only an unnecessary
        // computation.
        return std::memcmp(&a, &b, sizeof a) == 0; // NOLINT(bugprone-suspicious-memory-comparison)
    };
    if (!std::ranges::equal(records, memory.records, is_same) || anchor != memory.anchor ||
        pose.world_from_node != memory.pose.world_from_node ||
        pose.morph_weights != memory.pose.morph_weights) {
        memory = {records, pose, anchor, exposure_key(records, scene, pose, anchor)};
    }
    return memory.key;
}

/// Exposure factor of manual metering. Light that a white sheet reflects as luminance 1.2 times 2^EV becomes
/// 1. A white sheet reflects 1 / pi of the irradiance.
float manual_exposure(float ev100)
{
    return 1.0F / (std::numbers::pi_v<float> * 1.2F * std::exp2(ev100));
}

void add_scene_records(std::vector<shared::LightRecord>& records, const Scene& scene, const ScenePose& pose,
                       const Bounds& bounds, const glm::dvec3& anchor)
{
    const auto radius_m = static_cast<float>(std::max(bounds.radius(), 1e-6));
    for (Index node = 0; node < scene.nodes.size(); ++node) {
        const Index light = scene.nodes[node].light;
        if (light != no_index && scene.lights[light].type != LightType::ambient) {
            records.push_back(make_record(scene.lights[light], pose.world_from_node[node], anchor));
            // A light with unit-volume falloff needs a range. If the file gives none, the range is the
            // scene's radius.
            float& range_m = records.back().range_m;
            range_m = range_m > 0.0F ? range_m : is_unit_volume(records.back()) ? radius_m : 0.0F;
        }
    }
}

glm::vec3 ambient_lights(const Scene& scene)
{
    glm::vec3 sum(0.0F);
    for (const Node& node : scene.nodes) {
        if (node.light != no_index && scene.lights[node.light].type == LightType::ambient) {
            sum += scene.lights[node.light].color * scene.lights[node.light].intensity;
        }
    }
    return sum;
}

Groups casters_of(const shared::LightRecord& record)
{
    return static_cast<Groups>(record.groups >> 16U);
}

shared::LightRecord parallel_light(const glm::dvec3& towards, float brightness)
{
    shared::LightRecord light = blank_record();
    light.type = shared::light_directional;
    light.direction = glm::vec3(towards);
    light.color = glm::vec3(brightness);
    return light;
}

/// Adds the style's sun, and a weak, low fill light from the other side of the viewer, which gives form to
/// the shade.
void add_sun_and_fill(std::vector<shared::LightRecord>& records, const LightStyle& style,
                      const ViewAnalysis& analysis)
{
    SunPlace sun{style.sun_azimuth_deg, style.sun_elevation_deg};
    if (style.turn_sun && analysis.wind_towards_deg) {
        sun = sun_over_ground(sun, *analysis.wind_towards_deg);
    }
    const auto towards = [&](double bearing_deg, double height_deg) {
        return style.turn_sun ? analysis.towards_sun(bearing_deg, height_deg)
                              : bearing(glm::radians(bearing_deg), glm::radians(height_deg));
    };
    records.push_back(parallel_light(towards(sun.azimuth_deg, sun.elevation_deg), 1.0F));
    if (style.fill > 0.0F) {
        records.push_back(parallel_light(towards(sun.azimuth_deg + 100.0, 20.0), style.fill));
        records.back().is_fill = 1;
    }
}

/// Light that reaches a surface point, multiplied by the cosine of the angle of incidence.
float falling_on(const std::vector<shared::LightRecord>& records, const SurfacePoint& surface,
                 const glm::vec3& point, float falloff)
{
    float sum = 0.0F;
    for (const shared::LightRecord& record : records) {
        const bool is_parallel = record.type == shared::light_directional;
        const glm::vec3 way = is_parallel ? record.direction : record.position - point;
        const float distance_2 = std::max(glm::dot(way, way), 1e-12F);
        const float cosine = glm::dot(way, surface.normal) / std::sqrt(distance_2);
        sum += luminance(record.color) * std::pow(std::max(cosine, 0.0F), falloff) / distance_2;
    }
    return sum;
}

/// Default lights of an interior: a lamp, and daylight if there is an opening, with an exposure for the
/// visible surfaces.
std::vector<shared::LightRecord> lamp_light(const Shelter& shelter, const glm::dvec3& anchor,
                                            const LightStyle& style)
{
    constexpr float daylight = 0.8F;
    // Wanted light on the surfaces that the exposure is measured on, without ambient light. A lone lamp
    // leaves the visible surfaces at a half tone, for depth.
    const float white = shelter.towards_light ? 0.62F : 0.5F;
    const glm::vec3 offset(shelter.origin - anchor);
    float size_2 = 0.0F;
    const glm::vec3 place(shelter.lamp - anchor);
    for (const SurfacePoint& point : shelter.seen) {
        const glm::vec3 way = point.position + offset - place;
        size_2 += glm::dot(way, way) / static_cast<float>(shelter.seen.size());
    }
    shared::LightRecord lamp = blank_record();
    lamp.type = shared::light_point;
    lamp.position = place;
    lamp.color = glm::vec3(std::max(size_2, 1e-12F));
    std::vector<shared::LightRecord> records{lamp};
    if (shelter.towards_light) {
        // Daylight from the whole sky casts no shadow, because the opening's rim would throw a hard edge on
        // the opposite wall.
        shared::LightRecord& sky = records.emplace_back(parallel_light(*shelter.towards_light, daylight));
        sky.groups &= all_groups;
    }
    std::vector<float> levels;
    for (const SurfacePoint& point : shelter.seen) {
        levels.push_back(falling_on(records, point, point.position + offset, style.falloff));
    }
    const auto key = levels.begin() + static_cast<std::ptrdiff_t>(levels.size() * 7 / 10);
    if (key != levels.end()) {
        std::nth_element(levels.begin(), key, levels.end());
        for (shared::LightRecord& record : records) {
            record.color *= white / std::max(*key, 1e-6F);
        }
    }
    return records;
}

void expose(Lighting& lighting, float exposure, const Bounds& bounds)
{
    for (shared::LightRecord& record : lighting.records) {
        record.color *= exposure;
        if (is_unit_volume(record)) {
            continue;
        }
        const float reach = std::sqrt(std::max(luminance(record.color), 0.0F) / least_light);
        record.range_m = record.range_m > 0.0F
                             ? std::min(record.range_m, 1e9F)
                             : std::min(reach, static_cast<float>(8.0 * bounds.radius() + 1.0) * 4.0F);
    }
}

/// Sorts the lights: directional lights first, shadow-casting ones before others, then by brightness. Returns
/// the number of directional lights.
uint32_t put_suns_first(std::vector<shared::LightRecord>& records)
{
    const auto is_before = [](const shared::LightRecord& a, const shared::LightRecord& b) {
        const auto rank = [](const shared::LightRecord& record) {
            const bool is_sun = record.type == shared::light_directional;
            return std::tuple(!is_sun, is_sun && casters_of(record) == 0,
                              is_sun ? -luminance(record.color) : 0.0F);
        };
        return rank(a) < rank(b);
    };
    // Avoids stable_sort() where possible, because stable_sort() allocates memory.
    if (!std::ranges::is_sorted(records, is_before)) {
        std::ranges::stable_sort(records, is_before);
    }
    return static_cast<uint32_t>(
        std::ranges::count(records, shared::light_directional, &shared::LightRecord::type));
}

} // namespace

Lighting gather_lights(const Scene& scene, const ScenePose& pose, const Bounds& bounds,
                       const glm::dvec3& anchor, const LightStyle& style, const ViewAnalysis& analysis,
                       ExposureKeyCache* memory)
{
    Lighting lighting;
    std::vector<shared::LightRecord>& records = lighting.records;
    if (memory != nullptr) {
        records = std::exchange(memory->room, {});
        records.clear();
    }
    if (style.source != LightSource::sun) {
        add_scene_records(records, scene, pose, bounds, anchor);
    }
    const glm::vec3 ambient = style.source != LightSource::sun ? ambient_lights(scene) : glm::vec3(0.0F);
    const bool has_own = !records.empty();
    const bool is_unlit = records.empty() && ambient == glm::vec3(0.0F);
    if (is_unlit && style.source == LightSource::automatic && analysis.shelter) {
        records = lamp_light(*analysis.shelter, anchor, style);
        lighting.indoors = true;
    } else if (is_unlit && style.source != LightSource::scene) {
        add_sun_and_fill(records, style, analysis);
    }
    const bool is_manual = style.metering == Metering::manual && has_own;
    float key = 1.0F;
    if (!records.empty() && !lighting.indoors && !is_manual) {
        key = memory != nullptr ? remembered_exposure_key(records, scene, pose, anchor, *memory)
                                : exposure_key(records, scene, pose, anchor);
    }
    lighting.directional_count = put_suns_first(records);
    // If the page's brightness sets the exposure, a later pass adds exposure_stops.
    const float stops = style.metering == Metering::page ? 0.0F : style.exposure_stops;
    const float metered = is_manual ? manual_exposure(style.ev100) : key > 0.0F ? 1.0F / key : 1.0F;
    lighting.exposure = metered * std::exp2(stops);
    expose(lighting, lighting.exposure, bounds);
    if (lighting.directional_count > 0) {
        lighting.towards_sun = glm::dvec3(records.front().direction);
        lighting.sun_casters = casters_of(records.front());
    }
    lighting.has_groups = std::any_of(records.begin(), records.end(), [](const shared::LightRecord& record) {
        return (record.groups & all_groups) != all_groups;
    });
    lighting.ambient = glm::vec3(style.ambient * std::exp2(stops));
    lighting.ambient += ambient * lighting.exposure;
    return lighting;
}

SkyAndGround sky_and_ground(const glm::vec3& ambient, float share)
{
    return {.sky = ambient * (1.25F * share), .ground = ambient * (0.75F * share)};
}

} // namespace estampe::light
