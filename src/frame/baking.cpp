// SPDX-License-Identifier: MIT
// Implements the public interface of baking, and collects the light that is baked.
#include "frame/baking.hpp"

#include <optional>
#include <utility>

#include <estampe/bake.hpp>

#include "features/lighting/lighting.hpp"
#include "features/lighting/lightmaps.hpp"
#include "scene/static_triangles.hpp"
#include "scene/visibility.hpp"
#include "techniques/light/daylight.hpp"

namespace estampe::frame {
namespace {

std::optional<glm::dvec3> eye_of_first_camera(const Scene& scene, const ScenePose& pose)
{
    for (Index node = 0; node < scene.nodes.size(); ++node) {
        if (scene.nodes[node].camera != no_index) {
            return glm::dvec3(pose.world_from_node[node][3]);
        }
    }
    return std::nullopt;
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

void set_light(bake::BakeSettings& settings, const Scene& scene, const features::StyleTables& style,
               const BakedLight& wanted)
{
    const ScenePose pose = pose_scene(scene, 0.0, no_index);
    const Bounds bounds = scene_bounds(scene, pose);
    const ViewAnalysis analysis =
        features::DefaultLight().analysis(scene, style.light, eye_of_first_camera(scene, pose));
    light::Lighting lighting =
        light::gather_lights(scene, pose, bounds, bounds.center(), style.light, analysis);
    if (const std::optional<light::Daylight> daylight = light::daylight_of(style.sun)) {
        light::set_daylight(lighting, *daylight, style.light);
    }
    settings.lamps.clear();
    for (const shared::LightRecord& record : lighting.records) {
        settings.lamps.push_back(lamp_of(record));
        settings.lamps.back().baked = (features::kind_of(record) & wanted.direct) != 0;
    }
    settings.exposure = lighting.exposure;
    const light::SkyAndGround ambient = light::sky_and_ground(lighting.ambient, wanted.sky);
    settings.sky = ambient.sky;
    settings.ground = ambient.ground;
}

} // namespace estampe::frame

namespace estampe {
namespace {

Scene shown(Scene scene)
{
    hide_invisible(scene);
    return scene;
}

bake::BakeSettings lit_settings(const Scene& scene, const Style& style, const BakeSettings& wanted)
{
    bake::BakeSettings settings{.size = wanted.size,
                                .samples = wanted.samples,
                                .bounces = wanted.bounces,
                                .seed = wanted.seed,
                                .smooth = wanted.smooth};
    frame::set_light(settings, scene, style.tables(), {.direct = wanted.direct, .sky = wanted.sky});
    return settings;
}

} // namespace

struct LightmapBake::Impl {
    Impl(Scene own_scene, const Style& style, const BakeSettings& settings)
        : scene(features::lit_by_style(shown(std::move(own_scene)), style.tables())),
          bake(scene, lit_settings(scene, style, settings))
    {
    }

    Scene scene;
    bake::Bake bake; ///< the bake holds a reference to `scene`
};

LightmapBake::LightmapBake(Scene scene, const Style& style, const BakeSettings& settings)
    : impl_(std::make_unique<Impl>(std::move(scene), style, settings))
{
}

LightmapBake::~LightmapBake() = default;

LightmapBake::LightmapBake(LightmapBake&&) noexcept = default;

LightmapBake& LightmapBake::operator=(LightmapBake&&) noexcept = default;

bool LightmapBake::work(double seconds)
{
    return impl_->bake.work(seconds);
}

double LightmapBake::done() const
{
    return impl_->bake.done();
}

bool LightmapBake::load_progress(const std::filesystem::path& path)
{
    return impl_->bake.load_progress(path);
}

void LightmapBake::save_progress(const std::filesystem::path& path) const
{
    impl_->bake.save_progress(path);
}

Lightmap LightmapBake::map() const
{
    return impl_->bake.map();
}

size_t LightmapBake::texel_count() const
{
    return impl_->bake.texel_count();
}

float LightmapBake::texels_per_m() const
{
    return impl_->bake.texels_per_m();
}

bool LightmapBake::leaves_out_moving() const
{
    return has_moving_parts(impl_->scene);
}

} // namespace estampe
