// SPDX-License-Identifier: MIT
// Prepares the first sample of a picture: brings features to the picture's time, plans the frame, and
// uploads the data that the frame reads in addition to the scene.
#include "frame/renderer_impl.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <future>
#include <iterator>
#include <utility>

#include <fmt/format.h>

#include <estampe/error.hpp>

#include "core/color.hpp"
#include "features/lighting/lightmaps.hpp"
#include "frame/plan.hpp"
#include "gpu/resources.hpp"
#include "scene/scene_limits.hpp"
#include "techniques/light/daylight.hpp"
#include "techniques/subsurface/subsurface.hpp"

namespace estampe {

std::optional<std::vector<smoke::Box>> Renderer::Impl::blow_cloth(const ScenePose& pose,
                                                                  const features::StyleTables& style,
                                                                  const RenderSettings& settings)
{
    if (features.cloth.sheets() == nullptr) {
        return std::nullopt;
    }
    cloth::Cloths& sheets = features.cloth.sheets()->sheets();
    if (style.wind.from != wind::WindSource::smoke) {
        sheets.set_flows(device, {});
        return std::nullopt;
    }
    const std::vector<smoke::Lamp> none;
    auto boxes = features.smoke.rise(device, executor,
                                     {.scene = loaded->scene,
                                      .layout = loaded->layout,
                                      .pose = pose,
                                      .settings = settings,
                                      .style = style,
                                      .lamps = none},
                                     notes);
    if (boxes.empty()) {
        notes.emplace_back("wind.from is smoke, of which there is none");
    }
    std::vector<cloth::Flow> flows;
    flows.reserve(boxes.size());
    for (const smoke::Box& box : boxes) {
        flows.push_back({.cells = box.cells, .cells_from_place = box.grid_from_anchor});
    }
    sheets.set_flows(device, flows);
    for (size_t i = 0; i < flows.size(); ++i) {
        gpu::Graph graph;
        sheets.add_flow(graph, i, features.smoke.velocity(graph, i));
        executor.run(graph);
    }
    return boxes;
}

features::ClothInputs Renderer::Impl::cloth_inputs(const RenderSettings& settings,
                                                   const features::StyleTables& style)
{
    return {.scene = loaded->scene,
            .layout = loaded->layout,
            .meshes = loaded->meshes,
            .posed = loaded->pose,
            .pose_at =
                [this, animation = settings.animation](double time_s) {
                    ScenePose pose = frame::pose_at(*loaded, time_s, animation);
                    update_pose(pose);
                    return pose;
                },
            .add_posed = [this](gpu::Graph& graph) { return add_moved(graph); },
            .settings = settings,
            .style = style,
            .before_s = moment_before(settings, style)};
}

light::Lighting Renderer::Impl::gather_lights(const Camera& camera, const ScenePose& scene_pose,
                                              const features::StyleTables& tables)
{
    // Another thread finds the mesh edges that may become lines, while this thread prepares the picture.
    const std::future<void> edges = features.lines.meshes().find_edges(loaded->layout, tables.contour);
    return light::gather_lights(
        loaded->scene, scene_pose, loaded->layout.bounds, loaded->layout.anchor, tables.light,
        loaded->default_light.analysis(loaded->scene, tables.light, camera.eye), &loaded->exposure_key);
}

frame::FramePlan Renderer::Impl::prepare(const Camera& camera, const features::StyleTables& tables,
                                         const RenderSettings& settings)
{
    if (!loaded) {
        throw Error("there is no scene to draw", "", "call set_scene first");
    }
    frame::check_page(settings);
    const bool are_zones_new = frame::hide_ink_zones(device, *loaded, tables);
    if (frame::style_lighting(device, *loaded, tables) || are_zones_new) {
        posed_scene = {};
        features.invalidate(features::Event::lights_changed);
    }
    note_layout();
    motion = {};
    is_of_film = settings.continuity != Continuity::still;
    executor.add_timings();
    executor.time_passes(settings.time_passes || settings.measure_solvers);
    follow_eye(camera);
    const pose::MeshData& layout = loaded->layout;
    const ScenePose& scene_pose = pose_at(settings);
    check_places(loaded->scene, scene_pose);
    notes = loaded->notes;
    if (!std::exchange(has_told_of_pipelines, true) && !executor.pipelines_note().empty()) {
        notes.push_back(executor.pipelines_note());
    }
    const auto risen = blow_cloth(scene_pose, tables, settings);
    const features::ClothAdvance advance =
        features.cloth.advance(device, executor, cloth_inputs(settings, tables));
    if (advance.tore) {
        features.invalidate(features::Event::triangles_changed);
    }
    const bool has_cloth_moved = features.cloth.has_moved();
    const std::optional<double> before_s = moment_before(settings, tables);
    // If the device still holds the pose of the previous picture, flowing ink continues from this pose.
    const bool is_there = before_s && !settings.motion_since && loaded->pose && !advance.posed_scene &&
                          before_s == features.ink.before_s(settings, tables.ink);
    // Cloth can change while the pose stays the same, so the scene is posed again at both moments.
    force_repose = before_s && has_cloth_moved;
    if (before_s && !is_there) {
        pose_before(frame::pose_at(*loaded, *before_s, settings.animation));
        force_repose = has_cloth_moved;
    }
    update_pose(scene_pose);
    if (has_cloth_moved) {
        loaded->pose_moved = true;
        features.shadows.move(features.cloth.place(device, cloth_inputs(settings, tables), scene_pose));
    }
    update_terrain(camera, settings, tables);
    light::Lighting lighting = gather_lights(camera, scene_pose, tables);
    const std::optional<light::Daylight> daylight = light::daylight_of(tables.sun);
    if (daylight) {
        light::set_daylight(lighting, *daylight, tables.light);
    }
    if (tables.smoke.enabled && tables.smoke.glow > 0.0F) {
        features::add_fires(lighting,
                            features::smoke_boxes(loaded->scene, scene_pose, layout.anchor,
                                                  tables.smoke.objects, std::bit_floor(tables.smoke.cells)),
                            tables.smoke, settings.time_s);
    }
    const float lightmap_scale = features::make_room(lighting, loaded->baked, tables.lightmap);
    if (loaded->terrain && !loaded->terrain->problem().empty()) {
        notes.push_back(fmt::format("the ground is drawn slowly: {}", loaded->terrain->problem()));
    }
    std::ranges::copy(features::idle_overrides(loaded->scene, tables), std::back_inserter(notes));
    if (tables.culling.cells == cells::Culling::portals) {
        std::ranges::copy(loaded->notes_of_cells, std::back_inserter(notes));
        if (loaded->scene.cells.empty()) {
            notes.emplace_back("culling.cells is portals, but the scene has no cells: all of it is drawn");
        }
    }
    if (lighting.indoors) {
        notes.emplace_back("the scene has no light and the sun does not reach it: a lamp hangs in the room");
    }
    frame::FramePlan plan = frame::plan_frame({.loaded = *loaded,
                                               .lighting = lighting,
                                               .daylight = daylight,
                                               .camera = camera,
                                               .settings = settings,
                                               .style = tables,
                                               .device = device,
                                               .raster_path = raster_path,
                                               .wanted_path = options.raster,
                                               .clouds = features.clouds.memory()},
                                              std::exchange(plan_lists, {}));
    page_path = plan.raster.paths.page;
    plan.light.lightmap_scale = lightmap_scale;
    plan.risen = risen;
    plan.particles = features.particles.plan(
        device, executor,
        {.scene = loaded->scene,
         .layout = loaded->layout,
         .are_nodes_placed = !loaded->placed.empty(),
         .pose = scene_pose,
         .pose_at = [&](double time_s) { return frame::pose_at(*loaded, time_s, settings.animation); },
         .camera = camera,
         .settings = settings,
         .style = tables,
         .has_haze = plan.page.has_haze,
         .blasts = blasts_at(scene_pose, tables)});
    if (settings.motion_since) {
        plan.motion = plan_motion(camera, settings);
    }
    plan.motion_blur = plan_motion_blur(camera, plan.page, plan.lines.half_px, tables, settings);
    plan.lens = frame::plan_lens({.loaded = *loaded,
                                  .pose = scene_pose,
                                  .camera = camera,
                                  .style = tables,
                                  .page = plan.page,
                                  .line_half_px = plan.lines.half_px},
                                 notes);
    features.hatching.ensure_strokes(device, loaded->layout, plan.strokes);
    ensure_variants(plan);
    plan.toon = features.toon.ensure(device,
                                     {.layout = layout,
                                      .materials = loaded->materials,
                                      .variants = plan.variants,
                                      .has_sun = plan.sun.shines},
                                     notes);
    plan.local_shadows = features.shadows.ensure_local_maps(
        device, lighting, local_map_scene(plan.page, camera, tables), notes);
    upload_lighting(plan, lighting, tables);
    if (tables.smoke.enabled) {
        plan.lamps = features::smoke_lamps(lighting, plan.sun.map.size > 0);
        plan.light.ambient = luminance(lighting.ambient);
    }
    plan.light.adapt_stops = features.lighting.exposure().prepare(device, tables.light, settings.time_s);
    loaded->exposure_key.room = std::move(lighting.records);
    return plan;
}

features::FlowingInkInputs Renderer::Impl::ink_inputs(const Camera& camera,
                                                      const features::StyleTables& tables,
                                                      const RenderSettings& settings)
{
    const ScenePose& pose = pose_at(settings);
    return {.scene = loaded->scene,
            .layout = loaded->layout,
            .pose = pose,
            .camera = camera,
            .settings = settings,
            .style = tables,
            .nearby_m = tables.ink.enabled ? frame::nearby_m(loaded->layout, camera.eye) : 0.0F,
            .pose_moved = loaded->pose_moved,
            .blasts = blasts_at(pose, tables)};
}

std::vector<features::Blast> Renderer::Impl::blasts_at(const ScenePose& pose,
                                                       const features::StyleTables& tables) const
{
    return features::smoke_blasts(loaded->scene, pose, loaded->layout.anchor, tables.smoke);
}

std::optional<features::SmokePlan> Renderer::Impl::plan_smoke(const frame::FramePlan& plan,
                                                              const features::StyleTables& tables,
                                                              const RenderSettings& settings)
{
    return features.smoke.ensure(device, executor,
                                 {.scene = loaded->scene,
                                  .layout = loaded->layout,
                                  .pose = pose_at(settings),
                                  .settings = settings,
                                  .style = tables,
                                  .lamps = plan.lamps,
                                  .ambient = plan.light.ambient,
                                  .risen = plan.risen ? &*plan.risen : nullptr},
                                 notes);
}

features::LocalMapScene Renderer::Impl::local_map_scene(const frame::PagePlan& page_plan,
                                                        const Camera& camera,
                                                        const features::StyleTables& tables) const
{
    shadow::ShadowStyle style = tables.shadow;
    style.local_lights = tables.light.shadows ? style.local_lights : 0;
    return {.page = {.eye_anchor = glm::vec3(camera.eye - loaded->layout.anchor),
                     .pixel = page_plan.pixel,
                     .scene_radius_m = static_cast<float>(loaded->layout.bounds.radius()),
                     .longer_side_px = std::max(page_plan.size_px.x, page_plan.size_px.y)},
            .style = style,
            .casters = features::caster_kinds(loaded->layout)};
}

void Renderer::Impl::ensure_variants(const frame::FramePlan& plan)
{
    features.hatching.maps().ensure(device, plan.variants.styles);
    if (!plan.focus.lines.empty()) {
        gpu::upload_items(device, "focus lines", plan.focus.lines, features.lines.focus_lines());
    }
    if (plan.clouds) {
        features.clouds.upload(device, *plan.clouds);
    }
    features.occlusion.prepare(device, loaded->layout, loaded->materials,
                               plan.variants.styles.front().occlusion);
    ensure_surface_maps(plan);
    if (plan.motion_blur) {
        features.motion_blur.prepare(device, loaded->layout, plan.variants.styles.front().motion_blur);
    }
    if (plan.subsurface) {
        gpu::upload_items(device, "subsurface parameters", plan.subsurface->parameters,
                          buffers.subsurface_parameters);
    }
    if (plan.variants.has_several()) {
        const std::vector<uint32_t>& variants = plan.variants.variant_of_draw;
        gpu::upload_items(device, "style variants", variants, buffers.variant_of_draw);
    }
}

void Renderer::Impl::ensure_surface_maps(const frame::FramePlan& plan)
{
    const std::array<std::optional<uint32_t>, 2> wanted{plan.occlusion_texels, plan.scatter_texels};
    std::erase_if(loaded->surface_maps, [&](const auto& map) {
        return std::ranges::find(wanted, std::optional(map.first)) == wanted.end();
    });
    for (const std::optional<uint32_t>& size : wanted) {
        if (size && !loaded->surface_maps.contains(*size)) {
            loaded->surface_maps.emplace(
                *size,
                features::upload_surface_map(device, features::make_surface_map(loaded->layout, *size)));
        }
        if (size && loaded->surface_maps.at(*size).cut_draws > 0) {
            const std::string note = fmt::format("{} of the scene's objects have no coordinates of their own "
                                                 "that lay each place by itself: for "
                                                 "maps of surfaces they were cut into charts",
                                                 loaded->surface_maps.at(*size).cut_draws);
            if (std::ranges::find(notes, note) == notes.end()) {
                notes.push_back(note);
            }
        }
    }
}

void Renderer::Impl::upload_pixel_sizes(const frame::FramePlan& plan, const features::StyleTables& tables)
{
    const shared::SunShadow sun = features::sun_globals(plan.sun.map, plan.page.pixel, tables.shadow);
    features.shadows.upload(device, plan.shadow_edges.profile, sun);
    if (plan.variants.need_variant_lines()) {
        if (plan.variants.styles.size() > shared::most_ink_variants) {
            throw Error(fmt::format("single surfaces have {} different styles", plan.variants.styles.size()),
                        {}, fmt::format("at most {} are drawn at once", shared::most_ink_variants));
        }
        std::vector<shared::VariantLines> lines;
        for (const features::StyleTables& style : plan.variants.styles) {
            lines.push_back(contour::variant_lines_of(style.contour, plan.page.pixels_per_mm));
        }
        gpu::upload_items(device, "variant lines", lines, features.lines.variants());
        if (plan.subsurface && plan.subsurface->refracts) {
            for (size_t i = 0; i < lines.size(); ++i) {
                if (subsurface::is_clear(plan.variants.styles[i].subsurface)) {
                    std::ranges::fill(lines[i].width_of_kind, 0.0F);
                }
            }
            gpu::upload_items(device, "lines without clear bodies", lines, features.lines.variants_behind());
        }
    }
}

void Renderer::Impl::upload_lighting(const frame::FramePlan& plan, const light::Lighting& lighting,
                                     const features::StyleTables& tables)
{
    const pose::MeshData& layout = loaded->layout;
    const light::Paling paling =
        light::ground_paling(layout.bounds, layout.anchor, lighting.towards_sun, tables.light.paling);
    const light::SkyAndGround ambient = light::sky_and_ground(lighting.ambient);
    const shared::LightGlobals globals{.sky_ambient = ambient.sky,
                                       .ground_ambient = ambient.ground,
                                       .directional_count = lighting.directional_count,
                                       .local_count = plan.light.local_count,
                                       .falloff = tables.light.falloff,
                                       .paling = paling.share_per_m,
                                       .paling_at_anchor = paling.share_at_anchor};
    features.lighting.upload(device, globals, lighting.records);
    upload_pixel_sizes(plan, tables);
}

} // namespace estampe
