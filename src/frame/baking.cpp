// SPDX-License-Identifier: MIT
#include "frame/baking.hpp"

#include <optional>

#include "frame/lightmaps.hpp"
#include "scene/outlook/outlook.hpp"
#include "techniques/light/daylight.hpp"

namespace estampe::frame {
namespace {

/// Where the house's light is set up: as for an eye at the first camera, where there is one.
Outlook outlook_of(const Scene& scene, const ScenePose& pose)
{
    const SurfaceCloud cloud = surface_cloud(scene, pose);
    Outlook outlook = find_outlook(cloud);
    for (Index node = 0; node < scene.nodes.size() && !outlook.shelter; ++node) {
        if (scene.nodes[node].camera != no_index) {
            outlook.shelter = shelter_around(cloud, glm::dvec3(pose.world_from_node[node][3]));
            break;
        }
    }
    return outlook;
}

bake::LampKind kind_of_lamp(const shared::LightRecord& record)
{
    switch (record.type & shared::light_type_mask) {
    case shared::light_directional:
        return bake::LampKind::directional;
    case shared::light_spot:
        return bake::LampKind::spot;
    case shared::light_pyramid:
        return bake::LampKind::pyramid;
    default:
        return bake::LampKind::point;
    }
}

bake::Lamp lamp_of(const shared::LightRecord& record)
{
    const bake::LampKind kind = kind_of_lamp(record);
    return {.kind = kind,
            .position = record.position,
            .direction = record.direction,
            .color = record.color,
            .range_m = kind == bake::LampKind::directional ? 0.0F : record.range_m,
            .cone_scale = record.cone_scale,
            .cone_offset = record.cone_offset,
            .side = record.side,
            .unit_volume = (record.type & shared::light_unit_volume) != 0,
            .groups = static_cast<Groups>(record.groups),
            .casters = static_cast<Groups>(record.groups >> 16U)};
}

} // namespace

void set_light(bake::BakeSettings& settings, const Scene& scene, const StyleTables& style,
               const BakedLight& light)
{
    const ScenePose pose = pose_scene(scene, 0.0, no_index);
    const Bounds bounds = scene_bounds(scene, pose);
    light::Lighting lighting =
        light::gather_lights(scene, pose, bounds, bounds.center(), style.light, outlook_of(scene, pose));
    if (const std::optional<light::Daylight> daylight = light::daylight_of(style.sun)) {
        light::set_daylight(lighting, *daylight, style.light);
    }
    settings.lamps.clear();
    for (const shared::LightRecord& record : lighting.records) {
        settings.lamps.push_back(lamp_of(record));
        settings.lamps.back().baked = (kind_of(record) & light.direct) != 0;
    }
    settings.exposure = lighting.exposure;
    settings.sky = lighting.ambient * (1.25F * light.sky);
    settings.ground = lighting.ambient * (0.75F * light.sky);
}

} // namespace estampe::frame
