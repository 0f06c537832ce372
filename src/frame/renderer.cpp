// SPDX-License-Identifier: MIT
#include "frame/renderer_impl.hpp"

#include <algorithm>
#include <bit>
#include <cstring>
#include <tuple>

#include <fmt/format.h>

#include <estampe/error.hpp>

#include "core/free_memory.hpp"
#include "core/luminance.hpp"
#include "core/progress_watch.hpp"
#include "frame/baked_lights.hpp"
#include "frame/depth_of_field.hpp"
#include "frame/form_strokes.hpp"
#include "frame/mapped_buffer.hpp"
#include "gpu/upload.hpp"
#include "scene/extent.hpp"
#include "shaders/stroke_kind.glsl.h"
#include "techniques/contour/chains/chains.hpp"
#include "techniques/light/daylight.hpp"

namespace estampe {

namespace {

/// How far from the eye what stands in front is; a terrain, which is everywhere, keeps it near.
float nearby_m(const pose::MeshData& layout, const glm::dvec3& eye)
{
    constexpr float near_ground_m = 20.0F;
    const auto unit_m = static_cast<float>(layout.stroke_unit_m);
    const glm::vec3 eye_rest(eye - layout.rest_anchor);
    const std::span places(layout.stroke_coordinates);
    if (!layout.foreign_vertex) {
        return unit_m * frame::nearby(places, eye_rest / unit_m);
    }
    const float objects_m = unit_m * frame::nearby(places.first(*layout.foreign_vertex), eye_rest / unit_m);
    return objects_m > 0.0F ? std::min(objects_m, near_ground_m) : near_ground_m;
}

} // namespace

Renderer::Renderer(const RendererOptions& options) : impl_(std::make_unique<Impl>(options)) {}

Renderer::Renderer(const VulkanHost& host, const RendererOptions& options)
    : impl_(std::make_unique<Impl>(host, options))
{
}

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
    impl_->ground_shadow.forget();
    impl_->local_shadows.forget();
    impl_->exposure.forget();
    impl_->line_history.forget();
    impl_->flowing_ink.forget();
    impl_->rising_smoke.forget();
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

frame::LocalMapPlan Renderer::Impl::provide_local_shadows(const frame::PagePlan& page_plan,
                                                          light::Lighting& lighting, const Camera& camera,
                                                          const frame::StyleTables& tables)
{
    shadow::ShadowStyle style = tables.shadow;
    style.local_lights = tables.light.shadows ? style.local_lights : 0;
    const frame::PageView page_view{.eye_anchor = glm::vec3(camera.eye - loaded->layout.anchor),
                                    .pixel = page_plan.pixel,
                                    .scene_radius_m = static_cast<float>(loaded->layout.bounds.radius()),
                                    .longer_side_px = std::max(page_plan.size_px.x, page_plan.size_px.y)};
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
    local_shadow_buffers.shadows = frame::mapped_buffer(device, "local shadows", local.shadows);
    const auto to_device = [&](const char* name, const std::vector<shared::RasterView>& views) {
        return frame::mapped_buffer(device, name, views);
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
    return {.is_there = !local.shadows.empty(),
            .variant = shadow::lamps_variant(local.shadows),
            .views = std::move(local.views)};
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

void Renderer::Impl::provide_looks(const frame::FramePlan& plan)
{
    tonal_maps.provide(device, plan.looks.styles);
    if (!plan.focus.lines.empty()) {
        focus_lines = frame::mapped_buffer(device, "focus lines", plan.focus.lines);
    }
    if (plan.clouds) {
        clouds = frame::cloud_buffers(device, *plan.clouds);
    }
    if (const occlusion::OcclusionStyle& style = plan.looks.styles.front().occlusion;
        style.drawn && style.method == occlusion::Method::discs && loaded->discs.empty()) {
        loaded->discs = frame::discs_of(device, loaded->layout);
    }
    if (plan.subsurface) {
        subsurface_looks = frame::mapped_buffer(device, "subsurface looks", plan.subsurface->looks);
    }
    if (plan.looks.has_several()) {
        const std::vector<uint32_t>& looks = plan.looks.look_of_draw;
        look_of_draw = frame::mapped_buffer(device, "looks", looks);
    }
}

void Renderer::Impl::draw_frame(const Camera& camera, const frame::StyleTables& style,
                                const frame::FramePlan& plan, const FrameJob& job)
{
    const paper::Accumulation& accumulation = job.accumulation;
    const shared::FrameGlobals globals = frame::frame_globals(
        camera, loaded->layout.bounds, loaded->layout.anchor,
        {.size_px = plan.page_px,
         .tile = job.tile,
         .survey = job.survey,
         .jitter_px = frame::jitter(accumulation.sample_index, accumulation.sample_count),
         .page_height_mm = style.paper.height_mm,
         .nearby_m = nearby_m(loaded->layout, camera.eye)});
    frame_globals = frame::mapped_buffer(device, "frame", std::span(&globals, 1));
    const frame::SamplePlan sample{.accumulation = accumulation,
                                   .is_first = job.is_first,
                                   .size_px = globals.size_px,
                                   .from_px = glm::vec2(globals.tile_from_px),
                                   .clip_from_anchor = frame::drawn_clip(globals),
                                   .pose_moved = loaded->pose_moved,
                                   .terrain_moved = loaded->terrain_moved,
                                   .sun_map = sun_map.provide(device, plan.sun.map),
                                   .line_step_px = frame::line_step_px(job.survey ? job.survey->shrink : 1)};
    if (plan.sun.ground.is_thrown) {
        ground_shadow.provide(device, plan.sun.ground);
    }
    frame::FrameResources resources{.device = device,
                                    .meshes = loaded->meshes,
                                    .materials = loaded->materials,
                                    .frame_globals = frame_globals,
                                    .light_globals = light_globals,
                                    .lights = lights,
                                    .exposure = exposure.buffer(),
                                    .shadow_map = sun_map.buffer(),
                                    .edge_look = edge_look,
                                    .sun_shadow = sun_shadow,
                                    .local_shadows = local_shadow_buffers,
                                    .stroke_kinds = stroke_kinds,
                                    .form_coordinates = form_coordinates,
                                    .lightmaps = loaded->baked ? &loaded->baked->maps : nullptr,
                                    .maps = tonal_maps,
                                    .look_of_draw = look_of_draw,
                                    .line_looks = line_looks,
                                    .subsurface_looks = subsurface_looks,
                                    .discs = loaded->discs,
                                    .ground_shadow = ground_shadow,
                                    .cloth = loaded->cloth.get(),
                                    .terrain = loaded->terrain.get(),
                                    .trodden = loaded->trodden.get(),
                                    .line_mesh =
                                        loaded->line_meshes.provide(device, loaded->layout, plan.looks.lines),
                                    .line_history = line_history,
                                    .focus_lines = focus_lines,
                                    .clouds = clouds,
                                    .particles = particles,
                                    .brushes = line_brushes.provide(device, plan.looks.lines),
                                    .sums = page.sums,
                                    .pixels = page.pixels,
                                    .motion = motion_pixels,
                                    .ink = flowing_ink.memory(),
                                    .smoke = rising_smoke,
                                    .lists = job.lists,
                                    .deep = job.deep,
                                    .strung = job.strung,
                                    .strung_into = job.strung_into,
                                    .target = job.target};
    gpu::Graph graph;
    frame::declare_frame(graph, loaded->layout, resources, plan, sample, style);
    std::unique_ptr<gpu::CompileAhead> compiling = std::move(ahead); // ends before the graph does
    if (compiling) {
        compiling->start(graph);
    }
    executor.run(graph);
    executor.replace_timings(); // by those of the next sample
    loaded->pose_moved = false;
    loaded->terrain_moved = false;
    if (loaded->cloth) {
        loaded->cloth->has_moved = false;
    }
    if (plan.lines.are_remembered && sample.is_first) {
        line_history.end_frame(sample.clip_from_anchor);
    }
    sun_map.drawn(plan.sun.map);
    if (plan.sun.ground.is_thrown) {
        ground_shadow.drawn(plan.sun.ground, *loaded->terrain);
    }
    compiling.reset(); // it reads the graph
    drawn = std::move(graph);
}

namespace {

/// How much of the page's height its margin leaves.
double window_share(const paper::PaperStyle& style, const RenderSettings& settings)
{
    const float page_width_mm =
        style.height_mm * static_cast<float>(settings.width) / static_cast<float>(settings.height);
    const paper::Window window = paper::window_of(style, page_width_mm);
    return static_cast<double>(window.max_mm.y - window.min_mm.y) / style.height_mm;
}

} // namespace

Camera page_camera(const Camera& camera, const paper::PaperStyle& style, const RenderSettings& settings)
{
    check_camera(camera);
    return frame::seen_within(camera, window_share(style, settings));
}

void Renderer::Impl::provide_pixel_sizes(const frame::FramePlan& plan, const frame::StyleTables& tables)
{
    edge_look = frame::mapped_buffer(device, "edges", std::span(&plan.shadow_edges.look, 1));
    const shared::SunShadow sun = frame::sun_globals(plan.sun.map, plan.page.pixel, tables.shadow);
    sun_shadow = frame::mapped_buffer(device, "sun", std::span(&sun, 1));
    if (plan.looks.has_several()) {
        std::vector<shared::LineLook> lines;
        for (const frame::StyleTables& style : plan.looks.styles) {
            lines.push_back(contour::line_look(style.contour, plan.page.pixels_per_mm));
        }
        line_looks = frame::mapped_buffer(device, "line looks", lines);
    }
}

void Renderer::Impl::provide_lighting(const frame::FramePlan& plan, const light::Lighting& lighting,
                                      const frame::StyleTables& tables)
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
    light_globals = frame::mapped_buffer(device, "lighting", std::span(&globals, 1));
    provide_pixel_sizes(plan, tables);
    lights = frame::mapped_buffer(device, "lights", lighting.records);
}

frame::FramePlan Renderer::Impl::prepare(const Camera& camera, const frame::StyleTables& tables,
                                         const RenderSettings& settings)
{
    if (!loaded) {
        throw Error("there is no scene to draw", "", "call set_scene first");
    }
    frame::check_page(settings);
    if (frame::style_lighting(device, *loaded, tables.light)) {
        sun_map.forget();
        local_shadows.forget();
    }
    motion = {};
    executor.add_timings();
    follow_eye(camera);
    const pose::MeshData& layout = loaded->layout;
    const ScenePose scene_pose = pose_scene(loaded->scene, settings.time_s, settings.animation);
    check_places(loaded->scene, scene_pose);
    update_cloth(settings, tables);
    const bool has_cloth_moved = loaded->cloth && loaded->cloth->has_moved;
    const std::optional<double> before_s = moment_before(settings, tables);
    // Of the picture before, which ink goes on from, the device has it.
    const bool is_there = before_s && !settings.motion_since && loaded->pose && !has_cloth_moved &&
                          before_s == flowing_ink.before_s(settings, tables.ink);
    if (before_s && !is_there) {
        if (has_cloth_moved) {
            loaded->pose.reset(); // both moments are posed, though nothing but cloth may differ
        }
        pose_before(pose_scene(loaded->scene, *before_s, settings.animation));
        if (has_cloth_moved) {
            loaded->pose.reset();
        }
    }
    update_pose(scene_pose);
    loaded->pose_moved = loaded->pose_moved || has_cloth_moved;
    update_terrain(camera, settings, tables);
    light::Lighting lighting =
        light::gather_lights(loaded->scene, scene_pose, layout.bounds, layout.anchor, tables.light,
                             loaded->house_light.outlook(loaded->scene, tables.light, camera.eye));
    const std::optional<light::Daylight> daylight = light::daylight_of(tables.sun);
    if (daylight) {
        light::set_daylight(lighting, *daylight, tables.light);
    }
    const float lightmap_scale = frame::make_room(lighting, loaded->baked, tables.lightmap);
    notes = loaded->notes;
    if (loaded->terrain && !loaded->terrain->problem().empty()) {
        notes.push_back(fmt::format("the ground is drawn slowly: {}", loaded->terrain->problem()));
    }
    std::ranges::copy(frame::idle_overrides(loaded->scene, tables), std::back_inserter(notes));
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
                                               .raster_path = raster_path});
    plan.light.lightmap_scale = lightmap_scale;
    plan.particles = frame::provide_particles(
        device, executor, particles,
        {.loaded = *loaded, .pose = scene_pose, .camera = camera, .settings = settings, .style = tables});
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
    provide_strokes(plan.strokes);
    provide_looks(plan);
    plan.local_shadows = provide_local_shadows(plan.page, lighting, camera, tables);
    provide_lighting(plan, lighting, tables);
    if (tables.smoke.drawn) {
        plan.lamps = frame::smoke_lamps(lighting);
        plan.light.ambient = luminance(lighting.ambient);
    }
    plan.light.adapt_stops = exposure.prepare(device, tables.light, settings.time_s);
    return plan;
}

