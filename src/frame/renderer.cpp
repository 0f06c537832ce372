// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <estampe/error.hpp>

#include "core/free_memory.hpp"
#include "core/job_limits.hpp"
#include "core/long_jobs.hpp"
#include "frame/renderer_impl.hpp"
#include "gpu/resources.hpp"
#include "scene/scene_limits.hpp"
#include "techniques/contour/chains/chains.hpp"

namespace estampe {

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
    check_faults(scene, scene.name);
    impl_->loaded.reset();
    impl_->posed_scene = {};
    impl_->features.invalidate(features::Event::scene_replaced);
    impl_->is_of_film = false;
    impl_->loaded = frame::load_onto_device(impl_->device, scene, lightmap);
    impl_->known_layout = 0;
    impl_->note_layout();
}

void Renderer::Impl::note_layout()
{
    if (loaded->layout_number != known_layout) {
        known_layout = loaded->layout_number;
        features.invalidate(features::Event::layout_replaced);
        features.cloth.cut(device, loaded->scene, loaded->layout);
    }
}

std::vector<std::byte> Renderer::film_memory() const
{
    return impl_->is_of_film ? frame::save_film(impl_->features, impl_->device, impl_->executor)
                             : std::vector<std::byte>();
}

void Renderer::recall_film(std::span<const std::byte> memory)
{
    if (!impl_->loaded) {
        throw Error("there is no scene to draw", "", "call set_scene first");
    }
    frame::load_film(impl_->features, impl_->device, memory);
    impl_->is_of_film = true;
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
    const bool is_wanted = std::exchange(force_repose, false);
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
        features.shadows.move(places);
    } else {
        features.shadows.sun().move(std::vector{pose::everywhere()});
    }
    pose::swap_posed(loaded->meshes);
    if (pose::upload_pose(device, loaded->meshes, loaded->layout, now)) {
        features.invalidate(features::Event::triangles_changed);
    }
    loaded->pose = std::move(now);
    loaded->pose_moved = true;
}

void Renderer::Impl::posed()
{
    if (loaded->pose_moved) {
        pose::keep_posed(loaded->meshes);
        loaded->pose_moved = false;
    }
}

namespace {

/// Returns the FrameGlobals (camera and page) for lighting a square texture atlas, not the page.
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
    if (loaded->pose_moved) {
        features.invalidate(features::Event::pose_changed);
    }
    if (loaded->pose_moved || loaded->terrain_moved) {
        loaded->cluster_boxes.forget();
    }
    const paper::Accumulation& accumulation = job.accumulation;
    const shared::FrameGlobals globals = features::frame_globals(
        camera, loaded->layout.bounds, loaded->layout.anchor,
        {.size_px = plan.page_px,
         .tile = job.tile,
         .survey = job.survey,
         .jitter_px = features::jitter(accumulation.sample_index, accumulation.sample_count),
         .page_height_mm = style.paper.height_mm,
         .nearby_m = frame::nearby_m(loaded->layout, camera.eye)});
    gpu::upload_items(device, "frame", std::span(&globals, 1), buffers.frame_globals);
    const shared::FrameGlobals of_map = map_globals(globals, plan.scatter_texels.value_or(1));
    gpu::upload_items(device, "frame of the map", std::span(&of_map, 1), buffers.map_frame_globals);
    const shared::FrameGlobals of_half = features::every_second(globals);
    gpu::upload_items(device, "frame of the half page", std::span(&of_half, 1), buffers.half_frame_globals);
    const frame::SamplePlan sample{.accumulation = accumulation,
                                   .is_first = job.is_first,
                                   .size_px = globals.size_px,
                                   .from_px = glm::vec2(globals.tile_from_px),
                                   .clip_from_anchor = features::drawn_clip(globals),
                                   .pose_moved = loaded->pose_moved,
                                   .terrain_moved = loaded->terrain_moved,
                                   .sun_map = features.shadows.sun().ensure(
                                       device, plan.sun.map,
                                       features::sun_casters(loaded->layout, loaded->layout_number,
                                                             plan.sun.casters, plan.raster.paths.maps)),
                                   .line_step_px = frame::line_step_px(job.survey ? job.survey->shrink : 1)};
    if (plan.sun.ground.is_thrown) {
        features.shadows.ground().ensure(device, plan.sun.ground);
    }
    features.lines.ensure(device, loaded->layout, plan.variants.lines);
    frame::FrameContext context{.graph = declared,
                                .device = device,
                                .loaded = *loaded,
                                .features = features,
                                .buffers = buffers,
                                .job = job,
                                .plan = plan,
                                .sample = sample,
                                .style = style,
                                .wash_variants = wash_variants};
    declared.clear();
    frame::declare_frame(context);
    // `ahead` compiles the pipelines of the graph's passes in advance; it must be destroyed before the graph.
    std::unique_ptr<gpu::CompileAhead> compiling = std::move(ahead);
    if (compiling) {
        compiling->start(declared);
    }
    executor.run(declared);
    executor.replace_timings(); // the timings of the next sample replace these timings
    posed();
    loaded->terrain_moved = false;
    features.cloth.drawn();
    if (plan.lines.are_remembered && sample.is_first) {
        features.lines.history().end_frame(sample.clip_from_anchor);
    }
    features.shadows.sun().drawn(plan.sun.map);
    if (plan.sun.ground.is_thrown) {
        features.shadows.ground().drawn(plan.sun.ground, *loaded->terrain);
    }
    compiling.reset(); // another thread compiles and reads the graph, so it must end first
    std::swap(drawn, declared);
}

