// SPDX-License-Identifier: MIT
// Steps of a frame that turn light into ink and colour on paper.
#include "frame/steps.hpp"
#include "gpu/resources.hpp"
#include "techniques/contour/chains/chains.hpp"
#include "techniques/halo/halo.hpp"
#include "techniques/subsurface/subsurface.hpp"

namespace estampe::frame {
namespace {

const std::vector<wash::WashVariant>& wash_variants(const FrameContext& context)
{
    std::vector<wash::WashVariant>& variants = context.wash_variants;
    const std::vector<features::StyleTables>& styles = context.plan.variants.styles;
    // Assigning to the variants of the previous frame reuses the memory of their texts.
    variants.resize(styles.size());
    for (size_t i = 0; i < styles.size(); ++i) {
        variants[i].style = styles[i].wash;
        variants[i].tone = light::tone_constants(styles[i].tone);
    }
    return variants;
}

/// Returns the image that determines the size of strokes on the page; if the lens blurs strokes, their
/// footprint is wider.
gpu::ImageId stroke_footprint(const FrameContext& context, const surface::Surface& surface)
{
    const bool are_wider = context.plan.lens && context.style.lens.acts_on == lens::ActsOn::strokes &&
                           context.style.lens.mode != lens::Mode::circles;
    return are_wider ? lens::add_wider_strokes(context.graph, surface.depth, surface.footprint,
                                               context.sample.size_px, *context.plan.lens)
                     : surface.footprint;
}

/// Returns the motion that blurs the picture: the motion of the scene, or the motion of a simpler shape,
/// which some modes of the style draw only to get velocities.
gpu::ImageId blurring_motion_of(const FrameContext& context, const PosedScene& scene,
                                const MotionBlurPlan& plan, gpu::ImageId own_motion)
{
    const std::optional<motion_blur::VelocityShape> shape = context.features.motion_blur.record(
        context.graph,
        {.posed_vertices = scene.meshes.posed_vertices,
         .posed_vertices_before = vertices_before(context, scene, plan.motion),
         .now_from_before = glm::inverse(plan.motion.clip_from_anchor) * plan.motion.clip_from_anchor_before,
         .share = plan.constants.scale},
        context.style.motion_blur);
    if (!shape) {
        return own_motion;
    }
    PosedScene drawn_out = scene;
    drawn_out.meshes.posed_vertices = shape->vertices;
    drawn_out.vertices_before = shape->before;
    drawn_out.cluster_bounds.reset(); // boxes of triangles that are not drawn out
    drawn_out.seen_clusters.reset();  // triangles that are drawn out may leave their room
    features::MotionPlan moved = plan.motion;
    moved.pose_moved = true;
    const gpu::BufferId visibility = add_visibility(context, drawn_out, "motion blur/visibility");
    return motion::add_motion(context.graph, motion_inputs(context, drawn_out, visibility, moved));
}

/// Returns whether groups of 8 x 8 pixels share their results, which is faster on a GPU. In a tile, the
/// groups must coincide with the groups of the whole page.
bool works_by_groups(const FrameContext& context)
{
    const glm::uvec2 beside_px = glm::uvec2(context.sample.from_px) % 8U;
    return context.device.execution().shares_by_groups() && beside_px == glm::uvec2(0);
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

} // namespace

std::optional<gpu::BufferId> variant_of_draw(const FrameContext& context)
{
    if (!context.plan.variants.has_several()) {
        return std::nullopt;
    }
    return gpu::import_whole(context.graph, "style variants", context.buffers.variant_of_draw);
}

std::optional<gpu::ImageId> add_halo(const FrameContext& context, const PosedScene& scene,
                                     const surface::Surface& surface)
{
    const FramePlan& plan = context.plan;
    float halo_mm = plan.page.has_sky && context.style.sky.darkness > 0.0F ? context.style.sky.halo_mm : 0.0F;
    for (const features::StyleTables& style : plan.variants.styles) {
        halo_mm = std::max(halo_mm, style.hatch.enabled ? style.hatch.halo_mm : 0.0F);
    }
    if (halo_mm <= 0.0F) {
        return std::nullopt;
    }
    return halo::add_distances(context.graph, {.frame = scene.frame,
                                               .draw = surface.draw,
                                               .normal = surface.normal,
                                               .ground_draws = plan.strokes.ground_draws,
                                               .reach_px = halo_mm * plan.page.pixels_per_mm,
                                               .pixels_per_mm = plan.page.pixels_per_mm,
                                               .size_px = context.sample.size_px});
}

hatch::HatchInputs hatch_inputs(const FrameContext& context, const PosedScene& scene,
                                const surface::Surface& surface, const light::LitPixels& lit,
                                const SeenThrough& screen, const std::optional<gpu::ImageId>& halo)
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
            .sun = plan.strokes.has_causes && plan.sun.shines ? std::optional(lit.sun) : std::nullopt,
            .ground_draws = plan.strokes.ground_draws,
            .halo = halo,
            .screen = screen.images.color,
            .has_screen = screen.is_there,
            .tone = {},
            .strokes_present = plan.strokes.present,
            .strongest_light = plan.light.leads_strokes ? std::optional(lit.strongest) : std::nullopt,
            .towards_light = plan.sun.towards,
            .ground_wind = plan.strokes.ground_wind,
            .pixels_per_mm = plan.page.pixels_per_mm,
            .size_px = context.sample.size_px,
            .variant_of_draw = variant_of_draw(context),
            .draws = scene.meshes.draws,
            .marks_solid = contour::spares_lines(plan.variants.lines)};
}