std::optional<frame::InkPlan> Renderer::Impl::plan_ink(const Camera& camera, const frame::StyleTables& tables,
                                                       const RenderSettings& settings)
{
    return flowing_ink.provide(device,
                               {.loaded = *loaded,
                                .pose = pose_scene(loaded->scene, settings.time_s, settings.animation),
                                .camera = camera,
                                .settings = settings,
                                .style = tables,
                                .nearby_m = nearby_m(loaded->layout, camera.eye)},
                               notes);
}

std::optional<frame::SmokePlan> Renderer::Impl::plan_smoke(const frame::FramePlan& plan,
                                                           const frame::StyleTables& tables,
                                                           const RenderSettings& settings)
{
    return rising_smoke.provide(device, executor,
                                {.loaded = *loaded,
                                 .pose = pose_scene(loaded->scene, settings.time_s, settings.animation),
                                 .settings = settings,
                                 .style = tables,
                                 .lamps = plan.lamps,
                                 .ambient = plan.light.ambient},
                                notes);
}

Image Renderer::Impl::draw_picture(const Camera& camera, const Style& style, const RenderSettings& settings,
                                   frame::DeepPage* deep, const std::function<void()>& after_sample,
                                   const VulkanPicture* target)
{
    const frame::StyleTables& tables = style.tables();
    const Camera seen_by = page_camera(camera, tables.paper, settings);
    RenderSettings page_settings = settings;
    for (std::optional<Moment>* const moment : {&page_settings.motion_since, &page_settings.exposure_end}) {
        if (*moment) {
            (*moment)->camera = page_camera((*moment)->camera, tables.paper, settings);
        }
    }
    frame::FramePlan plan = prepare(seen_by, tables, page_settings);
    plan.ink = plan_ink(seen_by, tables, settings);
    plan.smoke = plan_smoke(plan, tables, settings);
    frame::provide_page(device, page, plan.page_px, settings.samples);
    // Later samples of a picture of several go their own way by a pixel at most.
    plan.lines.are_remembered = settings.continuity != Continuity::still;
    if (plan.lines.are_remembered) {
        line_history.begin_frame(device, plan.page.size_px, settings.continuity == Continuity::follows,
                                 tables.contour.hidden != contour::Hidden::none);
    }
    for (uint32_t sample = 0; sample < settings.samples; ++sample) {
        report_progress(static_cast<double>(sample) / settings.samples);
        draw_frame(seen_by, tables, plan,
                   {.accumulation = {.sample_index = sample, .sample_count = settings.samples},
                    .is_first = sample == 0,
                    .deep = deep,
                    .target = target});
        if (plan.ink && sample == 0) {
            flowing_ink.drawn(*plan.ink, seen_by);
        }
        if (after_sample) {
            after_sample();
        }
    }
    if (settings.motion_since) {
        motion = frame::read_motion(motion_pixels, settings);
    }
    if (target != nullptr) {
        return {};
    }
    const auto bytes = page.pixels.mapped();
    Image image{.width = settings.width, .height = settings.height};
    const auto* first = reinterpret_cast<const uint8_t*>(bytes.data());
    image.rgba.assign(first, first + 4ULL * settings.width * settings.height);
    return image;
}