namespace {

/// Returns the size of the page without its margin, as shares of the page's width and height.
glm::dvec2 window_share(const paper::PaperStyle& style, const RenderSettings& settings)
{
    const float page_width_mm =
        style.height_mm * static_cast<float>(settings.width) / static_cast<float>(settings.height);
    const paper::Window window = paper::window_of(style, page_width_mm);
    return glm::dvec2(window.max_mm - window.min_mm) / glm::dvec2(page_width_mm, style.height_mm);
}

} // namespace

Camera page_camera(const Camera& camera, const paper::PaperStyle& style, const RenderSettings& settings)
{
    check_camera(camera);
    return features::seen_within(camera, window_share(style, settings));
}

Image Renderer::Impl::draw_picture(const Camera& camera, const Style& style, const RenderSettings& settings,
                                   frame::LinearPage* linear, const std::function<void()>& after_sample,
                                   const VulkanPicture* target)
{
    const JobLimits job_limits(settings.limits);
    frame::check_page_memory({settings.width, settings.height});
    const features::StyleTables& tables = tables_of(style);
    const Camera seen_by = page_camera(camera, tables.paper, settings);
    RenderSettings page_settings = settings;
    for (std::optional<Moment>* const moment : {&page_settings.motion_since, &page_settings.exposure_end}) {
        if (*moment) {
            (*moment)->camera = page_camera((*moment)->camera, tables.paper, settings);
        }
    }
    frame::FramePlan plan = prepare(seen_by, tables, page_settings);
    plan.ink = features.ink.ensure(device, executor, ink_inputs(seen_by, tables, settings), notes);
    plan.smoke = plan_smoke(plan, tables, settings);
    frame::ensure_page(device, buffers.page, plan.page_px, settings.samples);
    // Later samples of a picture differ from its first sample by a pixel at most. The lines of later samples
    // are not stored for the next frame of a film.
    plan.lines.are_remembered =
        is_of_film && features.lines.meshes().ensure(device, loaded->layout, plan.variants.lines) != nullptr;
    if (plan.lines.are_remembered) {
        features.lines.history().begin_frame(device, plan.page.size_px,
                                             settings.continuity == Continuity::follows,
                                             tables.contour.hidden.enabled);
    } else if (is_of_film) {
        features.lines.history().forget();
    }
    for (uint32_t sample = 0; sample < settings.samples; ++sample) {
        report_progress(static_cast<double>(sample) / settings.samples);
        draw_frame(seen_by, tables, plan,
                   {.accumulation = {.sample_index = sample, .sample_count = settings.samples},
                    .is_first = sample == 0,
                    .linear = linear,
                    .target = target});
        if (plan.ink && sample == 0) {
            features.ink.drawn(*plan.ink, seen_by);
        }
        if (after_sample) {
            after_sample();
        }
    }
    if (settings.motion_since) {
        motion = features::read_motion(buffers.motion_pixels, settings);
    }
    plan_lists = {std::move(plan.variants.styles), std::move(plan.strokes.kind_of_draw)};
    if (target != nullptr) {
        return {};
    }
    const auto bytes = buffers.page.pixels.mapped();
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
    const JobLimits job_limits(settings.limits);
    const features::StyleTables& tables = impl.tables_of(style);
    frame::check_page_memory({settings.width, settings.height});
    frame::check_size(impl.device, settings);
    const Camera seen_by = page_camera(camera, tables.paper, settings);
    frame::FramePlan plan = impl.prepare(seen_by, tables, settings);
    frame::check_has_paths(plan.variants);
    plan.motion.reset();
    if (tables.wash.strength > 0.0F || plan.page.has_sky || tables.bleed.enabled ||
        pigment::is_on(tables.pigment) || tables.ink.enabled || tables.smoke.enabled) {
        impl.notes.emplace_back("a drawing of strokes has neither wash nor sky, nor ink that runs, flows or "
                                "is rubbed, nor smoke");
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
                              .edges = impl.features.lines.meshes().edges(),
                              .size_px = plan.page.size_px},
                             plan, hidden == HiddenLines::kept);
}

// Functions that report on the last picture.

const Motion& Renderer::motion() const
{
    return impl_->motion;
}

const std::vector<std::string>& Renderer::notes() const
{
    return impl_->notes;
}

double Renderer::gpu_ms() const
{
    return impl_->executor.gpu_ms();
}

const std::vector<PassTiming>& Renderer::timings() const
{
    return impl_->executor.timings();
}

std::vector<SolverReport> Renderer::solver_reports() const
{
    std::vector<SolverReport> reports = impl_->features.smoke.solver_reports();
    if (const std::optional<SolverReport>& of_ink = impl_->features.ink.solver_report()) {
        reports.push_back(*of_ink);
    }
    return reports;
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
