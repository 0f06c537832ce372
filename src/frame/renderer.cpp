// SPDX-License-Identifier: MIT
#include "frame/renderer_impl.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <future>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include <estampe/error.hpp>

#include "core/free_memory.hpp"
#include "core/luminance.hpp"
#include "core/progress_watch.hpp"
#include "features/lighting/baked_lights.hpp"
#include "frame/depth_of_field.hpp"
#include "gpu/mapped_buffer.hpp"
#include "scene/extent.hpp"
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
        return unit_m * features::nearby(places, eye_rest / unit_m);
    }
    const float objects_m =
        unit_m * features::nearby(places.first(*layout.foreign_vertex), eye_rest / unit_m);
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
    return impl_->page_path.value_or(impl_->raster_path);
}

void Renderer::set_scene(const Scene& scene, const Lightmap* lightmap)
{
    impl_->loaded.reset();
    impl_->posed_scene = {};
    impl_->sun_map.forget();
    impl_->ground_shadow.forget();
    impl_->local_shadows.forget();
    impl_->exposure.forget();
    impl_->line_history.forget();
    impl_->flowing_ink.forget();
    impl_->rising_smoke.forget();
    impl_->is_of_film = false;
    impl_->loaded = frame::load_onto_device(impl_->device, scene, lightmap);
}

const ScenePose& Renderer::Impl::pose_at(const RenderSettings& settings)
{
    if (!posed_scene.is_known || posed_scene.time_s != settings.time_s ||
        posed_scene.animation != settings.animation) {
        posed_scene = {.pose = frame::pose_at(*loaded, settings.time_s, settings.animation),
                       .time_s = settings.time_s,
                       .animation = settings.animation,
                       .is_known = true};
    }
    return posed_scene.pose;
}

void Renderer::set_brightness(std::span<const LightBrightness> lights)
{
    if (!impl_->loaded) {
        throw Error("there is no scene whose lights could burn otherwise", "set_brightness",
                    "call set_scene first");
    }
    features::brighten(impl_->loaded->own_lighting, lights);
    impl_->loaded->styled_by.reset();
}

void Renderer::Impl::update_pose(const ScenePose& scene_pose)
{
    const bool is_kept = &scene_pose == &posed_scene.pose;
    const bool is_wanted = std::exchange(poses_anyway, false);
    if (is_kept && posed_scene.is_on_device && loaded->pose && !is_wanted) {
        return;
    }
    posed_scene.is_on_device = is_kept;
    pose::PoseData now = pose::pose_meshes(loaded->layout, loaded->scene, scene_pose);
    if (loaded->pose && *loaded->pose == now && !is_wanted) {
        return;
    }
    if (loaded->pose) {
        const auto places = pose::moved_places(loaded->layout, *loaded->pose, now);
        moved.insert(moved.end(), places.begin(), places.end());
        sun_map.move(places);
    } else {
        sun_map.move(std::vector{pose::everywhere()});
    }
    pose::swap_posed(loaded->meshes);
    if (pose::upload_pose(device, loaded->meshes, loaded->layout, now)) {
        loaded->line_meshes.forget();
    }
    loaded->pose = std::move(now);
    loaded->pose_moved = true;
}

features::SunCasters Renderer::Impl::sun_casters(const frame::FramePlan& plan) const
{
    // The device's own rasteriser gives depths other bits in another picture: a film that is taken up again
    // would not be the same to the byte.
    const features::CasterKinds kinds = features::caster_kinds(loaded->layout);
    const bool by_compute = plan.raster.paths.maps == RasterPath::compute;
    return {.layout = loaded->layout_number,
            .groups = plan.sun.casters,
            .by_compute = by_compute,
            .are_parted = by_compute && kinds.moving && kinds.still};
}

void Renderer::Impl::posed()
{
    if (loaded->pose_moved) {
        pose::keep_posed(loaded->meshes);
        loaded->pose_moved = false;
    }
}

namespace {

/// The map of that side, where there is one.
features::SurfaceMap* map_of(frame::LoadedScene& loaded, std::optional<uint32_t> size)
{
    return size ? &loaded.surface_maps.at(*size) : nullptr;
}

/// What the camera's globals are where a map is lit in place of the page.
shared::FrameGlobals map_globals(const shared::FrameGlobals& globals, uint32_t size)
{
    shared::FrameGlobals of_map = globals;
    of_map.size_px = glm::uvec2(size);
    of_map.page_px = glm::uvec2(size);
    of_map.tile_from_px = glm::uvec2(0);
    return of_map;
}

} // namespace

