// SPDX-License-Identifier: MIT
// From light to ink, colour and paper.
#include <algorithm>

#include "frame/page.hpp"
#include "frame/steps.hpp"
#include "gpu/resources.hpp"
#include "gpu/transfers.hpp"
#include "techniques/contour/chains/chains.hpp"

namespace estampe::frame {
namespace {

const std::vector<wash::LookWash>& wash_looks(const FrameContext& context)
{
    std::vector<wash::LookWash>& looks = context.lists.wash_looks;
    looks.clear();
    for (const features::StyleTables& style : context.plan.looks.styles) {
        looks.push_back({.style = style.wash, .tone = light::tone_constants(style.tone)});
    }
    return looks;
}

/// By what the strokes of surfaces find their size on the page.
gpu::ImageId stroke_footprint(const FrameContext& context, const surface::Surface& surface)
{
    const bool are_wider = context.plan.lens && context.style.lens.acts_on == lens::ActsOn::strokes &&
                           context.style.lens.mode != lens::Mode::circles;
    return are_wider ? lens::add_wider_strokes(context.graph, surface.depth, surface.footprint,
                                               context.sample.size_px, *context.plan.lens)
                     : surface.footprint;
}

gpu::ImageId motion_of(const FrameContext& context, const PosedScene& scene, gpu::BufferId visibility,
                       const features::MotionPlan& moved)
{
    // A scene that stands as it stood has one set of vertices.
    const bool has_moved = moved.pose_moved || context.loaded.terrain != nullptr;
    return motion::add_motion(
        context.graph,
        {.frame = scene.frame,
         .visibility = visibility,
         .triangles = scene.meshes.triangles,
         .posed_vertices = scene.meshes.posed_vertices,
         .posed_vertices_before = has_moved ? scene.vertices_before : scene.meshes.posed_vertices,
         .clip_from_anchor = moved.clip_from_anchor,
         .clip_from_anchor_before = moved.clip_from_anchor_before,
         .size_px = context.sample.size_px});
}

/// What blurs: the motion of the scene, or of the shape that the style's mode draws for its velocities alone.
gpu::ImageId blurring_motion_of(const FrameContext& context, const PosedScene& scene,
                                const MotionBlurPlan& plan, gpu::ImageId own_motion)
{
    const bool has_moved = plan.motion.pose_moved || context.loaded.terrain != nullptr;
    const std::optional<motion_blur::VelocityShape> shape = motion_blur::add_velocity_shape(
        context.graph, context.features.motion_blur.memory(),
        {.posed_vertices = scene.meshes.posed_vertices,
         .posed_vertices_before = has_moved ? scene.vertices_before : scene.meshes.posed_vertices,
         .now_from_before = glm::inverse(plan.motion.clip_from_anchor) * plan.motion.clip_from_anchor_before,
         .share = plan.constants.scale},
        context.style.motion_blur);
    if (!shape) {
        return own_motion;
    }
    PosedScene drawn_out = scene;
    drawn_out.meshes.posed_vertices = shape->vertices;
    drawn_out.vertices_before = shape->before;
    features::MotionPlan moved = plan.motion;
    moved.pose_moved = true;
    return motion_of(context, drawn_out, add_visibility(context, drawn_out, "motion blur/visibility"), moved);
}

/// Whether the pixels of 8 x 8 share what they find, as suits a GPU; where a tile of the page is drawn, only
/// if these are those of the page.
bool works_by_groups(const FrameContext& context)
{
    const glm::uvec2 beside_px = glm::uvec2(context.sample.from_px) % 8U;
    return context.device.execution().shares_by_groups() && beside_px == glm::uvec2(0);
}

} // namespace

std::optional<gpu::BufferId> look_of_draw(const FrameContext& context)
{
    if (!context.plan.looks.has_several()) {
        return std::nullopt;
    }
    return gpu::import_whole(context.graph, "looks", context.buffers.look_of_draw);
}

const std::vector<hatch::LookHatch>& hatch_looks(const FrameContext& context)
{
    std::vector<hatch::LookHatch>& looks = context.lists.hatch_looks;
    looks.clear();
    for (const features::StyleTables& style : context.plan.looks.styles) {
        hatch::MapImages* const map = context.features.hatching.maps().of_look(looks.size());
        looks.push_back(
            {.style = style.hatch,
             .tone = light::tone_constants(style.tone),
             .map = map != nullptr ? std::optional(hatch::import_map(context.graph, *map)) : std::nullopt});
    }
    return looks;
}

hatch::HatchInputs hatch_inputs(const FrameContext& context, const PosedScene& scene,
                                const surface::Surface& surface, const light::LitPixels& lit,
                                const SeenThrough& screen)
{
    const FramePlan& plan = context.plan;
    return {.frame = scene.frame,
            .draw = surface.draw,
            .depth = surface.depth,
            .normal = surface.normal,
            .color = surface.color,
            .coordinate = surface.coordinate,
            .footprint = stroke_footprint(context, surface),
            .light = lit.light,
            .screen = screen.images.color,
            .has_screen = screen.is_there,
            .tone = {},
            .strokes_present = plan.strokes.present,
            .strongest_light = plan.light.leads_strokes ? std::optional(lit.strongest) : std::nullopt,
            .towards_light = plan.sun.towards,
            .ground_wind = plan.strokes.ground_wind,
            .pixels_per_mm = plan.page.pixels_per_mm,
            .size_px = context.sample.size_px,
            .look_of_draw = look_of_draw(context),
            .draws = scene.meshes.draws};
}

std::optional<contour::CrestMesh> crests_of(const FrameContext& context)
{
    if (!context.loaded.terrain || !context.loaded.layout.foreign_vertex) {
        return std::nullopt;
    }
    return contour::CrestMesh{.first_vertex = *context.loaded.layout.foreign_vertex,
                              .vertex_count = context.loaded.meshes.vertex_count,
                              .along = context.plan.strokes.ground_wind};
}

contour::ContourInputs contour_inputs(const FrameContext& context, const PosedScene& scene,
                                      gpu::BufferId visibility, const surface::Surface& surface,
                                      const light::LitPixels& lit, const SeenThrough& screen)
{
    const FramePlan& plan = context.plan;
    const bool has_chains = context.features.lines.mesh() != nullptr;
    const bool is_moving =
        context.sample.pose_moved ||
        context.features.lines.history().clip_from_anchor_before() != context.sample.clip_from_anchor;
    return {.frame = scene.frame,
            .visibility = visibility,
            .triangles = scene.meshes.triangles,
            .posed_vertices = scene.meshes.posed_vertices,
            .draws = scene.meshes.draws,
            .materials = scene.meshes.materials,
            .crests = crests_of(context),
            .own_outlines = plan.needs.own_outlines,
            .draw = surface.draw,
            .depth = surface.depth,
            .normal = surface.normal,
            .coordinate = surface.coordinate,
            .light = lit.light,
            .sun = plan.lines.of_shadows ? std::optional(lit.sun) : std::nullopt,
            .screen_draw = screen.images.draw,
            .has_screen = screen.is_there && !has_chains,
            .only_cut = has_chains,
            .execution = context.device.execution(),
            .is_moving = is_moving,
            .brushes = context.features.lines.brushes(),
            .pixels_per_mm = plan.page.pixels_per_mm,
            .line_step_px = context.sample.line_step_px,
            .pixel_m_at_one = plan.page.pixel.at_one_m,
            .size_px = context.sample.size_px,
            .look_of_draw = look_of_draw(context),
            .line_looks = plan.looks.has_several()
                              ? std::optional(gpu::import_whole(context.graph, "line looks",
                                                                context.features.lines.looks()))
                              : std::nullopt,
            .line_hiders = screen.line_hiders};
}

gpu::ImageId add_lines(const FrameContext& context, const contour::ContourInputs& in)
{
    if (context.features.lines.mesh() == nullptr) {
        return contour::add_contours(context.graph, in, context.plan.looks.lines);
    }
    const std::optional<gpu::ImageId> of_cuts =
        context.loaded.layout.masked.count > 0
            ? std::optional(contour::add_contours(context.graph, in, context.plan.looks.lines))
            : std::nullopt;
    if (context.job.linked) {
        return contour::add_linked_contours(context.graph, in, context.job.linked->lines,
                                            context.job.linked->part, context.plan.looks.lines, of_cuts);
    }
    const bool remembers = context.plan.lines.are_remembered && context.sample.is_first;
    return contour::add_chain_contours(context.graph, in, *context.features.lines.mesh(),
                                       remembers ? &context.features.lines.history() : nullptr,
                                       context.plan.looks.lines, of_cuts);
}

void add_linked_lines(const FrameContext& context, const contour::ContourInputs& in)
{
    if (context.features.lines.mesh() != nullptr) {
        const contour::ShapedStrokes shaped = contour::add_shaped_strokes(
            context.graph, in, *context.features.lines.mesh(), nullptr, context.plan.looks.lines);
        contour::add_keeping(context.graph, context.device, shaped, context.sample.size_px,
                             *context.job.linked_out);
    }
}

gpu::ImageId add_drift(const FrameContext& context, const PosedScene& scene, const surface::Surface& surface,
                       gpu::ImageId lines)
{
    const std::optional<terrain::DriftPlan>& plan = context.plan.drift;
    if (!plan) {
        return lines;
    }
    const gpu::ImageId heights = context.loaded.terrain->add_heights(
        context.graph, {plan->field}, glm::uvec2(plan->streaks.side), *scene.terrain_texels);
    return terrain::add_drift(
        context.graph,
        {.frame = scene.frame, .heights = heights, .depth = surface.depth, .size_px = context.sample.size_px},
        plan->streaks, context.style.drift.ink, lines);
}

haze::HazeLayers add_particles(const FrameContext& context, const PosedScene& scene,
                               const surface::Surface& surface, gpu::ImageId sky_wash,
                               const haze::HazeLayers& layers)
{
    particles::ParticleLayers drawn{.wash = layers.wash, .hatch = layers.hatch, .lines = layers.lines};
    const auto import = [&](const char* name, gpu::Buffer& buffer) {
        return gpu::import_whole(context.graph, name, buffer);
    };
    for (size_t i = 0; i < context.plan.particles.size(); ++i) {
        features::ParticleBuffers& buffers = context.features.particles.buffers()[i];
        shared::ParticleConstants constants = context.plan.particles[i].constants;
        if (context.plan.page.has_haze) {
            constants.haze_start_m = context.style.haze.start_m;
            constants.haze_halves_per_m = 1.0F / context.style.haze.reach_m;
            constants.haze_ink = context.style.haze.ink;
        }
        drawn = particles::add_particles(context.graph,
                                         {.frame = scene.frame,
                                          .sprites = import("sprites", buffers.sprites),
                                          .starts = import("sprite tiles", buffers.starts),
                                          .listed = import("listed sprites", buffers.listed),
                                          .sheet = import("particle sheet", buffers.sheet.texels()),
                                          .depth = surface.depth,
                                          .sky = sky_wash,
                                          .size_px = context.sample.size_px,
                                          .by_groups = works_by_groups(context)},
                                         constants, drawn);
    }
    return {.wash = drawn.wash, .hatch = drawn.hatch, .lines = drawn.lines};
}

lens::LensLayers add_lens(const FrameContext& context, const surface::Surface& surface,
                          const haze::HazeLayers& layers, const Colors& colors)
{
    if (!context.plan.lens) {
        return {.wash = layers.wash, .hatch = layers.hatch, .lines = layers.lines, .holds_sky = false};
    }
    return lens::add_lens(context.graph,
                          {.depth = surface.depth,
                           .wash = layers.wash,
                           .hatch = layers.hatch,
                           .lines = layers.lines,
                           .sky_ink = colors.sky_ink,
                           .has_sky = colors.has_sky_ink,
                           .from_px = glm::uvec2(context.sample.from_px),
                           .size_px = context.sample.size_px},
                          context.style.lens, *context.plan.lens);
}

motion_blur::MotionBlurLayers add_motion_blur(const FrameContext& context, const PosedScene& scene,
                                              gpu::BufferId visibility, const surface::Surface& surface,
                                              const haze::HazeLayers& layers, const Colors& colors)
{
    const std::optional<MotionBlurPlan>& plan = context.plan.motion_blur;
    if (!plan) {
        return {.wash = layers.wash, .hatch = layers.hatch, .lines = layers.lines, .holds_sky = false};
    }
    const gpu::ImageId own_motion = motion_of(context, scene, visibility, plan->motion);
    const bool has_moved = plan->motion.pose_moved || context.loaded.terrain != nullptr;
    // Shifted within a pixel as the sample is, so that a way is that of the body alone.
    const glm::mat4 shifted_before(glm::dmat4(context.sample.clip_from_anchor) *
                                   glm::inverse(glm::dmat4(plan->motion.clip_from_anchor)) *
                                   glm::dmat4(plan->motion.clip_from_anchor_before));
    const motion_blur::SmearScene smear{.frame = scene.frame,
                                        .triangles = scene.meshes.triangles,
                                        .posed_vertices = scene.meshes.posed_vertices,
                                        .posed_vertices_before =
                                            has_moved ? scene.vertices_before : scene.meshes.posed_vertices,
                                        .clip_from_anchor_before = shifted_before,
                                        .seeds = &context.features.motion_blur.smear_seeds()};
    const SeenWindow window = seen_window(context.style.paper, context.plan.page_px,
                                          context.plan.page.pixels_per_mm, context.sample.from_px);
    return motion_blur::add_motion_blur(
        context.graph,
        {.motion = blurring_motion_of(context, scene, *plan, own_motion),
         .own_motion = own_motion,
         .depth = surface.depth,
         .wash = layers.wash,
         .hatch = layers.hatch,
         .lines = layers.lines,
         .sky_ink = colors.sky_ink,
         .has_sky = colors.has_sky_ink,
         .size_px = context.sample.size_px,
         .window_min_px = window.min_px,
         .window_max_px = window.max_px,
         .smear = context.style.motion_blur.smear ? std::optional(smear) : std::nullopt,
         .by_groups = context.device.execution().shares_by_groups()},
        context.style.motion_blur, plan->constants, plan->smear);
}

gpu::ImageId add_focus_lines(const FrameContext& context, gpu::ImageId lines)
{
    const FocusPlan& plan = context.plan.focus;
    if (plan.lines.empty()) {
        return lines;
    }
    return focus::add_focus(
        context.graph,
        {.lines = gpu::import_whole(context.graph, "focus lines", context.features.lines.focus_lines()),
         .line_count = static_cast<uint32_t>(plan.lines.size()),
         .middle_px = plan.middle_px - context.sample.from_px,
         .size_px = context.sample.size_px},
        context.style.focus, lines);
}

namespace {

/// From the eye: what is nearer hides the sky, what is farther may be hazy.
float sky_shows_from_m(const FrameContext& context)
{
    constexpr float nowhere_m = 1e30F;
    return context.plan.page.has_haze ? context.style.haze.start_m : nowhere_m;
}

} // namespace

std::optional<gpu::BufferId> add_far_tiles(const FrameContext& context, const PosedScene& scene,
                                           const surface::Surface& surface)
{
    const PagePlan& page = context.plan.page;
    if (!context.device.execution().lists_tiles() || (!page.has_haze && !context.plan.clouds)) {
        return std::nullopt;
    }
    return surface::add_far_tiles(
        context.graph, {.frame = scene.frame, .depth = surface.depth, .size_px = context.sample.size_px},
        sky_shows_from_m(context));
}

Colors add_colors(const FrameContext& context, const PosedScene& scene, const surface::Surface& surface,
                  gpu::ImageId light, const SeenThrough& screen,
                  const std::optional<gpu::BufferId>& far_tiles)
{
    const FramePlan& plan = context.plan;
    const bool has_layers = context.job.linear != nullptr && context.job.linear->has_layers();
    const bool is_clear = plan.subsurface && !plan.subsurface->clear.empty();
    const bool shows_elsewhere = screen.is_there || is_clear || has_layers;
    const std::optional<gpu::BufferId> tiles = shows_elsewhere ? std::nullopt : far_tiles;
    const std::optional<float> far_m =
        shows_elsewhere ? std::nullopt : std::optional(sky_shows_from_m(context));
    sky::Sky sky = sky::add_sky(context.graph,
                                {.frame = scene.frame,
                                 .depth = surface.depth,
                                 .towards_sun = plan.sun.towards,
                                 .daylight_rad = plan.sun.daylight_rad,
                                 .pixels_per_mm = plan.page.pixels_per_mm,
                                 .drawn = plan.page.has_sky,
                                 .size_px = context.sample.size_px,
                                 .tiles = tiles,
                                 .far_m = far_m},
                                context.style.sky);
    std::optional<gpu::ImageId> cover;
    if (plan.clouds) {
        features::Clouds& clouds = context.features.clouds;
        const auto import = [&](const char* name, gpu::Buffer& buffer) {
            return gpu::import_whole(context.graph, name, buffer);
        };
        const sky::CloudedSky clouded = sky::add_clouds(context.graph,
                                                        {.frame = scene.frame,
                                                         .globals = import("clouds", clouds.globals()),
                                                         .starts = import("cloud cells", clouds.starts()),
                                                         .puffs = import("puffs", clouds.puffs()),
                                                         .streaks = import("streaks", clouds.streaks()),
                                                         .depth = surface.depth,
                                                         .variant = plan.clouds->variant,
                                                         .keeps_cover = has_layers,
                                                         .size_px = context.sample.size_px,
                                                         .tiles = tiles,
                                                         .far_m = far_m,
                                                         .by_groups = works_by_groups(context)},
                                                        sky);
        sky = clouded.sky;
        cover = has_layers ? std::optional(clouded.cover) : std::nullopt;
    }
    const bool is_tinted = screen.is_there && context.style.transparency.mode == transparency::Mode::ink;
    const gpu::ImageId wash = add_paint(context, scene, surface, light,
                                        plan.page.shows_sky ? std::optional(sky.wash) : std::nullopt,
                                        is_tinted ? &screen : nullptr);
    return {.wash = wash,
            .sky_ink = sky.ink,
            .sky_wash = sky.wash,
            .has_sky_ink = plan.page.shows_sky,
            .cloud_cover = cover};
}

gpu::ImageId add_paint(const FrameContext& context, const PosedScene& scene, const surface::Surface& surface,
                       gpu::ImageId light, const std::optional<gpu::ImageId>& background,
                       const SeenThrough* screen)
{
    return wash::add_wash(context.graph,
                          {.frame = scene.frame,
                           .draw = surface.draw,
                           .depth = surface.depth,
                           .color = surface.color,
                           .light = light,
                           .draws = scene.meshes.draws,
                           .materials = scene.meshes.materials,
                           .screen = screen != nullptr ? screen->images.color : surface.color,
                           .has_screen = screen != nullptr,
                           .background = background.value_or(surface.color),
                           .has_background = background.has_value(),
                           .keeps_cover = context.style.paper.transparent == paper::Transparency::background,
                           .size_px = context.sample.size_px,
                           .look_of_draw = look_of_draw(context)},
                          wash_looks(context));
}

haze::HazeInputs haze_inputs(const FrameContext& context, const PosedScene& scene,
                             const surface::Surface& surface)
{
    return {.frame = scene.frame,
            .depth = surface.depth,
            .line_half_px = context.plan.lines.half_px,
            .size_px = context.sample.size_px};
}

std::optional<StrokeHaze> stroke_haze(const FrameContext& context, const PosedScene& scene,
                                      const surface::Surface& surface)
{
    if (!context.plan.page.has_haze) {
        return std::nullopt;
    }
    return StrokeHaze{.inputs = haze_inputs(context, scene, surface), .style = context.style.haze};
}

haze::HazeLayers add_haze(const FrameContext& context, const PosedScene& scene,
                          const surface::Surface& surface, gpu::ImageId sky_wash,
                          const std::optional<gpu::BufferId>& far_tiles, const haze::HazeLayers& layers)
{
    if (!context.plan.page.has_haze) {
        return layers;
    }
    haze::HazeInputs inputs = haze_inputs(context, scene, surface);
    inputs.tiles = far_tiles;
    return haze::add_haze(context.graph, inputs, context.style.haze, sky_wash, layers);
}

std::optional<gpu::ImageId> add_flowing_ink(const FrameContext& context, const PosedScene& scene,
                                            gpu::BufferId visibility, const surface::Surface& surface,
                                            gpu::ImageId light, const haze::HazeLayers& layers)
{
    if (!context.plan.ink) {
        return std::nullopt;
    }
    const features::InkPlan& plan = *context.plan.ink;
    gpu::Graph& graph = context.graph;
    ink::Memory& memory = context.features.ink.memory();
    const auto add_flow = [&] {
        return ink::add_steps(
            graph, memory, plan.ink,
            {.frame = scene.frame,
             .hatch = layers.hatch,
             .lines = layers.lines,
             .light = light,
             .draw = surface.draw,
             .depth = surface.depth,
             .coordinate = surface.coordinate,
             .footprint = surface.footprint,
             .motion = plan.motion ? std::optional(motion_of(context, scene, visibility, *plan.motion))
                                   : std::nullopt});
    };
    const ink::Flowing flowing =
        context.sample.is_first ? add_flow() : ink::add_standing(graph, memory, plan.ink);
    return ink::add_layer(graph, flowing, scene.frame, context.sample.size_px);
}

std::optional<smoke::Layer> add_smoke(const FrameContext& context, const PosedScene& scene,
                                      const surface::Surface& surface,
                                      const std::optional<smoke::Volume>& volume, gpu::ImageId sky_wash,
                                      gpu::ImageId lines)
{
    if (!volume) {
        return std::nullopt;
    }
    gpu::Graph& graph = context.graph;
    const smoke::ViewInputs view{.frame = scene.frame,
                                 .globals =
                                     gpu::import_whole(graph, "smoke", context.features.smoke.globals()),
                                 .depth = surface.depth,
                                 .size_px = context.sample.size_px};
    const smoke::SmokeStyle& style = context.style.smoke;
    const haze::HazeStyle& haze = context.style.haze;
    return smoke::add_ink(
        graph, style,
        {.view = view,
         .marched = smoke::add_march(graph, *volume, style, view),
         .lines = lines,
         .scene_line_px = context.plan.lines.half_px,
         .pixels_per_mm = context.plan.page.pixels_per_mm,
         .haze =
             context.plan.page.has_haze
                 ? std::optional(smoke::Haze{
                       .sky = sky_wash, .start_m = haze.start_m, .reach_m = haze.reach_m, .ink = haze.ink})
                 : std::nullopt});
}

paper::ComposeInputs page_layers(const FrameContext& context, const PosedScene& scene,
                                 const haze::HazeLayers& layers, const Colors& colors,
                                 const MovingLayers& moving, const std::optional<gpu::ImageId>& cover,
                                 gpu::ImageId light)
{
    return {.frame = scene.frame,
            .wash = layers.wash,
            .hatch = layers.hatch,
            .lines = layers.lines,
            .sky_ink = colors.sky_ink,
            .ink = moving.ink,
            .ink_settles = context.style.ink.granulation,
            .smoke_paint = moving.smoke ? std::optional(moving.smoke->paint) : std::nullopt,
            .smoke_ink = moving.smoke ? std::optional(moving.smoke->ink) : std::nullopt,
            .has_sky = colors.has_sky_ink,
            .cover = cover,
            .light = light,
            .page_px = context.plan.page_px,
            .size_px = context.sample.size_px};
}

namespace {

/// The pixels of the last sample; those before it end in their sums, and nobody sees pixels yet.
gpu::BufferId add_sample(const FrameContext& context, const paper::ComposeInputs& layers,
                         gpu::BufferId pixels)
{
    gpu::Graph& graph = context.graph;
    const paper::Accumulation& accumulation = context.sample.accumulation;
    if (accumulation.sample_count == 1) {
        return paper::add_pixels(graph, layers, context.style.paper, pixels);
    }
    const gpu::ImageId composed = paper::add_compose(graph, layers, context.style.paper);
    return paper::add_develop(graph, composed,
                              paper::import_sums(graph, context.buffers.page.sums, accumulation), pixels,
                              context.sample.size_px, accumulation, paper::PixelForm::srgb_bytes,
                              paper::transparent_color(context.style.paper))
        .pixels;
}

} // namespace

void add_picture(const FrameContext& context, const paper::ComposeInputs& layers)
{
    gpu::Graph& graph = context.graph;
    const glm::uvec2 size_px = context.sample.size_px;
    const VulkanPicture* target = context.job.target;
    const bool is_last = context.sample.accumulation.is_last();
    const gpu::BufferId pixels = add_sample(
        context, layers,
        target == nullptr && is_last ? gpu::import_whole(graph, "pixels", context.buffers.page.pixels)
                                     : graph.buffer("pixels", {.size_bytes = 4ULL * size_px.x * size_px.y}));
    if (is_last && target != nullptr) {
        gpu::add_hand_over(graph, pixels, *target, size_px);
    } else if (is_last) {
        gpu::add_host_read(graph, "read back", pixels);
    }
}

void add_linear_picture(const FrameContext& context, const paper::ComposeInputs& layers,
                        const surface::Surface& surface, const light::LitPixels& lit, const MaskInputs& masks)
{
    if (context.job.linear != nullptr) {
        declare_linear_page(context.graph,
                            {.layers = layers,
                             .draw = surface.draw,
                             .sun = lit.sun,
                             .occlusion = masks.occlusion,
                             .cloud_cover = masks.cloud_cover},
                            context.style.paper, context.sample.accumulation, *context.job.linear);
    }
}

} // namespace estampe::frame
