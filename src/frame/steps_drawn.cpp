// SPDX-License-Identifier: MIT
// From light to ink, colour and paper.
#include <algorithm>

#include "frame/page.hpp"
#include "frame/steps.hpp"
#include "gpu/imports.hpp"
#include "gpu/read_back.hpp"
#include "techniques/contour/chains/chains.hpp"
#include "techniques/motion_blur/stretch.hpp"

namespace estampe::frame {
namespace {

const std::vector<wash::LookWash>& wash_looks(const Making& making)
{
    std::vector<wash::LookWash>& looks = making.resources.frame_lists.wash_looks;
    looks.clear();
    for (const StyleTables& style : making.plan.looks.styles) {
        looks.push_back({.style = style.wash, .tone = light::tone_constants(style.tone)});
    }
    return looks;
}

/// By what the strokes of surfaces find their size on the page.
gpu::ImageId stroke_footprint(const Making& making, const surface::Surface& surface)
{
    const bool are_wider = making.plan.lens && making.style.lens.acts_on == lens::ActsOn::strokes &&
                           making.style.lens.mode != lens::Mode::circles;
    return are_wider ? lens::add_wider_strokes(making.graph, surface.depth, surface.footprint,
                                               making.sample.size_px, *making.plan.lens)
                     : surface.footprint;
}

gpu::ImageId motion_of(const Making& making, const PosedScene& scene, gpu::BufferId visibility,
                       const MotionPlan& moved)
{
    // A scene that stands as it stood has one set of vertices.
    const bool has_moved = moved.pose_moved || making.resources.terrain != nullptr;
    return motion::add_motion(making.graph, {.frame = scene.frame,
                                             .visibility = visibility,
                                             .triangles = scene.meshes.triangles,
                                             .posed_vertices = scene.meshes.posed_vertices,
                                             .posed_vertices_before = has_moved ? scene.vertices_before
                                                                                : scene.meshes.posed_vertices,
                                             .clip_from_anchor = moved.clip_from_anchor,
                                             .clip_from_anchor_before = moved.clip_from_anchor_before,
                                             .size_px = making.sample.size_px});
}

/// The same of all that is drawn out along its way.
gpu::ImageId stretched_motion_of(const Making& making, const PosedScene& scene, const MotionBlurPlan& plan)
{
    const bool has_moved = plan.motion.pose_moved || making.resources.terrain != nullptr;
    const motion_blur::Stretched stretched = motion_blur::add_stretch(
        making.graph, making.resources.together,
        {.posed_vertices = scene.meshes.posed_vertices,
         .posed_vertices_before = has_moved ? scene.vertices_before : scene.meshes.posed_vertices,
         .constants = {.now_from_before =
                           glm::inverse(plan.motion.clip_from_anchor) * plan.motion.clip_from_anchor_before,
                       .share = plan.constants.scale,
                       .vertex_count = 0}});
    PosedScene drawn_out = scene;
    drawn_out.meshes.posed_vertices = stretched.vertices;
    drawn_out.vertices_before = stretched.before;
    MotionPlan moved = plan.motion;
    moved.pose_moved = true;
    return motion_of(making, drawn_out, add_visibility(making, drawn_out, "motion blur/visibility"), moved);
}

/// Whether the pixels of 8 x 8 share what they find, as suits a GPU; where a tile of the page is drawn, only
/// if these are those of the page.
bool works_by_groups(const Making& making)
{
    const glm::uvec2 beside_px = glm::uvec2(making.sample.from_px) % 8U;
    return !making.plan.raster.on_processor && beside_px == glm::uvec2(0);
}

} // namespace

std::optional<gpu::BufferId> look_of_draw(const Making& making)
{
    if (!making.plan.looks.has_several()) {
        return std::nullopt;
    }
    return gpu::import_whole(making.graph, "looks", making.resources.look_of_draw);
}

const std::vector<hatch::LookHatch>& hatch_looks(const Making& making)
{
    std::vector<hatch::LookHatch>& looks = making.resources.frame_lists.hatch_looks;
    looks.clear();
    for (const StyleTables& style : making.plan.looks.styles) {
        hatch::MapImages* const map = making.resources.maps.of_look(looks.size());
        looks.push_back(
            {.style = style.hatch,
             .tone = light::tone_constants(style.tone),
             .map = map != nullptr ? std::optional(hatch::import_map(making.graph, *map)) : std::nullopt});
    }
    return looks;
}

hatch::HatchInputs hatch_inputs(const Making& making, const PosedScene& scene,
                                const surface::Surface& surface, const light::LitPixels& lit,
                                const SeenThrough& screen)
{
    const FramePlan& plan = making.plan;
    return {.frame = scene.frame,
            .draw = surface.draw,
            .depth = surface.depth,
            .normal = surface.normal,
            .color = surface.color,
            .coordinate = surface.coordinate,
            .footprint = stroke_footprint(making, surface),
            .light = lit.light,
            .screen = screen.images.color,
            .has_screen = screen.is_there,
            .tone = {},
            .strokes_present = plan.strokes.present,
            .strongest_light = plan.light.leads_strokes ? std::optional(lit.strongest) : std::nullopt,
            .towards_light = plan.sun.towards,
            .ground_wind = plan.strokes.ground_wind,
            .pixels_per_mm = plan.page.pixels_per_mm,
            .size_px = making.sample.size_px,
            .look_of_draw = look_of_draw(making),
            .draws = scene.meshes.draws};
}

std::optional<contour::CrestMesh> crests_of(const Making& making)
{
    if (making.resources.terrain == nullptr || !making.layout.foreign_vertex) {
        return std::nullopt;
    }
    return contour::CrestMesh{.first_vertex = *making.layout.foreign_vertex,
                              .vertex_count = making.resources.meshes.vertex_count,
                              .along = making.plan.strokes.ground_wind};
}

contour::ContourInputs contour_inputs(const Making& making, const PosedScene& scene, gpu::BufferId visibility,
                                      const surface::Surface& surface, const light::LitPixels& lit,
                                      const SeenThrough& screen)
{
    const FramePlan& plan = making.plan;
    const FrameResources& resources = making.resources;
    const bool has_chains = resources.line_mesh != nullptr;
    const bool is_moving = making.sample.pose_moved ||
                           resources.line_history.clip_from_anchor_before() != making.sample.clip_from_anchor;
    return {.frame = scene.frame,
            .visibility = visibility,
            .triangles = scene.meshes.triangles,
            .posed_vertices = scene.meshes.posed_vertices,
            .draws = scene.meshes.draws,
            .materials = scene.meshes.materials,
            .crests = crests_of(making),
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
            .on_processor = plan.raster.on_processor,
            .is_moving = is_moving,
            .brushes = resources.brushes,
            .pixels_per_mm = plan.page.pixels_per_mm,
            .line_step_px = making.sample.line_step_px,
            .pixel_m_at_one = plan.page.pixel.at_one_m,
            .size_px = making.sample.size_px,
            .look_of_draw = look_of_draw(making),
            .line_looks = plan.looks.has_several()
                              ? std::optional(gpu::import_whole(making.graph, "line looks",
                                                                making.resources.line_looks))
                              : std::nullopt,
            .line_hiders = screen.line_hiders};
}

gpu::ImageId add_lines(const Making& making, const contour::ContourInputs& in)
{
    FrameResources& resources = making.resources;
    if (resources.line_mesh == nullptr) {
        return contour::add_contours(making.graph, in, making.plan.looks.lines);
    }
    const std::optional<gpu::ImageId> of_cuts =
        making.layout.masked.count > 0
            ? std::optional(contour::add_contours(making.graph, in, making.plan.looks.lines))
            : std::nullopt;
    if (resources.strung) {
        return contour::add_strung_contours(making.graph, in, resources.strung->lines, resources.strung->part,
                                            making.plan.looks.lines, of_cuts);
    }
    const bool remembers = making.plan.lines.are_remembered && making.sample.is_first;
    return contour::add_chain_contours(making.graph, in, *resources.line_mesh,
                                       remembers ? &resources.line_history : nullptr, making.plan.looks.lines,
                                       of_cuts);
}

void add_strung_lines(const Making& making, const contour::ContourInputs& in)
{
    FrameResources& resources = making.resources;
    if (resources.line_mesh != nullptr) {
        const contour::ShapedStrokes shaped = contour::add_shaped_strokes(
            making.graph, in, *resources.line_mesh, nullptr, making.plan.looks.lines);
        contour::add_keeping(making.graph, resources.device, shaped, making.sample.size_px,
                             *resources.strung_into);
    }
}

gpu::ImageId add_drift(const Making& making, const PosedScene& scene, const surface::Surface& surface,
                       gpu::ImageId lines)
{
    const std::optional<terrain::DriftPlan>& plan = making.plan.drift;
    if (!plan) {
        return lines;
    }
    const gpu::ImageId heights = making.resources.terrain->add_heights(
        making.graph, {plan->field}, glm::uvec2(plan->streaks.side), *scene.terrain_texels);
    return terrain::add_drift(
        making.graph,
        {.frame = scene.frame, .heights = heights, .depth = surface.depth, .size_px = making.sample.size_px},
        plan->streaks, making.style.drift.ink, lines);
}

haze::HazeLayers add_particles(const Making& making, const PosedScene& scene, const surface::Surface& surface,
                               gpu::ImageId sky_wash, const haze::HazeLayers& layers)
{
    particles::ParticleLayers drawn{.wash = layers.wash, .hatch = layers.hatch, .lines = layers.lines};
    const auto import = [&](const char* name, gpu::Buffer& buffer) {
        return gpu::import_whole(making.graph, name, buffer);
    };
    for (size_t i = 0; i < making.plan.particles.size(); ++i) {
        ParticleBuffers& buffers = making.resources.particles[i];
        shared::ParticleConstants constants = making.plan.particles[i].constants;
        if (making.plan.page.has_haze) {
            constants.haze_start_m = making.style.haze.start_m;
            constants.haze_halves_per_m = 1.0F / making.style.haze.reach_m;
            constants.haze_ink = making.style.haze.ink;
        }
        drawn = particles::add_particles(making.graph,
                                         {.frame = scene.frame,
                                          .sprites = import("sprites", buffers.sprites),
                                          .starts = import("sprite tiles", buffers.starts),
                                          .listed = import("listed sprites", buffers.listed),
                                          .sheet = import("particle sheet", buffers.sheet.texels()),
                                          .depth = surface.depth,
                                          .sky = sky_wash,
                                          .size_px = making.sample.size_px,
                                          .by_groups = works_by_groups(making)},
                                         constants, drawn);
    }
    return {.wash = drawn.wash, .hatch = drawn.hatch, .lines = drawn.lines};
}

lens::LensLayers add_lens(const Making& making, const surface::Surface& surface,
                          const haze::HazeLayers& layers, const Colors& colors)
{
    if (!making.plan.lens) {
        return {.wash = layers.wash, .hatch = layers.hatch, .lines = layers.lines, .holds_sky = false};
    }
    return lens::add_lens(making.graph,
                          {.depth = surface.depth,
                           .wash = layers.wash,
                           .hatch = layers.hatch,
                           .lines = layers.lines,
                           .sky_ink = colors.sky_ink,
                           .has_sky = colors.has_sky_ink,
                           .from_px = glm::uvec2(making.sample.from_px),
                           .size_px = making.sample.size_px},
                          making.style.lens, *making.plan.lens);
}

motion_blur::MotionBlurLayers add_motion_blur(const Making& making, const PosedScene& scene,
                                              gpu::BufferId visibility, const surface::Surface& surface,
                                              const haze::HazeLayers& layers, const Colors& colors)
{
    const std::optional<MotionBlurPlan>& plan = making.plan.motion_blur;
    if (!plan) {
        return {.wash = layers.wash, .hatch = layers.hatch, .lines = layers.lines, .holds_sky = false};
    }
    const bool is_stretched = making.style.motion_blur.mode == motion_blur::Mode::stretched;
    const gpu::ImageId own_motion = motion_of(making, scene, visibility, plan->motion);
    const bool has_moved = plan->motion.pose_moved || making.resources.terrain != nullptr;
    // Shifted within a pixel as the sample is, so that a way is that of the body alone.
    const glm::mat4 shifted_before(glm::dmat4(making.sample.clip_from_anchor) *
                                   glm::inverse(glm::dmat4(plan->motion.clip_from_anchor)) *
                                   glm::dmat4(plan->motion.clip_from_anchor_before));
    const motion_blur::SmearScene smear{.frame = scene.frame,
                                        .triangles = scene.meshes.triangles,
                                        .posed_vertices = scene.meshes.posed_vertices,
                                        .posed_vertices_before =
                                            has_moved ? scene.vertices_before : scene.meshes.posed_vertices,
                                        .clip_from_anchor_before = shifted_before,
                                        .seeds = &making.resources.smear_seeds};
    const SeenWindow window = seen_window(making.style.paper, making.plan.page_px,
                                          making.plan.page.pixels_per_mm, making.sample.from_px);
    return motion_blur::add_motion_blur(
        making.graph,
        {.motion = is_stretched ? stretched_motion_of(making, scene, *plan) : own_motion,
         .own_motion = own_motion,
         .depth = surface.depth,
         .wash = layers.wash,
         .hatch = layers.hatch,
         .lines = layers.lines,
         .sky_ink = colors.sky_ink,
         .has_sky = colors.has_sky_ink,
         .size_px = making.sample.size_px,
         .window_min_px = window.min_px,
         .window_max_px = window.max_px,
         .smear = making.style.motion_blur.smear ? std::optional(smear) : std::nullopt,
         .by_groups = !making.plan.raster.on_processor},
        making.style.motion_blur, plan->constants, plan->smear);
}

gpu::ImageId add_focus_lines(const Making& making, gpu::ImageId lines)
{
    const FocusPlan& plan = making.plan.focus;
    if (plan.lines.empty()) {
        return lines;
    }
    return focus::add_focus(
        making.graph,
        {.lines = gpu::import_whole(making.graph, "focus lines", making.resources.focus_lines),
         .line_count = static_cast<uint32_t>(plan.lines.size()),
         .middle_px = plan.middle_px - making.sample.from_px,
         .size_px = making.sample.size_px},
        making.style.focus, lines);
}

namespace {

/// From the eye: what is nearer hides the sky, what is farther may be hazy.
float sky_shows_from_m(const Making& making)
{
    constexpr float nowhere_m = 1e30F;
    return making.plan.page.has_haze ? making.style.haze.start_m : nowhere_m;
}

} // namespace

std::optional<gpu::BufferId> add_far_tiles(const Making& making, const PosedScene& scene,
                                           const surface::Surface& surface)
{
    const PagePlan& page = making.plan.page;
    if (!making.plan.raster.on_processor || (!page.has_haze && !making.plan.clouds)) {
        return std::nullopt;
    }
    return surface::add_far_tiles(
        making.graph, {.frame = scene.frame, .depth = surface.depth, .size_px = making.sample.size_px},
        sky_shows_from_m(making));
}

Colors add_colors(const Making& making, const PosedScene& scene, const surface::Surface& surface,
                  gpu::ImageId light, const SeenThrough& screen,
                  const std::optional<gpu::BufferId>& far_tiles)
{
    const FramePlan& plan = making.plan;
    const bool has_layers = making.resources.deep != nullptr && making.resources.deep->has_layers();
    const bool is_clear = plan.subsurface && !plan.subsurface->clear.empty();
    const bool shows_elsewhere = screen.is_there || is_clear || has_layers;
    const std::optional<gpu::BufferId> tiles = shows_elsewhere ? std::nullopt : far_tiles;
    const std::optional<float> far_m =
        shows_elsewhere ? std::nullopt : std::optional(sky_shows_from_m(making));
    sky::Sky sky = sky::add_sky(making.graph,
                                {.frame = scene.frame,
                                 .depth = surface.depth,
                                 .towards_sun = plan.sun.towards,
                                 .daylight_rad = plan.sun.daylight_rad,
                                 .pixels_per_mm = plan.page.pixels_per_mm,
                                 .drawn = plan.page.has_sky,
                                 .size_px = making.sample.size_px,
                                 .tiles = tiles,
                                 .far_m = far_m},
                                making.style.sky);
    std::optional<gpu::ImageId> cover;
    if (plan.clouds) {
        CloudBuffers& buffers = making.resources.clouds;
        const auto import = [&](const char* name, gpu::Buffer& buffer) {
            return gpu::import_whole(making.graph, name, buffer);
        };
        const sky::CloudedSky clouded = sky::add_clouds(making.graph,
                                                        {.frame = scene.frame,
                                                         .globals = import("clouds", buffers.globals),
                                                         .starts = import("cloud cells", buffers.starts),
                                                         .puffs = import("puffs", buffers.puffs),
                                                         .streaks = import("streaks", buffers.streaks),
                                                         .depth = surface.depth,
                                                         .variant = plan.clouds->variant,
                                                         .keeps_cover = has_layers,
                                                         .size_px = making.sample.size_px,
                                                         .tiles = tiles,
                                                         .far_m = far_m,
                                                         .by_groups = works_by_groups(making)},
                                                        sky);
        sky = clouded.sky;
        cover = has_layers ? std::optional(clouded.cover) : std::nullopt;
    }
    const bool is_tinted = screen.is_there && making.style.screen.mode == screen::Mode::ink;
    const gpu::ImageId wash =
        add_paint(making, scene, surface, light, plan.page.shows_sky ? std::optional(sky.wash) : std::nullopt,
                  is_tinted ? &screen : nullptr);
    return {.wash = wash,
            .sky_ink = sky.ink,
            .sky_wash = sky.wash,
            .has_sky_ink = plan.page.shows_sky,
            .cloud_cover = cover};
}

gpu::ImageId add_paint(const Making& making, const PosedScene& scene, const surface::Surface& surface,
                       gpu::ImageId light, const std::optional<gpu::ImageId>& background,
                       const SeenThrough* screen)
{
    return wash::add_wash(making.graph,
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
                           .keeps_cover = making.style.paper.transparent == paper::Transparency::background,
                           .size_px = making.sample.size_px,
                           .look_of_draw = look_of_draw(making)},
                          wash_looks(making));
}