void Renderer::Impl::draw_frame(const Camera& camera, const features::StyleTables& style,
                                const frame::FramePlan& plan, const FrameJob& job)
{
    frame::forget_other_poses(*loaded);
    const paper::Accumulation& accumulation = job.accumulation;
    const shared::FrameGlobals globals = features::frame_globals(
        camera, loaded->layout.bounds, loaded->layout.anchor,
        {.size_px = plan.page_px,
         .tile = job.tile,
         .survey = job.survey,
         .jitter_px = features::jitter(accumulation.sample_index, accumulation.sample_count),
         .page_height_mm = style.paper.height_mm,
         .nearby_m = nearby_m(loaded->layout, camera.eye)});
    gpu::refill(device, "frame", std::span(&globals, 1), frame_globals);
    const shared::FrameGlobals of_map = map_globals(globals, plan.scatter_texels.value_or(1));
    gpu::refill(device, "frame of the map", std::span(&of_map, 1), map_frame_globals);
    const shared::FrameGlobals of_half = features::every_second(globals);
    gpu::refill(device, "frame of the half page", std::span(&of_half, 1), half_frame_globals);
    const frame::SamplePlan sample{.accumulation = accumulation,
                                   .is_first = job.is_first,
                                   .size_px = globals.size_px,
                                   .from_px = glm::vec2(globals.tile_from_px),
                                   .clip_from_anchor = features::drawn_clip(globals),
                                   .pose_moved = loaded->pose_moved,
                                   .terrain_moved = loaded->terrain_moved,
                                   .sun_map = sun_map.provide(device, plan.sun.map, sun_casters(plan)),
                                   .line_step_px = frame::line_step_px(job.survey ? job.survey->shrink : 1)};
    if (plan.sun.ground.is_thrown) {
        ground_shadow.provide(device, plan.sun.ground);
    }
    frame::FrameResources resources{.device = device,
                                    .frame_lists = frame_lists,
                                    .meshes = loaded->meshes,
                                    .cluster_boxes = loaded->cluster_boxes,
                                    .pose = *loaded->pose,
                                    .materials = loaded->materials,
                                    .frame_globals = frame_globals,
                                    .light_globals = light_globals,
                                    .lights = lights,
                                    .exposure = exposure.buffer(),
                                    .shadow_map = sun_map.buffer(),
                                    .still_shadow_map = sun_map.still(),
                                    .sun_views = sun_map.views(),
                                    .sun_pictures = sun_map.pictures(),
                                    .sun_tiles = sun_map.tiles(),
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
                                    .disc_map = loaded->disc_map,
                                    .occlusion_map = map_of(*loaded, plan.occlusion_texels),
                                    .scatter_map = map_of(*loaded, plan.scatter_texels),
                                    .map_frame = map_frame_globals,
                                    .half_frame = half_frame_globals,
                                    .together = loaded->together,
                                    .smear_seeds = loaded->smear_seeds,
                                    .still_casters = loaded->still_casters,
                                    .ground_shadow = ground_shadow,
                                    .cloth = loaded->cloth.get(),
                                    .cloth_steps = last_of_cloth ? &*last_of_cloth : nullptr,
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
    declared.clear();
    if (last_of_cloth) {
        loaded->cloth->forget(); // unless the graph runs
    }
    frame::declare_frame(declared, loaded->layout, resources, plan, sample, style);
    std::unique_ptr<gpu::CompileAhead> compiling = std::move(ahead); // ends before the graph does
    if (compiling) {
        compiling->start(declared);
    }
    executor.run(declared);
    executor.replace_timings(); // by those of the next sample
    posed();
    loaded->terrain_moved = false;
    if (loaded->cloth) {
        loaded->cloth->has_moved = false;
        if (last_of_cloth) {
            loaded->cloth->stands_at(last_of_cloth->to_s);
            last_of_cloth.reset();
        }
    }
    if (plan.lines.are_remembered && sample.is_first) {
        line_history.end_frame(sample.clip_from_anchor);
    }
    sun_map.drawn(plan.sun.map);
    if (plan.sun.ground.is_thrown) {
        ground_shadow.drawn(plan.sun.ground, *loaded->terrain);
    }
    compiling.reset(); // it reads the graph
    std::swap(drawn, declared);
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
    return features::seen_within(camera, window_share(style, settings));
}

light::Lighting Renderer::Impl::gather_lights(const Camera& camera, const ScenePose& scene_pose,
                                              const features::StyleTables& tables)
{
    // What lines will want is found in the meantime.
    const std::future<void> edges = loaded->line_meshes.find_edges(loaded->layout, tables.contour);
    return light::gather_lights(
        loaded->scene, scene_pose, loaded->layout.bounds, loaded->layout.anchor, tables.light,
        loaded->house_light.outlook(loaded->scene, tables.light, camera.eye), &loaded->key_light);
}

frame::FramePlan Renderer::Impl::prepare(const Camera& camera, const features::StyleTables& tables,
                                         const RenderSettings& settings)
{
    if (!loaded) {
        throw Error("there is no scene to draw", "", "call set_scene first");
    }
    frame::check_page(settings);
    if (frame::style_lighting(device, *loaded, tables.light)) {
        posed_scene = {};
        sun_map.forget();
        local_shadows.forget();
    }
    motion = {};
    is_of_film = settings.continuity != Continuity::still;
    executor.add_timings();
    executor.time_passes(settings.time_passes || settings.measure_solvers);
    follow_eye(camera);
    const pose::MeshData& layout = loaded->layout;
    const ScenePose& scene_pose = pose_at(settings);
    check_places(loaded->scene, scene_pose);
    notes = loaded->notes;
    const auto risen = blow_cloth(scene_pose, tables, settings);
    const bool is_posed_for_cloth = update_cloth(settings, tables);
    const bool has_cloth_moved = loaded->cloth && loaded->cloth->has_moved;
    const std::optional<double> before_s = moment_before(settings, tables);
    // Of the picture before, which ink goes on from, the device has it.
    const bool is_there = before_s && !settings.motion_since && loaded->pose && !is_posed_for_cloth &&
                          before_s == flowing_ink.before_s(settings, tables.ink);
    // Both moments are posed, though nothing but cloth may differ.
    poses_anyway = before_s && has_cloth_moved;
    if (before_s && !is_there) {
        pose_before(frame::pose_at(*loaded, *before_s, settings.animation));
        poses_anyway = has_cloth_moved;
    }
    update_pose(scene_pose);
    if (has_cloth_moved) {
        loaded->pose_moved = true;
        place_cloth(scene_pose, settings, tables);
    }
    update_terrain(camera, settings, tables);
    light::Lighting lighting = gather_lights(camera, scene_pose, tables);
    const std::optional<light::Daylight> daylight = light::daylight_of(tables.sun);
    if (daylight) {
        light::set_daylight(lighting, *daylight, tables.light);
    }
    if (tables.smoke.drawn && tables.smoke.glow > 0.0F) {
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
                                               .clouds = cloud_memory},
                                              std::exchange(plan_lists, {}));
    page_path = plan.raster.paths.page;
    plan.light.lightmap_scale = lightmap_scale;
    plan.risen = risen;
    plan.particles = features::provide_particles(
        device, executor, particles,
        {.scene = loaded->scene,
         .layout = loaded->layout,
         .emitting = loaded->emitting,
         .are_nodes_placed = !loaded->placed.empty(),
         .pose = scene_pose,
         .pose_at = [&](double time_s) { return frame::pose_at(*loaded, time_s, settings.animation); },
         .camera = camera,
         .settings = settings,
         .style = tables});
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
        plan.lamps = features::smoke_lamps(lighting, plan.sun.map.size > 0);
        plan.light.ambient = luminance(lighting.ambient);
    }
    plan.light.adapt_stops = exposure.prepare(device, tables.light, settings.time_s);
    loaded->key_light.room = std::move(lighting.records);
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
            .nearby_m = tables.ink.drawn ? nearby_m(loaded->layout, camera.eye) : 0.0F,
            .pose_moved = loaded->pose_moved};
}

