// SPDX-License-Identifier: MIT
#include "frame/plan.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include <fmt/format.h>

#include "features/common/style_tables.hpp"
#include "shaders/stroke_kind.glsl.h"
#include "style/toml.hpp"
#include "techniques/occlusion/occlusion.hpp"
#include "techniques/raster/paths.hpp"

namespace estampe::frame {
namespace {

PagePlan plan_page(const PlanInputs& in)
{
    // By default, a scene file with a camera is assumed to be a composed picture. A file with a camera and a
    // sun is assumed to show an outdoor scene.
    const Scene& scene = in.loaded.scene;
    const bool is_composed = !scene.cameras.empty();
    const bool is_outdoors = is_composed && in.lighting.directional_count > 0 && !scene.lights.empty();
    const style::AutoToggle ground = in.style.picture.ground;
    const style::AutoToggle sky = in.style.sky.enabled;
    const style::AutoToggle haze = in.style.haze.enabled;
    const bool has_sky = sky == style::AutoToggle::on ||
                         (sky == style::AutoToggle::automatic && (is_outdoors || scene.terrain.has_value()));
    const bool has_haze =
        haze == style::AutoToggle::on || (haze == style::AutoToggle::automatic && scene.terrain.has_value());
    const bool has_background = in.style.paper.transparent != paper::Transparency::background;
    return {.size_px = {in.settings.width, in.settings.height},
            .pixels_per_mm = features::pixels_per_mm(in.settings.height, in.style.paper.height_mm),
            .pixel = features::pixel_size(in.camera, in.settings.height),
            .has_ground = !scene.terrain &&
                          (ground == style::AutoToggle::on ||
                           (ground == style::AutoToggle::automatic && !is_composed && !in.lighting.indoors)),
            .has_sky = has_sky && (has_background || has_haze),
            .shows_sky = has_sky && has_background,
            .has_haze = has_haze};
}

RasterPlan plan_raster(const PlanInputs& in)
{
    const pose::MeshData& layout = in.loaded.layout;
    const raster::Paths paths =
        raster::paths_of(in.device.info(), in.wanted_path, in.raster_path,
                         {.triangles = layout.opaque.count,
                          .pixels = uint64_t{in.settings.width} * in.settings.height,
                          .has_masks = layout.masked.count + layout.blended.count > 0});
    return {.paths = paths, .tuning = raster::tuning_of(in.device.execution())};
}

SunPlan plan_sun(const PlanInputs& in, const PagePlan& page)
{
    const light::Lighting& lighting = in.lighting;
    const pose::MeshData& layout = in.loaded.layout;
    const features::SunScene scene{
        .casters = in.loaded.pose->casters,
        .still = in.loaded.still_room,
        .floor_m = layout.bounds.min.y,
        .anchor = layout.anchor,
        .towards_sun = lighting.towards_sun,
        .throws_shadow = in.style.light.shadows && lighting.sun_casters != 0 &&
                         lighting.directional_count > 0 && lighting.towards_sun.y > -0.999,
        .most_bytes = std::min<uint64_t>(in.device.limits().maxStorageBufferRange,
                                         4ULL * in.device.limits().maxTexelBufferElements)};
    return {.towards = glm::vec3(lighting.towards_sun),
            .shines = lighting.directional_count > 0,
            .daylight_rad =
                in.daylight ? std::optional(static_cast<float>(in.daylight->elevation_rad)) : std::nullopt,
            .casters = lighting.sun_casters,
            .map = features::plan_sun_map(scene, in.camera, page.size_px, page.pixel, in.style),
            .ground = in.loaded.terrain == nullptr
                          ? features::GroundShadowPlan{}
                          : features::plan_ground_shadow(
                                {.camera = in.camera,
                                 .anchor = layout.anchor,
                                 .towards_sun = lighting.towards_sun,
                                 .is_thrown = scene.throws_shadow,
                                 .page_height_px = page.size_px.y,
                                 .execution = in.device.execution(),
                                 .relief_m = std::max(layout.bounds.max.y, scene.casters.max.y) -
                                             layout.bounds.min.y},
                                in.style.shadow)};
}

LightPlan plan_light(const PlanInputs& in, const features::StrokePlan& strokes)
{
    const light::Lighting& lighting = in.lighting;
    const uint32_t local_count = static_cast<uint32_t>(lighting.records.size()) - lighting.directional_count;
    return {.local_count = local_count,
            .leads_strokes = local_count > 0 && strokes.has(shared::strokes_light),
            .has_links = lighting.has_groups || !in.loaded.has_plain_links,
            .meters_page = in.style.light.metering == light::Metering::page};
}

EdgePlan plan_edges(const features::StyleTables& style, const SunPlan& sun,
                    const features::StrokePlan& strokes, float pixels_per_mm)
{
    const auto lines = features::hatched_lines(style.hatch, sun.towards, strokes);
    return {.profile = shadow::edge_profile(style.shadow, lines, pixels_per_mm),
            .variant = shadow::shadow_variant(style.shadow, lines)};
}

FocusPlan plan_focus(const PlanInputs& in, const PagePlan& page)
{
    const float width_mm = static_cast<float>(page.size_px.x) / page.pixels_per_mm;
    const paper::Window window_mm = paper::window_of(in.style.paper, width_mm);
    const focus::Window window{.min_px = page.pixels_per_mm * window_mm.min_mm,
                               .max_px = page.pixels_per_mm * window_mm.max_mm};
    return {.lines = focus::focus_lines(in.style.focus_lines, window, page.pixels_per_mm, in.settings.time_s),
            .middle_px = focus::middle_px(in.style.focus_lines, window)};
}

std::optional<shared::RippleConstants> plan_ripples(const PlanInputs& in)
{
    const pose::MeshData& layout = in.loaded.layout;
    if (!in.loaded.scene.terrain) {
        return std::nullopt;
    }
    return terrain::ripples_at(in.loaded.scene.terrain->description(),
                               layout.draw_of_vertex.at(*layout.foreign_vertex), layout.anchor,
                               in.settings.time_s);
}

std::optional<terrain::DriftPlan> plan_drift(const PlanInputs& in, const PagePlan& page)
{
    if (!in.loaded.scene.terrain) {
        return std::nullopt;
    }
    const glm::dvec3& anchor = in.loaded.layout.anchor;
    return terrain::drift_at(in.loaded.scene.terrain->description().wind, in.style.drift,
                             {.eye_m = {in.camera.eye.x, in.camera.eye.z},
                              .anchor_m = {anchor.x, anchor.z},
                              .time_s = in.settings.time_s,
                              .pixels_per_mm = page.pixels_per_mm});
}

std::optional<sky::CloudPlan> plan_clouds(const PlanInputs& in, const PagePlan& page, const SunPlan& sun)
{
    if (!page.has_sky) {
        return std::nullopt;
    }
    const sky::SkyStyle& style = in.style.sky;
    return sky::plan_clouds(
        in.style.clouds,
        {.eye_m = in.camera.eye,
         .time_s = in.settings.time_s,
         .towards_sun = sun.towards,
         .follows_elevation_rad = sky::followed_elevation_rad(style, sun.towards, sun.daylight_rad),
         .colors = sky::colors_under(style, sun.towards, sun.daylight_rad),
         .pixels_per_mm = page.pixels_per_mm},
        in.clouds);
}

/// Returns the runs of solid triangles whose style variants satisfy `chosen`.
template <typename Chosen>
std::vector<raster::Batch> runs_of(const pose::MeshData& layout, const features::StyleVariants& variants,
                                   const Chosen& chosen)
{
    std::vector<raster::Batch> runs;
    for (const pose::Range* range : {&layout.opaque, &layout.masked}) {
        bool goes_on = false;
        for (uint32_t triangle = range->first; triangle < range->first + range->count; ++triangle) {
            const uint32_t draw = layout.triangles[triangle].w & shared::triangle_draw_mask;
            const uint32_t variant = variants.has_several() ? variants.variant_of_draw[draw] : 0U;
            const bool is_chosen = chosen(variants.styles[variant].subsurface);
            if (is_chosen && !goes_on) {
                runs.push_back({.first_triangle = triangle, .masked = range == &layout.masked});
            }
            if (is_chosen) {
                ++runs.back().triangle_count;
            }
            goes_on = is_chosen;
        }
    }
    return runs;
}

std::optional<SubsurfacePlan> plan_subsurface(const pose::MeshData& layout,
                                              const features::StyleVariants& variants, bool has_ground)
{
    if (std::ranges::none_of(variants.styles,
                             [](const features::StyleTables& style) { return style.subsurface.enabled; })) {
        return std::nullopt;
    }
    SubsurfacePlan plan;
    for (const features::StyleTables& style : variants.styles) {
        plan.parameters.push_back(subsurface::parameters_of(style.subsurface));
        plan.scatters |= subsurface::scatters(style.subsurface);
        plan.refracts |= subsurface::refracts(style.subsurface);
    }
    plan.bodies = runs_of(layout, variants, subsurface::shines);
    plan.clear = runs_of(layout, variants, subsurface::is_clear);
    const auto all_but = [&](bool (*is_left_out)(const subsurface::SubsurfaceStyle&)) {
        std::vector<raster::Batch> runs = runs_of(layout, variants, std::not_fn(is_left_out));
        if (has_ground) {
            runs.push_back({.first_triangle = layout.ground.first,
                            .triangle_count = layout.ground.count,
                            .plain = layout.ground.plain});
        }
        return runs;
    };
    if (!plan.clear.empty()) {
        plan.others = all_but(subsurface::is_clear);
        const bool any_shows = std::ranges::any_of(variants.styles, [](const features::StyleTables& style) {
            return subsurface::shows_lines(style.subsurface);
        });
        plan.lines_show = std::ranges::all_of(variants.styles, [](const features::StyleTables& style) {
            return subsurface::shows_lines(style.subsurface) || !subsurface::is_clear(style.subsurface);
        });
        if (any_shows && !plan.lines_show) {
            plan.line_hiders = all_but(subsurface::shows_lines);
        }
    }
    return plan;
}

std::optional<uint32_t> scatter_texels(const subsurface::SubsurfaceStyle& style,
                                       const std::optional<SubsurfacePlan>& plan)
{
    const bool has_map = plan && plan->scatters && style.space == subsurface::Space::texture;
    return has_map ? std::optional(style.texels) : std::nullopt;
}

bool draws_shadow_lines(const contour::ContourStyle& style, const features::SunMapPlan& map)
{
    return style.enabled && style.lines == contour::Lines::chains &&
           contour::has_lines(style, shared::line_shadow) && map.size > 0;
}

float widest_half_px(const contour::ContourStyle& style, float pixels_per_mm)
{
    float widest_mm = 0.0F;
    for (uint32_t kind = 0; kind < shared::line_kind_count; ++kind) {
        widest_mm = std::max(widest_mm, contour::width_on_page_mm(style, kind));
    }
    return 0.5F * widest_mm * pixels_per_mm;
}

} // namespace

FramePlan shrunk_plan(const FramePlan& plan, uint32_t shrink, glm::uvec2 size_px,
                      const features::StyleTables& style)
{
    FramePlan shrunk = plan;
    shrunk.page.size_px = size_px;
    shrunk.page.pixels_per_mm /= static_cast<float>(shrink);
    shrunk.page.pixel.at_one_m *= static_cast<float>(shrink);
    shrunk.lines.half_px /= static_cast<float>(shrink);
    shrunk.shadow_edges = plan_edges(style, plan.sun, plan.strokes, shrunk.page.pixels_per_mm);
    return shrunk;
}

FramePlan plan_frame(const PlanInputs& in, PlanLists room)
{
    const PagePlan page = plan_page(in);
    features::StyleVariants variants =
        features::style_variants(in.loaded.layout, in.loaded.scene, in.style, std::move(room.styles));
    features::StrokePlan strokes =
        features::plan_strokes(in.loaded.layout, variants, std::move(room.kind_of_draw));
    if (in.loaded.scene.terrain) {
        const float wind_rad =
            glm::radians(wind::from_x_deg(in.loaded.scene.terrain->description().wind.towards_deg));
        strokes.ground_wind = {std::cos(wind_rad), std::sin(wind_rad)};
    }
    const LightPlan light = plan_light(in, strokes);
    SunPlan sun = plan_sun(in, page);
    const EdgePlan edges = plan_edges(in.style, sun, strokes, page.pixels_per_mm);
    std::optional<sky::CloudPlan> clouds = plan_clouds(in, page, sun);
    const LinePlan lines{.half_px = widest_half_px(variants.lines, page.pixels_per_mm),
                         .of_shadows = draws_shadow_lines(variants.lines, sun.map)};
    std::optional<SubsurfacePlan> subsurface = plan_subsurface(in.loaded.layout, variants, page.has_ground);
    const auto texels_of_scatter = scatter_texels(in.style.subsurface, subsurface);
    return {.page_px = page.size_px,
            .page = page,
            .raster = plan_raster(in),
            .culls_cells = in.style.culling.cells == cells::Culling::portals &&
                           !in.loaded.scene.cells.empty() && !page.pixel.is_parallel,
            .needs = in.loaded.needs,
            .variants = std::move(variants),
            .strokes = std::move(strokes),
            .sun = std::move(sun),
            .light = light,
            .shadow_edges = edges,
            .occlusion_radius_m = occlusion::radius_of(in.style.occlusion,
                                                       static_cast<float>(in.loaded.layout.bounds.radius())),
            .occlusion_texels = occlusion::map_texels(in.style.occlusion),
            .scatter_texels = texels_of_scatter,
            .subsurface = std::move(subsurface),
            .lines = lines,
            .focus = plan_focus(in, page),
            .ripples = plan_ripples(in),
            .drift = plan_drift(in, page),
            .clouds = std::move(clouds)};
}

namespace {

/// Approximate bounds of a draw call in world space.
Bounds place_of(const LoadedScene& loaded, const ScenePose& pose, size_t draw)
{
    const Scene& scene = loaded.scene;
    const pose::DrawSource& source = loaded.layout.sources[draw];
    const Node& node = scene.nodes[source.node];
    Bounds place;
    if (node.skin != no_index) {
        for (const Index joint : scene.skins[node.skin].joints) {
            place.extend(glm::dvec3(pose.world_from_node[joint][3]));
        }
        return place;
    }
    const glm::dmat4 anchor_from_object(loaded.pose->draws[draw].anchor_from_object);
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 end((corner & 1) != 0 ? source.local_bounds.max.x : source.local_bounds.min.x,
                             (corner & 2) != 0 ? source.local_bounds.max.y : source.local_bounds.min.y,
                             (corner & 4) != 0 ? source.local_bounds.max.z : source.local_bounds.min.z);
        place.extend(glm::dvec3(anchor_from_object * glm::dvec4(end, 1.0)) + loaded.layout.anchor);
    }
    return place;
}

} // namespace