haze::HazeInputs haze_inputs(const Making& making, const PosedScene& scene, const surface::Surface& surface)
{
    return {.frame = scene.frame,
            .depth = surface.depth,
            .line_half_px = making.plan.lines.half_px,
            .size_px = making.sample.size_px};
}

std::optional<StrokeHaze> stroke_haze(const Making& making, const PosedScene& scene,
                                      const surface::Surface& surface)
{
    if (!making.plan.page.has_haze) {
        return std::nullopt;
    }
    return StrokeHaze{.inputs = haze_inputs(making, scene, surface), .style = making.style.haze};
}

haze::HazeLayers add_haze(const Making& making, const PosedScene& scene, const surface::Surface& surface,
                          gpu::ImageId sky_wash, const std::optional<gpu::BufferId>& far_tiles,
                          const haze::HazeLayers& layers)
{
    if (!making.plan.page.has_haze) {
        return layers;
    }
    haze::HazeInputs inputs = haze_inputs(making, scene, surface);
    inputs.tiles = far_tiles;
    return haze::add_haze(making.graph, inputs, making.style.haze, sky_wash, layers);
}

std::optional<gpu::ImageId> add_flowing_ink(const Making& making, const PosedScene& scene,
                                            gpu::BufferId visibility, const surface::Surface& surface,
                                            gpu::ImageId light, const haze::HazeLayers& layers)
{
    if (!making.plan.ink) {
        return std::nullopt;
    }
    const InkPlan& plan = *making.plan.ink;
    gpu::Graph& graph = making.graph;
    ink::Memory& memory = making.resources.ink;
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
             .motion = plan.motion ? std::optional(motion_of(making, scene, visibility, *plan.motion))
                                   : std::nullopt});
    };
    const ink::Flowing flowing =
        making.sample.is_first ? add_flow() : ink::add_standing(graph, memory, plan.ink);
    return ink::add_layer(graph, flowing, scene.frame, making.sample.size_px);
}

