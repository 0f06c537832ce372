// SPDX-License-Identifier: MIT
#include "techniques/sky/clouds/clouds.hpp"

#include <algorithm>
#include <cmath>

#include "shaders/cloud_shadow_comp.hpp"
#include "shaders/clouds_comp.hpp"
#include "style/parameter.hpp"
#include "techniques/sky/clouds/cover.hpp"

namespace estampe::sky {

const style::Table<CloudStyle>& cloud_table()
{
    static const auto table =
        style::Table<CloudStyle>("clouds", "Clouds over a drawn sky")
            .number("coverage", &CloudStyle::coverage, {0.0F, 0.95F}, "",
                    "Share of the sky overhead that cumulus clouds (heaps with a flat base) cover: more is "
                    "cloudier. 0 draws no cumulus clouds.")
            .number("base_m", &CloudStyle::base_m, {50.0F, 20000.0F}, "m",
                    "Height in the scene (above y = 0) of the flat base of cumulus clouds (heaps). No "
                    "cumulus clouds are drawn when the camera is above their base.")
            .number("size_m", &CloudStyle::size_m, {50.0F, 20000.0F}, "m",
                    "Width of an average cumulus cloud (heap with a flat base): less gives many small clouds")
            .number("heaped", &CloudStyle::heaped, {0.1F, 3.0F}, "",
                    "Height of cumulus clouds compared to their width: less is flat, more is towering")
            .number("flocks", &CloudStyle::flocks, {0.0F, 0.95F}, "",
                    "Share of the sky that groups of small flat clouds (altocumulus) cover: more is "
                    "cloudier. 0 draws none of these clouds.")
            .number("flocks_base_m", &CloudStyle::flocks_base_m, {50.0F, 20000.0F}, "m",
                    "Height in the scene (above y = 0) of the groups of small flat clouds (altocumulus)")
            .number("flocks_size_m", &CloudStyle::flocks_size_m, {50.0F, 20000.0F}, "m",
                    "Width of one group of small flat clouds (altocumulus)")
            .number("streaks", &CloudStyle::streaks, {0.0F, 0.95F}, "",
                    "Share of the sky that white streaks along the wind (cirrus) cover: more is cloudier. 0 "
                    "draws no streaks.")
            .number("streaks_base_m", &CloudStyle::streaks_base_m, {50.0F, 20000.0F}, "m",
                    "Height in the scene (above y = 0) of the white streaks in the sky (cirrus)")
            .number("streaks_size_m", &CloudStyle::streaks_size_m, {50.0F, 50000.0F}, "m",
                    "Width of a bundle of white streaks in the sky (cirrus)")
            .number("streaks_mm", &CloudStyle::streaks_mm, {0.05F, 10.0F}, "mm",
                    "Width on the page of a single white streak in the sky (cirrus): more is bolder")
            .number("wind_m_per_s", &CloudStyle::wind_m_per_s, {-1.0F, 1000.0F}, "m/s",
                    "Speed at which all clouds drift with the wind (see wind.towards_deg). -1 takes the "
                    "speed from wind.speed_m_per_s.")
            .number(
                "change_s", &CloudStyle::change_s, {1.0F, 1000000.0F}, "s",
                "Time in which clouds change their shape into another and back again: less changes faster")
            .color("color", &CloudStyle::color, "Colour of clouds on the side of the sun")
            .color("shade_color", &CloudStyle::shade_color, "Colour of clouds on the side away from the sun")
            .integer("tones", &CloudStyle::tones, {1, 3}, "",
                     "Number of flat tones in clouds. 1 is the light colour alone, 2 adds a shade colour, 3 "
                     "adds a tone between light and shade.")
            .number("shade", &CloudStyle::shade, {0.0F, 1.0F}, "",
                    "How far shade reaches up in clouds. 0 gives the least shade, 1 shades all parts except "
                    "those that face the sun.")
            .number("outline_mm", &CloudStyle::outline_mm, {0.0F, 10.0F}, "mm",
                    "Width on the page of the outlines of clouds where they are thickest: more is bolder. 0 "
                    "draws no outlines.")
            .number("broken", &CloudStyle::broken, {0.0F, 1.0F}, "",
                    "How much outlines of clouds thin and break on the side of the sun. 0 keeps outlines "
                    "unbroken, 1 breaks them most.")
            .number("hatch", &CloudStyle::hatch, {0.0F, 1.0F}, "",
                    "Darkness of the hatching strokes in the shade of clouds. 0 draws no strokes, so that "
                    "only colour shows the shade.")
            .number("hatch_mm", &CloudStyle::hatch_mm, {0.02F, 10.0F}, "mm",
                    "Width of the hatching strokes in the shade of clouds: more is bolder. Only used when "
                    "clouds.hatch is above 0.")
            .number("shadow", &CloudStyle::shadow, {0.0F, 1.0F}, "",
                    "Darkness of the shadows that clouds throw on the ground: 0 throws none, 1 blocks all "
                    "sunlight")
            .number("reach_m", &CloudStyle::reach_m, {1000.0F, 200000.0F}, "m",
                    "Distance from the camera at which clouds have faded into the sky. Less gives fewer "
                    "clouds near the horizon.");
    return table;
}

namespace {

constexpr uint32_t tile_cells = 64;
constexpr uint32_t streak_cells = 32;
constexpr uint32_t streak_mass_cells = 4;

/// One kind of cloud that is made of puffs (balls with a drawn outline).
struct Kind {
    float coverage;
    float base_m;
    glm::vec3 cell_m; ///< size of a cell in metres: along the wind, up, across the wind
    uint32_t mass_cells;
    PuffShape shape;
    float pen;   ///< factor on the width of the outlines
    float under; ///< how much darker the flat base of a cloud is
    uint32_t seed;
};

Kind heaps(const CloudStyle& style)
{
    constexpr uint32_t mass_cells = 6;
    const float cell_m = style.size_m / static_cast<float>(mass_cells);
    return {.coverage = style.coverage,
            .base_m = style.base_m,
            .cell_m = {cell_m, cell_m * style.heaped, cell_m},
            .mass_cells = mass_cells,
            .shape = {.levels = 4},
            .pen = 1.0F,
            .under = 0.3F,
            .seed = 2U * static_cast<uint32_t>(style.seed)};
}

Kind flocks(const CloudStyle& style)
{
    constexpr uint32_t mass_cells = 9;
    const float cell_m = style.flocks_size_m / static_cast<float>(mass_cells);
    return {.coverage = style.flocks,
            .base_m = style.flocks_base_m,
            .cell_m = {0.7F * cell_m, 0.25F * cell_m, 1.6F * cell_m},
            .mass_cells = mass_cells,
            .shape = {.radius = 0.62F, .growth = 0.2F},
            .pen = 0.6F,
            .under = -0.6F,
            .seed = 2U * static_cast<uint32_t>(style.seed) + 1U};
}

/// The wind in the plane of x and z.
struct Wind {
    glm::dvec2 along{0.0, 1.0};
    double drifted_m = 0.0;