double focus_distance_m(const LensSetting& in, std::vector<std::string>& notes)
{
    const lens::LensStyle& style = in.style.lens;
    const glm::dvec3 ahead = glm::normalize(in.camera.target - in.camera.eye);
    const auto away_m = [&](const Bounds& place) { return glm::dot(place.center() - in.camera.eye, ahead); };
    Bounds named;
    if (!style.focus_on.empty()) {
        for (size_t draw = 0; draw < in.loaded.layout.sources.size(); ++draw) {
            if (features::is_named(in.loaded.scene, in.loaded.layout.sources[draw].node, style.focus_on)) {
                const Bounds place = place_of(in.loaded, in.pose, draw);
                if (!place.empty()) {
                    named.extend(place.min);
                    named.extend(place.max);
                }
            }
        }
        if (named.empty()) {
            notes.push_back(fmt::format("lens.focus_on speaks of objects {}, of which the scene has none",
                                        style::in_quotes(style.focus_on)));
        }
    }
    const double nearest_m = 2e-3 * static_cast<double>(style.focal_mm);
    if (!named.empty()) {
        return std::max(away_m(named), nearest_m);
    }
    if (style.focus_m > 0.0F) {
        return std::max(static_cast<double>(style.focus_m), nearest_m);
    }
    return std::max(away_m(in.loaded.layout.bounds), nearest_m);
}

std::optional<shared::LensConstants> plan_lens(const LensSetting& in, std::vector<std::string>& notes)
{
    if (!in.style.lens.enabled) {
        return std::nullopt;
    }
    if (in.page.pixel.is_parallel) {
        notes.emplace_back("a parallel projection has no lens: all of it is in focus");
        return std::nullopt;
    }
    return lens::lens_on(in.style.lens, {.focus_m = focus_distance_m(in, notes),
                                         .near_m = in.camera.near_m,
                                         .pixel_at_one_m = static_cast<double>(in.page.pixel.at_one_m),
                                         .pixels_per_mm = in.page.pixels_per_mm,
                                         .line_half_px = in.line_half_px});
}

} // namespace estampe::frame