std::optional<smoke::Layer> add_smoke(const Making& making, const PosedScene& scene,
                                      const surface::Surface& surface,
                                      const std::optional<smoke::Volume>& volume, gpu::ImageId sky_wash,
                                      gpu::ImageId lines)
{
    if (!volume) {
        return std::nullopt;
    }
    gpu::Graph& graph = making.graph;
    const smoke::ViewInputs view{.frame = scene.frame,
                                 .globals =
                                     gpu::import_whole(graph, "smoke", making.resources.smoke.globals()),
                                 .depth = surface.depth,
                                 .size_px = making.sample.size_px};
    const smoke::SmokeStyle& style = making.style.smoke;
    const haze::HazeStyle& haze = making.style.haze;
    return smoke::add_ink(
        graph, style,
        {.view = view,
         .marched = smoke::add_march(graph, *volume, style, view),
         .lines = lines,
         .scene_line_px = making.plan.lines.half_px,
         .pixels_per_mm = making.plan.page.pixels_per_mm,
         .haze =
             making.plan.page.has_haze
                 ? std::optional(smoke::Haze{
                       .sky = sky_wash, .start_m = haze.start_m, .reach_m = haze.reach_m, .ink = haze.ink})
                 : std::nullopt});
}

paper::ComposeInputs page_layers(const Making& making, const PosedScene& scene,
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
            .ink_settles = making.style.ink.granulation,
            .smoke_paint = moving.smoke ? std::optional(moving.smoke->paint) : std::nullopt,
            .smoke_ink = moving.smoke ? std::optional(moving.smoke->ink) : std::nullopt,
            .has_sky = colors.has_sky_ink,
            .cover = cover,
            .light = light,
            .page_px = making.plan.page_px,
            .size_px = making.sample.size_px};
}