std::optional<features::SmokePlan> Renderer::Impl::plan_smoke(const frame::FramePlan& plan,
                                                              const features::StyleTables& tables,
                                                              const RenderSettings& settings)
{
    return rising_smoke.provide(device, executor,
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

Image Renderer::Impl::draw_picture(const Camera& camera, const Style& style, const RenderSettings& settings,
                                   frame::DeepPage* deep, const std::function<void()>& after_sample,
                                   const VulkanPicture* target)
{
    const features::StyleTables& tables = style.tables();
    const Camera seen_by = page_camera(camera, tables.paper, settings);
    RenderSettings page_settings = settings;
    for (std::optional<Moment>* const moment : {&page_settings.motion_since, &page_settings.exposure_end}) {
        if (*moment) {
            (*moment)->camera = page_camera((*moment)->camera, tables.paper, settings);
        }
    }
    frame::FramePlan plan = prepare(seen_by, tables, page_settings);
    plan.ink = flowing_ink.provide(device, executor, ink_inputs(seen_by, tables, settings), notes);
    plan.smoke = plan_smoke(plan, tables, settings);
    frame::provide_page(device, page, plan.page_px, settings.samples);
    // Later samples of a picture of several go their own way by a pixel at most.
    plan.lines.are_remembered =
        is_of_film && loaded->line_meshes.provide(device, loaded->layout, plan.looks.lines) != nullptr;
    if (plan.lines.are_remembered) {
        line_history.begin_frame(device, plan.page.size_px, settings.continuity == Continuity::follows,
                                 tables.contour.hidden != contour::Hidden::none);
    } else if (is_of_film) {
        line_history.forget();
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
        motion = features::read_motion(motion_pixels, settings);
    }
    plan_lists = {std::move(plan.looks.styles), std::move(plan.strokes.kind_of_draw)};
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
    const features::StyleTables& tables = style.tables();
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
        impl.notes.emplace_back("a drawing of strokes has no motion blur, no speed lines and no smear");
        plan.motion_blur.reset();
    }
    if (plan.lens) {
        impl.notes.emplace_back("a drawing of strokes has no lens: all of it is in focus");
        plan.lens.reset();
    }
    if (!plan.particles.empty()) {
        impl.notes.emplace_back("a drawing of strokes has no particles");
    }
    if (!features::is_drawn_by_pen(tables.contour)) {
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

} // namespace estampe