namespace {

bool has_clumps(const contour::ContourStyle& style)
{
    return style.clump_mm > 0.0F &&
           (contour::has_lines(style, shared::line_clump) || contour::has_lines(style, shared::line_leaf));
}

} // namespace

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
            .has_clumps = has_chains && context.loaded.layout.has_foliage && has_clumps(plan.variants.lines),
            .first_cut_triangle = context.loaded.layout.masked.first,
            .tone = light::tone_constants(context.style.tone),
            .execution = context.device.execution(),
            .is_moving = is_moving,
            .brushes = context.features.lines.brushes(),
            .pixels_per_mm = plan.page.pixels_per_mm,
            .line_step_px = context.sample.line_step_px,
            .pixel_m_at_one = plan.page.pixel.at_one_m,
            .size_px = context.sample.size_px,
            .variant_of_draw = variant_of_draw(context),
            .variant_lines = plan.variants.need_variant_lines()
                                 ? std::optional(gpu::import_whole(context.graph, "variant lines",
                                                                   context.features.lines.variants()))
                                 : std::nullopt,
            .has_inks_by_kind = plan.variants.has_inks_by_kind(),
            .line_hiders = bends_light(context) ? std::nullopt : screen.line_hiders};
}

gpu::ImageId add_lines(const FrameContext& context, const contour::ContourInputs& in)
{
    const FramePlan& plan = context.plan;
    const pose::MeshData& layout = context.loaded.layout;
    const bool is_cut = layout.has_cut_outs || (layout.has_foliage && !in.has_clumps);
    const bool has_cuts =
        is_cut && (layout.masked.count > 0 ||
                   (layout.blended.count > 0 && transparency::has_opaque_parts(context.style.transparency)));
    return context.features.lines.record(context.graph, in,
                                         {.style = plan.variants.lines,
                                          .has_cuts = has_cuts,
                                          .remembers = plan.lines.are_remembered && context.sample.is_first,
                                          .linked = context.job.linked});
}

contour::InkImages add_spared_lines(const FrameContext& context, const contour::InkImages& ink)
{
    const contour::ContourStyle& style = context.plan.variants.lines;
    return contour::spares_lines(style)
               ? contour::add_spared(context.graph, ink, style, context.plan.page.pixels_per_mm)
               : ink;
}