Image Renderer::render(const Camera& camera, const Style& style, const RenderSettings& settings)
{
    if (!impl_->is_tiled(settings)) {
        return impl_->draw_picture(camera, style, settings);
    }
    const uint64_t size_bytes = uint64_t{4} * settings.width * settings.height;
    require_memory(size_bytes, fmt::format("a picture of {} x {} pixels", settings.width, settings.height),
                   "size", "draw a smaller one");
    Image image{.width = settings.width, .height = settings.height};
    image.rgba.reserve(size_bytes);
    impl_->draw_tiles(camera, style, settings, {.take = [&](const Image& band) {
                          image.rgba.insert(image.rgba.end(), band.rgba.begin(), band.rgba.end());
                      }});
    return image;
}

void Renderer::render_bands(const Camera& camera, const Style& style, const RenderSettings& settings,
                            const BandSink& sink)
{
    if (impl_->is_tiled(settings)) {
        impl_->draw_tiles(camera, style, settings, sink);
    } else {
        sink.take(impl_->draw_picture(camera, style, settings));
    }
}

void Renderer::render_to(const VulkanPicture& picture, const Camera& camera, const Style& style,
                         const RenderSettings& settings)
{
    if (!impl_->device.is_borrowed()) {
        throw Error("the picture is of another device than the renderer's", "render_to",
                    "make the renderer with the host's");
    }
    frame::check_size(impl_->device, settings);
    std::ignore = impl_->draw_picture(camera, style, settings, nullptr, {}, &picture);
}