    /// Converts a world position to coordinates that drift with the clouds: along the wind, and across the
    /// wind.
    [[nodiscard]] glm::dvec2 from_world(const glm::dvec3& place) const
    {
        return {place.x * along.x + place.z * along.y - drifted_m, place.z * along.x - place.x * along.y};
    }
};

Wind wind_of(const CloudStyle& style, double time_s)
{
    const double bearing = glm::radians(static_cast<double>(style.wind.towards_deg));
    return {.along = {std::sin(bearing), std::cos(bearing)},
            .drifted_m = static_cast<double>(wind::speed_m_per_s(style.wind, style.wind_m_per_s)) * time_s};
}

/// Appends lists of puffs (balls of cloud) to `shapes`. Returns the index of the first appended cell in
/// CloudShapes::starts.
uint32_t add_lists(CloudShapes& shapes, const PuffLists& lists)
{
    const auto first_cell = static_cast<uint32_t>(shapes.starts.size());
    const auto first_puff = static_cast<uint32_t>(shapes.puffs.size());
    for (const uint32_t start : lists.starts) {
        shapes.starts.push_back(first_puff + start);
    }
    shapes.puffs.insert(shapes.puffs.end(), lists.puffs.begin(), lists.puffs.end());
    return first_cell;
}

/// Wraps a place into the tile on which the clouds repeat.
glm::vec2 on_tile(const glm::dvec2& place, double tile)
{
    return glm::vec2(place - tile * glm::floor(place / tile));
}

/// Phase of the clouds' slow change, rounded to small steps. A step is too small to be seen, and many frames
/// of a film have the same phase.
float turn_of(const CloudStyle& style, double time_s)
{
    constexpr double steps = 32768.0;
    const double turns = time_s / static_cast<double>(style.change_s);
    return static_cast<float>(std::floor(steps * (turns - std::floor(turns))) / steps);
}

CloudShapes::Layer add_shapes(CloudShapes& shapes, const Kind& kind, float turn)
{
    if (kind.coverage <= 0.0F) {
        return {};
    }
    const CoverField field =
        cover_field({.cells = tile_cells, .mass_cells = kind.mass_cells, .turn = turn, .seed = kind.seed});
    const float limit = limit_for(field, kind.shape, kind.coverage, kind.seed);
    return shapes.add(puffs_of(field, kind.shape, limit, kind.seed), tile_cells);
}

std::vector<float> streak_shapes(const CloudStyle& style, float turn)
{
    if (style.streaks <= 0.0F) {
        return {};
    }
    const CoverField field = cover_field({.cells = streak_cells,
                                          .mass_cells = streak_mass_cells,
                                          .turn = turn,
                                          .seed = static_cast<uint32_t>(style.seed) + 40503U});
    return streak_density(field, style.streaks);
}

void add_kind(CloudPlan& plan, const Kind& kind, const CloudShapes::Layer& layer, const CloudStyle& style,
              const CloudView& view)
{
    const double base_m = static_cast<double>(kind.base_m) - view.eye_m.y;
    if (kind.coverage <= 0.0F || base_m <= 0.0) {
        return;
    }
    const glm::dvec3 cell_m(kind.cell_m);
    const glm::dvec2 eye =
        wind_of(style, view.time_s).from_world(view.eye_m) / glm::dvec2(cell_m.x, cell_m.z);
    const glm::vec2 eye_on_tile = on_tile(eye, tile_cells);
    plan.globals.puffs[plan.globals.puff_layer_count++] = {
        .eye = {eye_on_tile.x, -static_cast<float>(base_m / cell_m.y), eye_on_tile.y},
        .base_m = static_cast<float>(base_m),
        .per_m = 1.0F / kind.cell_m,
        .thick_m = layer.top * kind.cell_m.y,
        .pen = kind.pen,
        .under = kind.under,
        .cells = tile_cells,
        .first_cell = layer.first_cell,
        .first_home = layer.first_home,
        .reach = layer.reach};
}

void add_streaks(CloudPlan& plan, const CloudStyle& style, const CloudView& view)
{
    const double base_m = static_cast<double>(style.streaks_base_m) - view.eye_m.y;
    if (style.streaks <= 0.0F || base_m <= 0.0) {
        return;
    }
    const double cell_m = static_cast<double>(style.streaks_size_m) / streak_mass_cells;
    plan.variant |= shared::clouds_have_streaks;
    plan.globals.streaks = {
        .eye = on_tile(wind_of(style, view.time_s).from_world(view.eye_m) / cell_m, streak_cells),
        .base_m = static_cast<float>(base_m),
        .cell_m = static_cast<float>(cell_m),
        .cells = streak_cells,
        .width_px = style.streaks_mm * view.pixels_per_mm};
}

/// Adjusts the style's colours to the time of day. When the sun is low, the lit colour is mixed with the
/// horizon's colour. At night, the lit and the shaded colour are mixed with the sky's colour.
void set_colors(shared::CloudGlobals& globals, const CloudStyle& style, const CloudView& view)
{
    glm::vec3 lit = style.color;
    glm::vec3 shade = style.shade_color;
    if (view.follows_elevation_rad) {
        const auto deg = static_cast<float>(glm::degrees(*view.follows_elevation_rad));
        const float low = 1.0F - glm::smoothstep(4.0F, 25.0F, deg);
        const float night = 1.0F - glm::smoothstep(-8.0F, 1.0F, deg);
        lit = glm::mix(lit, view.colors.horizon, 0.3F * low);
        lit = glm::mix(lit, glm::mix(view.colors.zenith, view.colors.horizon, 0.8F), 0.85F * night);
        shade = glm::mix(shade, view.colors.zenith, 0.25F * low);
        shade = glm::mix(shade, glm::mix(view.colors.zenith, view.colors.horizon, 0.4F), 0.85F * night);
    }
    globals.lit_color = lit;
    globals.shade_color = shade;
    globals.middle_color = glm::mix(lit, shade, 0.45F);
}

} // namespace

CloudShapes::Layer CloudShapes::add(std::span<const shared::CloudPuff> layer_puffs, uint32_t cells)
{
    Layer layer{.first_cell = add_lists(*this, list_puffs(layer_puffs, cells)),
                .first_home = add_lists(*this, list_homes(layer_puffs, cells))};
    for (const shared::CloudPuff& puff : layer_puffs) {
        layer.top = std::max(layer.top, puff.centre.y + 1.1F * puff.radius);
        layer.reach = std::max(layer.reach, shared::puff_wavers * puff.radius);
    }
    return layer;
}

std::shared_ptr<const CloudShapes> CloudMemory::shapes(const CloudStyle& style, float turn)
{
    if (!shapes_ || style_ != style || turn_ != turn) {
        auto shapes = std::make_shared<CloudShapes>();
        shapes->layers = {add_shapes(*shapes, heaps(style), turn), add_shapes(*shapes, flocks(style), turn)};
        shapes->streaks = streak_shapes(style, turn);
        shapes_ = std::move(shapes);
        style_ = style;
        turn_ = turn;
    }
    return shapes_;
}

std::optional<CloudPlan> plan_clouds(const CloudStyle& style, const CloudView& view, CloudMemory& memory)
{
    if (style.coverage <= 0.0F && style.flocks <= 0.0F && style.streaks <= 0.0F) {
        return std::nullopt;
    }
    CloudPlan plan{.shapes = memory.shapes(style, turn_of(style, view.time_s))};
    add_kind(plan, heaps(style), plan.shapes->layers[0], style, view);
    add_kind(plan, flocks(style), plan.shapes->layers[1], style, view);
    add_streaks(plan, style, view);
    shared::CloudGlobals& globals = plan.globals;
    if (globals.puff_layer_count == 0 && plan.variant == 0) {
        return std::nullopt;
    }
    plan.variant |= style.hatch > 0.0F ? shared::clouds_have_hatching : 0U;
    const glm::vec2 along(wind_of(style, view.time_s).along);
    const glm::vec3 sun = glm::normalize(view.towards_sun);
    globals.along_wind = along;
    globals.towards_sun = {sun.x * along.x + sun.z * along.y, sun.y, sun.z * along.x - sun.x * along.y};
    set_colors(globals, style, view);
    globals.shade_below = style.tones > 1 ? 1.6F * style.shade - 0.9F : -2.0F;
    globals.middle_band = style.tones > 2 ? 0.4F : 0.0F;
    globals.outline_px = style.outline_mm * view.pixels_per_mm;
    globals.broken = style.broken;
    globals.hatch_darkness = style.hatch;
    globals.hatch_width_px = style.hatch_mm * view.pixels_per_mm;
    globals.reach_m = style.reach_m;
    return plan;
}

CloudedSky add_clouds(gpu::Graph& graph, const CloudInputs& in, const Sky& sky)
{
    auto pass = graph.compute("clouds", shaders::clouds_comp);
    pass.uniform(in.frame).uniform(in.clouds.globals);
    pass.sample(in.clouds.starts, gpu::Format::r32ui).sample(in.clouds.puffs, gpu::Format::rgba32f);
    pass.sample(in.clouds.streaks, gpu::Format::r32f);
    const gpu::ImageId wash = pass.modify(sky.wash);
    const gpu::ImageId ink = pass.modify(sky.ink);
    const glm::uvec2 cover_px = in.keeps_cover ? in.size_px : glm::uvec2(1);
    const gpu::ImageId cover = pass.write(graph.image(
        "clouds/cover", {.width = cover_px.x, .height = cover_px.y, .format = gpu::Format::r16f}));
    pass.read(in.tiles.value_or(in.clouds.globals)).sample(in.depth);
    pass.variant(in.variant | (in.keeps_cover ? shared::clouds_keep_cover : 0U) |
                 (in.tiles ? shared::clouds_have_tiles : 0U) | (in.far_m ? shared::clouds_have_depth : 0U) |
                 (in.by_groups ? shared::clouds_by_groups : 0U));
    pass.push(shared::CloudCover{.far_m = in.far_m.value_or(0.0F)});
    if (in.tiles) {
        pass.dispatch_indirect(*in.tiles);
    } else {
        pass.dispatch_over(in.size_px.x, in.size_px.y);
    }
    return {{wash, ink}, cover};
}

gpu::ImageId add_cloud_shadow(gpu::Graph& graph, const CloudShadowInputs& in, float strength)
{
    auto pass = graph.compute("clouds/shadow", shaders::cloud_shadow_comp);
    pass.uniform(in.frame).uniform(in.clouds.globals);
    pass.sample(in.clouds.starts, gpu::Format::r32ui).sample(in.clouds.puffs, gpu::Format::rgba32f);
    pass.sample(in.depth).sample(in.share.value_or(in.depth));
    const gpu::ImageId share = pass.write(graph.image(
        "clouds/share", {.width = in.size_px.x, .height = in.size_px.y, .format = gpu::Format::r16f}));
    pass.push(shared::CloudShadow{.strength = strength}).variant(in.share ? shared::clouds_have_share : 0U);
    pass.dispatch_over(in.size_px.x, in.size_px.y);
    return share;
}

} // namespace estampe::sky