namespace {

/// The pixels of the last sample; those before it end in their sums, and nobody sees pixels yet.
gpu::BufferId add_sample(const Making& making, const paper::ComposeInputs& layers, gpu::BufferId pixels)
{
    gpu::Graph& graph = making.graph;
    const paper::Accumulation& accumulation = making.sample.accumulation;
    if (accumulation.sample_count == 1) {
        return paper::add_pixels(graph, layers, making.style.paper, pixels);
    }
    const gpu::ImageId composed = paper::add_compose(graph, layers, making.style.paper);
    return paper::add_develop(graph, composed, paper::import_sums(graph, making.resources.sums, accumulation),
                              pixels, making.sample.size_px, accumulation, paper::PixelForm::srgb_bytes,
                              paper::transparent_color(making.style.paper))
        .pixels;
}

} // namespace

void add_picture(const Making& making, const paper::ComposeInputs& layers)
{
    gpu::Graph& graph = making.graph;
    const glm::uvec2 size_px = making.sample.size_px;
    const VulkanPicture* target = making.resources.target;
    const bool is_last = making.sample.accumulation.is_last();
    const gpu::BufferId pixels = add_sample(
        making, layers,
        target == nullptr && is_last ? gpu::import_whole(graph, "pixels", making.resources.pixels)
                                     : graph.buffer("pixels", {.size_bytes = 4ULL * size_px.x * size_px.y}));
    if (is_last && target != nullptr) {
        gpu::add_hand_over(graph, pixels, *target, size_px);
    } else if (is_last) {
        gpu::add_host_read(graph, "read back", pixels);
    }
}

void add_deep_picture(const Making& making, const paper::ComposeInputs& layers,
                      const surface::Surface& surface, const light::LitPixels& lit, const MaskInputs& masks)
{
    if (making.resources.deep != nullptr) {
        declare_deep_page(making.graph,
                          {.layers = layers,
                           .draw = surface.draw,
                           .sun = lit.sun,
                           .open = masks.open,
                           .cloud_cover = masks.cloud_cover},
                          making.style.paper, making.sample.accumulation, *making.resources.deep);
    }
}

} // namespace estampe::frame
