// SPDX-License-Identifier: MIT
#include "frame/renderer_impl.hpp"

#include <algorithm>
#include <bit>
#include <cstring>

#include <fmt/format.h>

#include <estampe/error.hpp>

#include "frame/baked_lights.hpp"
#include "frame/form_strokes.hpp"
#include "gpu/upload.hpp"
#include "shaders/stroke_kind.glsl.h"
#include "techniques/light/daylight.hpp"

namespace estampe {

namespace {

template <class T>
gpu::Buffer mapped_buffer(gpu::Device& device, const char* name, const T* items, size_t count)
{
    gpu::Buffer buffer(device, name, std::max<size_t>(count, 1) * sizeof(T), gpu::MemoryUse::upload);
    std::ranges::copy(std::as_bytes(std::span(items, count)), buffer.mapped().begin());
    return buffer;
}

} // namespace

Renderer::Renderer(const RendererOptions& options) : impl_(std::make_unique<Impl>(options)) {}

Renderer::~Renderer() = default;

Renderer::Renderer(Renderer&&) noexcept = default;

Renderer& Renderer::operator=(Renderer&&) noexcept = default;

const DeviceInfo& Renderer::device() const
{
    return impl_->device.info();
}

RasterPath Renderer::raster_path() const
{
    return impl_->raster_path;
}

void Renderer::set_scene(const Scene& scene, const Lightmap* lightmap)
{
    impl_->loaded.reset();
    impl_->sun_map.forget();
    impl_->local_shadows.forget();
    impl_->exposure.forget();
    impl_->line_history.forget();
    impl_->loaded = frame::load_onto_device(impl_->device, scene, lightmap);
}

void Renderer::Impl::update_pose(const ScenePose& scene_pose)
{
    pose::PoseData now = pose::pose_meshes(loaded->layout, loaded->scene, scene_pose);
    if (loaded->pose && *loaded->pose == now) {
        return;
    }
    if (loaded->pose) {
        const auto places = pose::moved_places(loaded->layout, *loaded->pose, now);
        moved.insert(moved.end(), places.begin(), places.end());
    }
    std::swap(loaded->meshes.posed_vertices[0], loaded->meshes.posed_vertices[1]);
    if (pose::upload_pose(device, loaded->meshes, loaded->layout, now)) {
        loaded->line_meshes.forget();
    }
    loaded->pose = std::move(now);
    loaded->pose_moved = true;
    sun_map.forget();
}

/// Plans the maps of local lights and says who goes without.
void Renderer::Impl::provide_local_shadows(frame::FramePlan& plan, light::Lighting& lighting,
                                           const Camera& camera, const frame::StyleTables& tables)
{
    shadow::ShadowStyle style = tables.shadow;
    style.local_lights = tables.light.shadows ? style.local_lights : 0;
    const frame::PageView page_view{.eye_anchor = glm::vec3(camera.eye - loaded->layout.anchor),
                                    .pixel = plan.pixel,
                                    .scene_radius_m = static_cast<float>(loaded->layout.bounds.radius()),
                                    .longer_side_px = std::max(plan.size_px.x, plan.size_px.y)};
    const frame::CasterKinds casters = frame::caster_kinds(loaded->layout);
    frame::LocalShadowPlan local = local_shadows.plan(lighting, moved, page_view, style, casters);
    moved.clear();
    gpu::Buffer& maps = local_shadow_buffers.maps;
    const uint64_t needed_bytes = std::max<uint64_t>(sizeof(uint32_t) * local.texel_count, 16);
    if (maps.empty() || maps.size_bytes() < needed_bytes) {
        maps = gpu::Buffer(device, "local shadow maps", needed_bytes, gpu::MemoryUse::device);
        local_shadows.forget();
        local = local_shadows.plan(lighting, {}, page_view, style, casters);
        local_shadow_buffers.layers = {};
    }
    local_shadow_buffers.shadows =
        mapped_buffer(device, "local shadows", local.shadows.data(), local.shadows.size());
    const auto to_device = [&](const char* name, const std::vector<shared::RasterView>& views) {
        return mapped_buffer(device, name, views.data(), views.size());
    };
    local_shadow_buffers.views = {.whole = to_device("local views", local.views.whole),
                                  .still = to_device("local views/still", local.views.still),
                                  .moving = to_device("local views/moving", local.views.moving)};
    if (!local.views.still.empty() && local_shadow_buffers.layers.empty()) {
        local_shadow_buffers.layers =
            gpu::Buffer(device, "local shadow layers", maps.size_bytes(), gpu::MemoryUse::device);
    }
    if (local.without > 0 && style.local_lights > 0) {
        notes.push_back(fmt::format("{} of the scene's lamps and spots throw no shadow: shadow.local_lights "
                                    "and shadow.local_megatexels allow {}",
                                    local.without, local.shadows.size()));
    }
    plan.has_local_shadows = !local.shadows.empty();
    plan.shadow_variant |= shadow::lamps_variant(local.shadows);
    plan.local_views = std::move(local.views);
}

void Renderer::Impl::provide_strokes(const frame::StrokePlan& strokes)
{
    if (loaded->stroke_kinds == strokes.kind_of_draw) {
        return;
    }
    stroke_kinds = gpu::upload_buffer(device, "stroke kinds", strokes.kind_of_draw);
    form_coordinates = gpu::upload_buffer(device, "form coordinates",
                                          strokes.has(shared::strokes_form)
                                              ? frame::form_coordinates(loaded->layout, strokes)
                                              : std::vector<glm::vec2>());
    loaded->stroke_kinds = strokes.kind_of_draw;
}

void Renderer::Impl::provide_map(const frame::StyleTables& style)
{
    if (!style.hatch.drawn || style.hatch.strokes != hatch::Strokes::map) {
        map.reset();
        map_choice.reset();
        return;
    }
    frame::MapChoice choice = frame::map_choice(style);
    if (map_choice != choice) {
        map_choice.reset();
        map = hatch::upload_map(device, frame::load_map(choice), choice.tone, choice.contrast);
        map_choice = std::move(choice);
    }
}

frame::FramePlan Renderer::Impl::plan(const light::Lighting& lighting, const frame::StyleTables& style,
                                      const Camera& camera, const RenderSettings& settings) const
{
    const Scene& scene = loaded->scene;
    // A file with a camera is a picture already; one with a sun besides is a picture out of doors.
    const bool is_composed = !scene.cameras.empty();
    const bool is_outdoors = is_composed && lighting.directional_count > 0 && !scene.lights.empty();
    frame::FramePlan plan;
    plan.size_px = {settings.width, settings.height};
    plan.pixels_per_mm = frame::pixels_per_mm(settings.height, style.paper.height_mm);
    plan.pixel = frame::pixel_size(camera, settings.height);
    plan.raster_path = raster_path;
    plan.on_processor = device.info().software;
    if (plan.on_processor) {
        // A processor draws a fairly large triangle faster on one thread than it hands tiles to many.
        plan.raster = {.small_area_px = 2048, .list_groups = 32};
    }
    plan.ground_drawn =
        style.picture.ground == frame::Ground::drawn ||
        (style.picture.ground == frame::Ground::automatic && !is_composed && !lighting.indoors);
    plan.sky_drawn =
        style.sky.mode == sky::SkyMode::drawn || (style.sky.mode == sky::SkyMode::automatic && is_outdoors);
    plan.needs = loaded->needs;
    plan.strokes = frame::plan_strokes(loaded->layout, loaded->scene.materials, style.hatch);
    plan.local_light_count = static_cast<uint32_t>(lighting.records.size()) - lighting.directional_count;
    plan.follows_local_light = plan.local_light_count > 0 && plan.strokes.has(shared::strokes_light);
    plan.has_light_links = lighting.has_groups || !loaded->has_plain_links;
    plan.sun_casters = lighting.sun_casters;
    plan.towards_sun = glm::vec3(lighting.towards_sun);
    const auto lines = frame::hatched_lines(style.hatch, plan.towards_sun, plan.has_directions());
    plan.shadow_variant = shadow::shadow_variant(style.shadow, lines);
    plan.edge_look = shadow::edge_look(style.shadow, lines, plan.pixels_per_mm);
    frame::plan_sun(plan,
                    {.casters = loaded->pose->casters,
                     .floor_m = loaded->layout.bounds.min.y,
                     .anchor = loaded->layout.anchor,
                     .towards_sun = lighting.towards_sun,
                     .throws_shadow = style.light.shadows && lighting.sun_casters != 0 &&
                                      lighting.directional_count > 0 && lighting.towards_sun.y > -0.999,
                     .most_bytes = std::min<uint64_t>(device.limits().maxStorageBufferRange,
                                                      4ULL * device.limits().maxTexelBufferElements)},
                    camera, style);
    plan.lines_shadows = style.contour.drawn && style.contour.lines == contour::Lines::chains &&
                         contour::has_lines(style.contour, shared::line_shadow) && plan.shadow_size > 0;
    return plan;
}

void Renderer::Impl::draw_sample(const Camera& camera, const frame::StyleTables& style,
                                 frame::FramePlan& plan, frame::StrokeLists* lists, frame::DeepPage* deep)
{
    const auto unit_m = static_cast<float>(loaded->layout.stroke_unit_m);
    const glm::vec3 eye_anchor(camera.eye - loaded->layout.anchor);
    const shared::FrameGlobals globals = frame::frame_globals(
        camera, loaded->layout.bounds, loaded->layout.anchor,
        {.size_px = plan.size_px,
         .jitter_px = frame::jitter(plan.accumulation.sample_index, plan.accumulation.sample_count),
         .page_height_mm = style.paper.height_mm,
         .nearby_m = unit_m * frame::nearby(loaded->layout.stroke_coordinates, eye_anchor / unit_m)});
    plan.clip_from_anchor = globals.clip_from_anchor;
    frame_globals = mapped_buffer(device, "frame", &globals, 1);
    sun_map.provide(device, plan);
    frame::FrameResources resources{loaded->meshes,
                                    loaded->materials,
                                    frame_globals,
                                    light_globals,
                                    lights,
                                    exposure.buffer(),
                                    sun_map.buffer(),
                                    edge_look,
                                    sun_shadow,
                                    local_shadow_buffers,
                                    stroke_kinds,
                                    form_coordinates,
                                    loaded->baked ? &loaded->baked->maps : nullptr,
                                    map ? &*map : nullptr,
                                    loaded->line_meshes.provide(device, loaded->layout, style.contour),
                                    line_history,
                                    line_brushes.provide(device, style.contour),
                                    page.sums,
                                    page.pixels,
                                    motion_pixels,
                                    lists,
                                    deep};
    plan.pose_moved = loaded->pose_moved;
    gpu::Graph graph;
    frame::declare_frame(graph, loaded->layout, resources, plan, style);
    std::unique_ptr<gpu::CompileAhead> compiling = std::move(ahead); // ends before the graph does
    if (compiling) {
        compiling->start(graph);
    }
    executor.run(graph);
    loaded->pose_moved = false;
    if (plan.remembers_lines) {
        line_history.end_frame(plan.clip_from_anchor);
        plan.remembers_lines = false;
    }
    plan.local_views = {};
    sun_map.drawn(plan);
    compiling.reset(); // it reads the graph
    drawn = std::move(graph);
}

frame::FramePlan Renderer::Impl::prepare(const Camera& camera, const frame::StyleTables& tables,
                                         const RenderSettings& settings)
{
    if (!loaded) {
        throw Error("there is no scene to draw", "", "call set_scene first");
    }
    frame::check_size(device, settings);
    frame::provide_page(device, page, settings);
    if (frame::style_lighting(device, *loaded, tables.light)) {
        sun_map.forget();
        local_shadows.forget();
    }
    motion = {};
    const pose::MeshData& layout = loaded->layout;
    const ScenePose scene_pose = pose_scene(loaded->scene, settings.time_s, settings.animation);
    if (settings.motion_since) {
        pose_before(pose_scene(loaded->scene, settings.motion_since->time_s, settings.animation));
    }
    update_pose(scene_pose);
    light::Lighting lighting =
        light::gather_lights(loaded->scene, scene_pose, layout.bounds, layout.anchor, tables.light,
                             loaded->house_light.outlook(loaded->scene, tables.light, camera.eye));
    const std::optional<light::Daylight> daylight = light::daylight_of(tables.sun);
    if (daylight) {
        light::set_daylight(lighting, *daylight, tables.light);
    }
    const float lightmap_scale = frame::make_room(lighting, loaded->baked, tables.lightmap);
    notes.clear();
    if (lighting.indoors) {
        notes.emplace_back("the scene has no light and the sun does not reach it: a lamp hangs in the room");
    }
    frame::FramePlan frame_plan = plan(lighting, tables, camera, settings);
    frame_plan.lightmap_scale = lightmap_scale;
    if (settings.motion_since) {
        frame_plan.motion = plan_motion(camera, settings);
    }
    if (daylight) {
        frame_plan.daylight_rad = static_cast<float>(daylight->elevation_rad);
    }
    const light::Paling paling =
        light::ground_paling(layout.bounds, layout.anchor, lighting.towards_sun, tables.light.paling);
    const light::SkyAndGround ambient = light::sky_and_ground(lighting.ambient);
    const shared::LightGlobals light_values{.sky_ambient = ambient.sky,
                                            .ground_ambient = ambient.ground,
                                            .directional_count = lighting.directional_count,
                                            .local_count = static_cast<uint32_t>(lighting.records.size()) -
                                                           lighting.directional_count,
                                            .falloff = tables.light.falloff,
                                            .paling = paling.share_per_m,
                                            .paling_at_anchor = paling.share_at_anchor};
    light_globals = mapped_buffer(device, "lighting", &light_values, 1);
    edge_look = mapped_buffer(device, "edges", &frame_plan.edge_look, 1);
    const shared::SunShadow sun_values = frame::sun_globals(frame_plan, tables.shadow);
    sun_shadow = mapped_buffer(device, "sun", &sun_values, 1);
    provide_map(tables);
    provide_strokes(frame_plan.strokes);
    provide_local_shadows(frame_plan, lighting, camera, tables);
    lights = mapped_buffer(device, "lights", lighting.records.data(), lighting.records.size());
    frame_plan.meters_page = tables.light.metering == light::Metering::page;
    frame_plan.adapt_stops = exposure.prepare(device, tables.light, settings.time_s);
    return frame_plan;
}

Image Renderer::Impl::draw_picture(const Camera& camera, const Style& style, const RenderSettings& settings,
                                   frame::DeepPage* deep, const std::function<void()>& after_sample)
{
    const frame::StyleTables& tables = style.tables();
    frame::FramePlan plan = prepare(camera, tables, settings);
    // Later samples of a picture of several go their own way by a pixel at most.
    plan.remembers_lines = settings.continuity != Continuity::still;
    if (plan.remembers_lines) {
        line_history.begin_frame(device, plan.size_px, settings.continuity == Continuity::follows,
                                 tables.contour.hidden != contour::Hidden::none);
    }
    for (uint32_t sample = 0; sample < settings.samples; ++sample) {
        plan.accumulation = {.sample_index = sample, .sample_count = settings.samples};
        draw_sample(camera, tables, plan, nullptr, deep);
        if (after_sample) {
            after_sample();
        }
    }
    if (settings.motion_since) {
        motion = frame::read_motion(motion_pixels, settings);
    }
    const auto bytes = page.pixels.mapped();
    Image image{.width = settings.width, .height = settings.height};
    const auto* first = reinterpret_cast<const uint8_t*>(bytes.data());
    image.rgba.assign(first, first + 4ULL * settings.width * settings.height);
    return image;
}

Image Renderer::render(const Camera& camera, const Style& style, const RenderSettings& settings)
{
    return impl_->draw_picture(camera, style, settings);
}

VectorDrawing Renderer::draw_strokes(const Camera& camera, const Style& style, const RenderSettings& settings,
                                     HiddenLines hidden)
{
    Impl& impl = *impl_;
    const frame::StyleTables& tables = style.tables();
    frame::check_has_paths(tables);
    frame::FramePlan plan = impl.prepare(camera, tables, settings);
    plan.motion.reset();
    if (tables.wash.strength > 0.0F || plan.sky_drawn || tables.bleed.width_mm > 0.0F) {
        impl.notes.emplace_back("a drawing of strokes has neither wash nor sky, nor ink that runs");
    }
    if (!frame::is_drawn_by_pen(tables.contour)) {
        impl.notes.emplace_back("a drawing of strokes has lines of the pen in place of other brushes");
    }
    frame::StrokeLists lists(impl.device);
    impl.draw_sample(camera, tables, plan, &lists);
    return frame::drawing_of(lists,
                             {.scene = impl.loaded->scene,
                              .layout = impl.loaded->layout,
                              .edges = impl.loaded->line_meshes.edges(),
                              .size_px = plan.size_px},
                             tables, hidden == HiddenLines::kept);
}

const Motion& Renderer::motion() const
{
    return impl_->motion;
}

const std::vector<std::string>& Renderer::notes() const
{
    return impl_->notes;
}

const std::vector<PassTiming>& Renderer::timings() const
{
    return impl_->executor.timings();
}

std::string Renderer::graph_dot() const
{
    return gpu::to_dot(impl_->drawn, gpu::compile(impl_->drawn));
}

} // namespace estampe