VectorDrawing Renderer::draw_strokes(const Camera& camera, const Style& style, const RenderSettings& settings,
                                     HiddenLines hidden)
{
    Impl& impl = *impl_;
    const frame::StyleTables& tables = style.tables();
    frame::check_size(impl.device, settings);
    const Camera seen_by = page_camera(camera, tables.paper, settings);
    frame::FramePlan plan = impl.prepare(seen_by, tables, settings);
    frame::check_has_paths(plan.looks);
    plan.motion.reset();
    if (tables.wash.strength > 0.0F || plan.page.has_sky || tables.bleed.width_mm > 0.0F ||
        tables.ink.drawn || tables.smoke.drawn) {
        impl.notes.emplace_back(
            "a drawing of strokes has neither wash nor sky, nor ink that runs or flows, nor smoke");
    }
    if (plan.motion_blur) {
        impl.notes.emplace_back("a drawing of strokes has no motion blur and no speed lines");
        plan.motion_blur.reset();
    }
    if (plan.lens) {
        impl.notes.emplace_back("a drawing of strokes has no lens: all of it is in focus");
        plan.lens.reset();
    }
    if (plan.particles) {
        impl.notes.emplace_back("a drawing of strokes has no particles");
    }
    if (!frame::is_drawn_by_pen(tables.contour)) {
        impl.notes.emplace_back("a drawing of strokes has lines of the pen in place of other brushes");
    }
    frame::StrokeLists lists(impl.device);
    impl.draw_frame(seen_by, tables, plan, {.lists = &lists});
    return frame::drawing_of(lists,
                             {.scene = impl.loaded->scene,
                              .layout = impl.loaded->layout,
                              .edges = impl.loaded->line_meshes.edges(),
                              .size_px = plan.page.size_px},
                             plan, hidden == HiddenLines::kept);
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

uint64_t Renderer::device_memory_bytes() const
{
    return impl_->device.memory().used_bytes();
}

std::string Renderer::graph_dot() const
{
    return gpu::to_dot(impl_->drawn, gpu::compile(impl_->drawn));
}

} // namespace estampe
