// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <numbers>

#include "scene/outlook/view_axes.hpp"
#include "scene/pose.hpp"
#include "techniques/light/light.hpp"

namespace estampe::light {
namespace {

constexpr float least_light = 1.0F / 400.0F;

shared::LightRecord make_record(const Light& light, const glm::dmat4& world_from_node,
                                const glm::dvec3& anchor)
{
    const glm::dvec3 beam = glm::normalize(glm::dvec3(world_from_node * glm::dvec4(0.0, 0.0, -1.0, 0.0)));
    shared::LightRecord record{};
    record.position = glm::vec3(glm::dvec3(world_from_node[3]) - anchor);
    record.range_m = light.range_m;
    record.color = light.color * light.intensity;
    if (light.type == LightType::directional) {
        record.type = shared::light_directional;
        record.direction = glm::vec3(-beam);
        return record;
    }
    record.type = light.type == LightType::spot ? shared::light_spot : shared::light_point;
    record.direction = glm::vec3(beam);
    // KHR_lights_punctual's recommended angular falloff, as scale and offset of the cosine.
    const float inner = std::cos(light.inner_cone_rad);
    const float outer = std::cos(light.outer_cone_rad);
    record.cone_scale = 1.0F / std::max(0.001F, inner - outer);
    record.cone_offset = -outer * record.cone_scale;
    return record;
}

float brightness(const glm::vec3& color)
{
    return glm::dot(color, glm::vec3(0.2126F, 0.7152F, 0.0722F));
}

/// What arrives at a point that faces every light.
float arriving(const std::vector<shared::LightRecord>& records, const glm::vec3& point)
{
    float sum = 0.0F;
    for (const shared::LightRecord& record : records) {
        if (record.type == shared::light_directional) {
            sum += brightness(record.color);
            continue;
        }
        const glm::vec3 to_light = record.position - point;
        const float distance_2 = std::max(glm::dot(to_light, to_light), 1e-6F);
        float cone = 1.0F;
        if (record.type == shared::light_spot) {
            const float angle = glm::dot(-to_light / std::sqrt(distance_2), record.direction);
            cone = std::clamp(angle * record.cone_scale + record.cone_offset, 0.0F, 1.0F);
        }
        sum += brightness(record.color) * cone * cone / distance_2;
    }
    return sum;
}

/// The light at the brighter parts of the scene: the eightieth percentile over a sample of its vertices.
float key_light(const std::vector<shared::LightRecord>& records, const Scene& scene, const ScenePose& pose,
                const glm::dvec3& anchor)
{
    std::vector<float> levels;
    visit_posed(scene, pose, [&](const PosedPrimitive& posed) {
        const size_t stride = std::max<size_t>(1, posed.positions.size() / 64);
        for (size_t i = 0; i < posed.positions.size(); i += stride) {
            levels.push_back(arriving(records, glm::vec3(posed.positions[i] - anchor)));
        }
    });
    if (levels.empty()) {
        return 1.0F;
    }
    const auto key = levels.begin() + static_cast<std::ptrdiff_t>(levels.size() * 4 / 5);
    std::nth_element(levels.begin(), key, levels.end());
    return *key;
}

std::vector<shared::LightRecord> scene_records(const Scene& scene, const ScenePose& pose,
                                               const glm::dvec3& anchor)
{
    std::vector<shared::LightRecord> records;
    for (Index node = 0; node < scene.nodes.size(); ++node) {
        if (scene.nodes[node].light != no_index) {
            records.push_back(
                make_record(scene.lights[scene.nodes[node].light], pose.world_from_node[node], anchor));
        }
    }
    return records;
}

shared::LightRecord parallel_light(const glm::dvec3& towards, float brightness)
{
    shared::LightRecord light{};
    light.type = shared::light_directional;
    light.direction = glm::vec3(towards);
    light.color = glm::vec3(brightness);
    return light;
}

/// The style's sun, and a weak light from the other side of the viewer, low, so that shade has form.
std::vector<shared::LightRecord> sun_and_fill(const LightStyle& style, const Outlook& outlook)
{
    const double azimuth_deg = style.sun_azimuth_deg;
    const double elevation_deg = style.sun_elevation_deg;
    const auto towards = [&](double bearing_deg, double height_deg) {
        return style.turn_sun ? outlook.towards_sun(bearing_deg, height_deg)
                              : bearing(glm::radians(bearing_deg), glm::radians(height_deg));
    };
    std::vector records{parallel_light(towards(azimuth_deg, elevation_deg), 1.0F)};
    if (style.fill > 0.0F) {
        records.push_back(parallel_light(towards(azimuth_deg + 100.0, 20.0), style.fill));
    }
    return records;
}

/// What arrives at a surface, its slant counted.
float falling_on(const std::vector<shared::LightRecord>& records, const SurfacePoint& surface,
                 const glm::vec3& point, float falloff)
{
    float sum = 0.0F;
    for (const shared::LightRecord& record : records) {
        const bool is_parallel = record.type == shared::light_directional;
        const glm::vec3 way = is_parallel ? record.direction : record.position - point;
        const float distance_2 = std::max(glm::dot(way, way), 1e-12F);
        const float cosine = glm::dot(way, surface.normal) / std::sqrt(distance_2);
        sum += brightness(record.color) * std::pow(std::max(cosine, 0.0F), falloff) / distance_2;
    }
    return sum;
}

/// A lamp for a shelter, and daylight if there is a way in, weighed by what is seen.
std::vector<shared::LightRecord> lamp_light(const Shelter& shelter, const glm::dvec3& anchor,
                                            const LightStyle& style)
{
    constexpr float daylight = 1.5F;
    // What the key surfaces get, ambient apart: under a lamp alone they keep a half tone, for depth.
    const float white = shelter.towards_light ? 0.8F : 0.5F;
    const glm::vec3 offset(shelter.origin - anchor);
    float size_2 = 0.0F;
    const glm::vec3 place(shelter.lamp - anchor);
    for (const SurfacePoint& point : shelter.seen) {
        const glm::vec3 way = point.position + offset - place;
        size_2 += glm::dot(way, way) / static_cast<float>(shelter.seen.size());
    }
    shared::LightRecord lamp{};
    lamp.type = shared::light_point;
    lamp.position = place;
    lamp.color = glm::vec3(std::max(size_2, 1e-12F));
    std::vector<shared::LightRecord> records{lamp};
    if (shelter.towards_light) {
        records.push_back(parallel_light(*shelter.towards_light, daylight));
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
        const float reach = std::sqrt(std::max(brightness(record.color), 0.0F) / least_light);
        record.range_m = record.range_m > 0.0F
                             ? std::min(record.range_m, 1e9F)
                             : std::min(reach, static_cast<float>(8.0 * bounds.radius() + 1.0) * 4.0F);
    }
}

} // namespace

Lighting gather_lights(const Scene& scene, const ScenePose& pose, const Bounds& bounds,
                       const glm::dvec3& anchor, const LightStyle& style, const Outlook& outlook)
{
    Lighting lighting;
    std::vector<shared::LightRecord>& records = lighting.records;
    if (style.source != LightSource::sun) {
        records = scene_records(scene, pose, anchor);
    }
    if (records.empty() && style.source == LightSource::automatic && outlook.shelter) {
        records = lamp_light(*outlook.shelter, anchor, style);
        lighting.indoors = true;
    } else if (records.empty() && style.source != LightSource::scene) {
        records = sun_and_fill(style, outlook);
    }
    const float key = records.empty() || lighting.indoors ? 1.0F : key_light(records, scene, pose, anchor);
    const auto first_local =
        std::stable_partition(records.begin(), records.end(), [](const shared::LightRecord& record) {
            return record.type == shared::light_directional;
        });
    lighting.directional_count = static_cast<uint32_t>(first_local - records.begin());
    std::stable_sort(records.begin(), first_local,
                     [](const shared::LightRecord& a, const shared::LightRecord& b) {
                         return brightness(a.color) > brightness(b.color);
                     });
    expose(lighting, (key > 0.0F ? 1.0F / key : 1.0F) * std::exp2(style.exposure_stops), bounds);
    if (lighting.directional_count > 0) {
        lighting.towards_sun = glm::dvec3(records.front().direction);
    }
    lighting.ambient = glm::vec3(style.ambient * std::exp2(style.exposure_stops));
    return lighting;
}

} // namespace estampe::light
