// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <numbers>

#include "scene/pose.hpp"
#include "techniques/light/light.hpp"

namespace estampe::light {
namespace {

constexpr float least_light = 1.0F / 400.0F;

glm::dvec3 style_sun(const LightStyle& style)
{
    const double azimuth = glm::radians(static_cast<double>(style.sun_azimuth_deg));
    const double elevation = glm::radians(static_cast<double>(style.sun_elevation_deg));
    return {std::sin(azimuth) * std::cos(elevation), std::sin(elevation),
            std::cos(azimuth) * std::cos(elevation)};
}

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

shared::LightRecord sun_record(const LightStyle& style)
{
    shared::LightRecord sun{};
    sun.type = shared::light_directional;
    sun.direction = glm::vec3(style_sun(style));
    sun.color = glm::vec3(1.0F);
    return sun;
}

/// A weak light from the other side of the viewer, low, so that shade has form and rooms are not black.
shared::LightRecord fill_record(const LightStyle& style)
{
    LightStyle opposite = style;
    opposite.sun_azimuth_deg += 100.0F;
    opposite.sun_elevation_deg = 20.0F;
    shared::LightRecord fill = sun_record(opposite);
    fill.color = glm::vec3(style.fill);
    return fill;
}

} // namespace

Lighting gather_lights(const Scene& scene, const ScenePose& pose, const Bounds& bounds,
                       const glm::dvec3& anchor, const LightStyle& style)
{
    Lighting lighting;
    if (style.source != LightSource::sun) {
        lighting.records = scene_records(scene, pose, anchor);
    }
    if (lighting.records.empty() && style.source != LightSource::scene) {
        lighting.records.push_back(sun_record(style));
        if (style.fill > 0.0F) {
            lighting.records.push_back(fill_record(style));
        }
    }
    const float key = lighting.records.empty() ? 1.0F : key_light(lighting.records, scene, pose, anchor);
    const float exposure = (key > 0.0F ? 1.0F / key : 1.0F) * std::exp2(style.exposure_stops);
    const auto first_local = std::stable_partition(
        lighting.records.begin(), lighting.records.end(),
        [](const shared::LightRecord& record) { return record.type == shared::light_directional; });
    lighting.directional_count = static_cast<uint32_t>(first_local - lighting.records.begin());
    std::stable_sort(lighting.records.begin(), first_local,
                     [](const shared::LightRecord& a, const shared::LightRecord& b) {
                         return brightness(a.color) > brightness(b.color);
                     });
    for (shared::LightRecord& record : lighting.records) {
        record.color *= exposure;
        const float reach = std::sqrt(std::max(brightness(record.color), 0.0F) / least_light);
        record.range_m = record.range_m > 0.0F
                             ? std::min(record.range_m, 1e9F)
                             : std::min(reach, static_cast<float>(8.0 * bounds.radius() + 1.0) * 4.0F);
    }
    if (lighting.directional_count > 0) {
        lighting.towards_sun = glm::dvec3(lighting.records.front().direction);
    }
    lighting.ambient = glm::vec3(style.ambient * std::exp2(style.exposure_stops));
    return lighting;
}

} // namespace estampe::light