gpu::ImageId add_bent_lines(const FrameContext& context, const contour::ContourInputs& in,
                            const SeenThrough& screen, gpu::ImageId lines)
{
    const FramePlan& plan = context.plan;
    if (!screen.bent || !screen.line_hiders || !in.variant_lines || !plan.variants.lines.enabled) {
        return lines;
    }
    contour::ContourInputs behind = in;
    behind.line_hiders = screen.line_hiders;
    behind.variant_lines = gpu::import_whole(context.graph, "lines without clear bodies",
                                             context.features.lines.variants_behind());
    const std::optional<gpu::ImageId> drawn =
        context.features.lines.record_behind(context.graph, behind, plan.variants.lines);
    return drawn ? subsurface::add_bent_lines(context.graph, *screen.bent, *drawn, lines,
                                              context.sample.size_px)
                 : lines;
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

haze::HazeLayers add_pigment(const FrameContext& context, const haze::HazeLayers& layers)
{
    const pigment::PigmentLayers moved = pigment::add_pigment(
        context.graph,
        {.ink = context.style.paper.ink,
         .pixels_per_mm = context.plan.page.pixels_per_mm,
         .size_px = context.sample.size_px,
         .from_px = glm::uvec2(context.sample.from_px)},
        context.style.pigment, {.wash = layers.wash, .hatch = layers.hatch, .lines = layers.lines});
    return {.wash = moved.wash, .hatch = moved.hatch, .lines = moved.lines};
}

haze::HazeLayers add_particles(const FrameContext& context, const PosedScene& scene,
                               const surface::Surface& surface, gpu::ImageId sky_wash,
                               const haze::HazeLayers& layers)
{
    const particles::ParticleLayers drawn = context.features.particles.record(
        context.graph, context.plan.particles,
        {.frame = scene.frame,
         .depth = surface.depth,
         .sky = sky_wash,
         .size_px = context.sample.size_px,
         .by_groups = works_by_groups(context)},
        {.wash = layers.wash, .hatch = layers.hatch, .lines = layers.lines});
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
    const gpu::ImageId own_motion =
        motion::add_motion(context.graph, motion_inputs(context, scene, visibility, plan->motion));
    // The matrices of the two moments contain the sample's subpixel jitter. The jitter then cancels out, and
    // only the motion of the object remains.
    const glm::mat4 shifted_before(glm::dmat4(context.sample.clip_from_anchor) *
                                   glm::inverse(glm::dmat4(plan->motion.clip_from_anchor)) *
                                   glm::dmat4(plan->motion.clip_from_anchor_before));
    const motion_blur::SmearScene smear{.frame = scene.frame,
                                        .triangles = scene.meshes.triangles,
                                        .posed_vertices = scene.meshes.posed_vertices,
                                        .posed_vertices_before =
                                            vertices_before(context, scene, plan->motion),
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
         .smear = context.style.motion_blur.smear.enabled ? std::optional(smear) : std::nullopt,
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
        context.style.focus_lines, lines);
}

namespace {

/// Distance from the eye beyond which pixels may show sky: nearer surfaces hide the sky completely, farther
/// surfaces may be mixed with it by haze.
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

std::optional<gpu::ImageId> add_shade(const FrameContext& context, const PosedScene& scene,
                                      gpu::BufferId visibility, const surface::Surface& surface,
                                      gpu::ImageId sun)
{
    if (!context.plan.toon.is_drawn) {
        return std::nullopt;
    }
    features::Toon& toon = context.features.toon;
    return surface::add_shade(context.graph, {.frame = scene.frame,
                                              .visibility = visibility,
                                              .triangles = scene.meshes.triangles,
                                              .posed_vertices = scene.meshes.posed_vertices,
                                              .draws = scene.meshes.draws,
                                              .rest_vertices = scene.meshes.rest_vertices,
                                              .records = toon.records(context.graph),
                                              .textures = scene.meshes.textures,
                                              .pictures = toon.pictures(context.graph),
                                              .draw = surface.draw,
                                              .normal = surface.normal,
                                              .sun = sun,
                                              .towards_sun = context.plan.sun.towards,
                                              .has_steps = context.plan.toon.has_steps,
                                              .texture_classes = scene.meshes.texture_classes,
                                              .lists_tiles = context.device.execution().lists_tiles(),
                                              .size_px = context.sample.size_px});
}

Colors add_colors(const FrameContext& context, const PosedScene& scene, const surface::Surface& surface,
                  const LightAndShade& lit, const SeenThrough& screen,
                  const std::optional<gpu::BufferId>& far_tiles, const std::optional<gpu::ImageId>& halo)
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
                                 .halo = halo,
                                 .size_px = context.sample.size_px,
                                 .tiles = tiles,
                                 .far_m = far_m},
                                context.style.sky);
    std::optional<gpu::ImageId> cover;
    if (plan.clouds) {
        const sky::CloudedSky clouded =
            sky::add_clouds(context.graph,
                            {.frame = scene.frame,
                             .clouds = context.features.clouds.import(context.graph),
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
    const gpu::ImageId wash =
        add_paint(context, scene, surface, lit, plan.page.shows_sky ? std::optional(sky.wash) : std::nullopt,
                  is_tinted ? &screen : nullptr);
    return {.wash = wash,
            .sky_ink = sky.ink,
            .sky_wash = sky.wash,
            .has_sky_ink = plan.page.shows_sky,
            .cloud_cover = cover};
}

gpu::ImageId add_paint(const FrameContext& context, const PosedScene& scene, const surface::Surface& surface,
                       const LightAndShade& lit, const std::optional<gpu::ImageId>& background,
                       const SeenThrough* screen)
{
    return wash::add_wash(context.graph,
                          {.frame = scene.frame,
                           .draw = surface.draw,
                           .depth = surface.depth,
                           .color = surface.color,
                           .light = lit.light,
                           .draws = scene.meshes.draws,
                           .materials = scene.meshes.materials,
                           .screen = screen != nullptr ? screen->images.color : surface.color,
                           .has_screen = screen != nullptr,
                           .shade = lit.shade,
                           .background = background.value_or(surface.color),
                           .has_background = background.has_value(),
                           .keeps_cover = context.style.paper.transparent == paper::Transparency::background,
                           .size_px = context.sample.size_px,
                           .variant_of_draw = variant_of_draw(context)},
                          wash_variants(context));
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
    const bool is_first = context.sample.is_first;
    return context.features.ink.record(
        context.graph, plan,
        {.frame = scene.frame,
         .hatch = layers.hatch,
         .lines = layers.lines,
         .light = light,
         .draw = surface.draw,
         .depth = surface.depth,
         .coordinate = surface.coordinate,
         .footprint = surface.footprint,
         .motion = plan.motion && is_first
                       ? std::optional(motion::add_motion(
                             context.graph, motion_inputs(context, scene, visibility, *plan.motion)))
                       : std::nullopt},
        is_first, context.sample.size_px);
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
    const smoke::ViewInputs view =
        context.features.smoke.view(graph, scene.frame, surface.depth, context.sample.size_px);
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

} // namespace estampe::frame
