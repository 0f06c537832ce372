// SPDX-License-Identifier: MIT
#include "techniques/subsurface/subsurface.hpp"

#include <algorithm>
#include <cmath>

#include "gpu/transfers.hpp"
#include "shaders/behind_halve_comp.hpp"
#include "shaders/behind_inside_comp.hpp"
#include "shaders/behind_lay_bent_comp.hpp"
#include "shaders/behind_lay_comp.hpp"
#include "shaders/bend_lines_comp.hpp"
#include "shaders/exit_comp.hpp"
#include "shaders/refract_comp.hpp"
#include "shaders/scatter_blur_comp.hpp"
#include "shaders/scatter_blur_tile_comp.hpp"
#include "shaders/scatter_page_comp.hpp"
#include "shaders/scatter_source_comp.hpp"
#include "shaders/texture_blur_comp.hpp"
#include "shaders/texture_page_comp.hpp"
#include "shaders/texture_source_comp.hpp"
#include "shaders/texture_surface_comp.hpp"
#include "shaders/tiles.glsl.h"
#include "style/parameter.hpp"

namespace estampe::subsurface {

const style::Table<SubsurfaceStyle>& subsurface_table()
{
    static const auto table =
        style::Table<SubsurfaceStyle>(
            "subsurface",
            "Subsurface scattering: light that enters skin, wax, leaves or glass and comes out elsewhere")
            .toggle("enabled", &SubsurfaceStyle::enabled,
                    "Turns subsurface scattering on: light spreads under skin or wax and shines through thin "
                    "parts")
            .number(
                "scatter_m", &SubsurfaceStyle::scatter_m, {0.0F, 1e4F}, "m",
                "How far light spreads under a surface, as in skin or wax: more looks more like wax. Half of "
                "the light comes out again within 1.5 times this distance. 0 does not spread light.")
            .color("scatter_color", &SubsurfaceStyle::scatter_color,
                   "How far red, green and blue light spread, as factors of subsurface.scatter_m. A reddish "
                   "colour gives shadows red edges, as on skin.")
            .number("depth_m", &SubsurfaceStyle::depth_m, {0.0F, 1e4F}, "m",
                    "Thickness of material after which white light has the colour subsurface.tint. More lets "
                    "more light through thick parts. 0 lets no light through.")
            .color("tint", &SubsurfaceStyle::tint,
                   "Colour of light that shines through thin parts, such as red in an ear. White light gets "
                   "exactly this colour in material as thick as subsurface.depth_m.")
            .number("strength", &SubsurfaceStyle::strength, {0.0F, 8.0F}, "",
                    "Brightness of light that shines through thin parts, such as ears or leaves. 0 is none, "
                    "1 is as much light as falls on the far side, more is brighter.")
            .number("sheet_m", &SubsurfaceStyle::sheet_m, {0.0F, 1e4F}, "m",
                    "Assumed thickness of surfaces that have only one side, such as leaves: more lets less "
                    "light through")
            .number("behind", &SubsurfaceStyle::behind, {0.0F, 1.0F}, "",
                    "How clearly one sees through an object. 0 shows nothing, as with wax; 1 shows "
                    "everything behind the object in the colour subsurface.tint, as with coloured glass.")
            .number("behind_blur", &SubsurfaceStyle::behind_blur, {0.0F, 8.0F}, "",
                    "How blurred things look when seen through a see-through object. 0 is clear glass, more "
                    "is frosted glass. A thicker object blurs more.")
            .choice(
                "refraction", &SubsurfaceStyle::refraction,
                {{"none", Refraction::none}, {"thick", Refraction::thick}},
                "How see-through objects deform what is behind them. none: not at all; thick: light bends "
                "at the front and the back of the object, as in a lens or a glass ball. Lines behind the "
                "object are bent, too.")
            .number("ior", &SubsurfaceStyle::ior, {1.0F, 4.0F}, "",
                    "Index of refraction: how strongly a see-through object bends light. 1 is air, 1.33 "
                    "water, 1.5 glass, 2.4 diamond. Glass of a glTF file has its own index. Only used when "
                    "subsurface.refraction is thick.")
            .number(
                "refraction_mm", &SubsurfaceStyle::refraction_mm, {0.1F, 200.0F}, "mm",
                "Largest distance on the page by which see-through objects shift what is behind them. "
                "More is right for large balls and lenses. Only used when subsurface.refraction is thick.")
            .toggle("transmission", &SubsurfaceStyle::transmission,
                    "If true, glass-like materials of a glTF file (transmission and volume) are see-through. "
                    "If false, they are opaque. A value of subsurface.behind in the style replaces what the "
                    "file says.")
            .number("reach_mm", &SubsurfaceStyle::reach_mm, {0.1F, 200.0F}, "mm",
                    "Largest distance on the page over which light spreads under a surface. Near the camera, "
                    "wider spreading is limited to this length: more keeps skin soft in close-ups.")
            .choice("space", &SubsurfaceStyle::space, {{"page", Space::page}, {"texture", Space::texture}},
                    "Where the spreading of light under surfaces is computed. page: between visible pixels; "
                    "texture: over all surfaces of the model, so that light also comes from hidden parts.")
            .integer("texels", &SubsurfaceStyle::texels, {64, 4096}, "texels",
                     "Width and height of the texture (image) in which the light under surfaces is computed. "
                     "More is finer and slower. Only used when subsurface.space is texture.")
            .by_surface_but({"reach_mm", "space", "texels", "refraction", "refraction_mm"});
    return table;
}

namespace {

/// Tangent of the angle by which glass of roughness 1 scatters the background, at a refractive index of 1.5.
constexpr float rough_blur = 0.5F;

/// Distance in pixels from which light reaches a pixel with `levels` blur levels.
uint32_t reach_of_levels(uint32_t levels)
{
    constexpr uint32_t neighbours_px = 4;
    return 4U * ((1U << levels) - 1U) + neighbours_px;
}

/// Number of blur levels that the style's reach allows.
uint32_t levels_within(float reach_mm, float pixels_per_mm)
{
    uint32_t levels = 1;
    while (levels < shared::most_scatter_levels &&
           static_cast<float>(reach_of_levels(levels + 1)) <= reach_mm * pixels_per_mm + 4.0F) {
        ++levels;
    }
    return levels;
}

/// Largest scattering distance d whose diffusion profile fits in `levels` blur levels.
float most_spread_px(uint32_t levels)
{
    const double blurred = 4.0 * (std::exp2(2.0 * levels) - 1.0) / 3.0;
    return 0.25F * static_cast<float>(std::sqrt(blurred + 0.85));
}

float widest(const SubsurfaceStyle& style)
{
    return std::max({style.scatter_color.x, style.scatter_color.y, style.scatter_color.z});
}

/// Binds the parameter sets and the set number of each draw call. Returns the bit of `variant` for several
/// sets.
uint32_t bind_variants(gpu::Pass& pass, const SubsurfaceInputs& in)
{
    pass.sample(in.parameters, gpu::Format::rgba32f);
    pass.sample(in.variant_of_draw.value_or(in.parameters), gpu::Format::r32ui);
    return in.variant_of_draw ? shared::subsurface_has_variants : 0U;
}

/// Bits of `variant` for the device's way of reading neighbours, and for the projection.
uint32_t looking(const SubsurfaceInputs& in)
{
    return (in.execution.looks_only_where_needed() ? shared::subsurface_looks_less : 0U) |
           (in.in_perspective ? shared::subsurface_in_perspective : 0U);
}

/// Shader constants for `levels` blur levels.
shared::ScatterConstants constants_of(const SubsurfaceInputs& in, uint32_t levels)
{
    return {.from_half = (in.from_px + 1U) / 2U,
            .half_px = in.half_px(),
            .most_px = most_spread_px(levels),
            .level = static_cast<int>(levels),
            .is_last = 0U};
}

/// Outputs of the source pass: light of the half page (every second pixel), the share that stays in place,
/// and the dispatch sizes of the blurs.
struct Source {
    gpu::ImageId light;
    gpu::ImageId spread;
    gpu::ImageId sum;
    gpu::BufferId needs;
    uint64_t needs_bytes; ///< offset in bytes of the dispatch sizes in the buffer `needs`
};

/// Adds one blur, or one direction of a blur, and returns the blurred light. `constants` select the blur.
gpu::ImageId add_blur(gpu::Pass pass, gpu::Graph& graph, const SubsurfaceInputs& in,
                      const shared::ScatterConstants& constants, Source& source)
{
    pass.uniform(in.frame).sample(source.spread).sample(source.light);
    const gpu::ImageId blurred = pass.write(graph.image(
        "subsurface/blurred",
        {.width = constants.half_px.x, .height = constants.half_px.y, .format = gpu::Format::rgba32f}));
    source.sum = pass.modify(source.sum);
    const auto level = static_cast<uint32_t>(constants.level);
    pass.push(constants).dispatch_indirect(source.needs, source.needs_bytes + sizeof(glm::uvec4) * level);
    return blurred;
}

/// Adds all blurs of a source and returns their sum. `constants.level` is the largest number of blurs.
gpu::ImageId add_blurs(gpu::Graph& graph, const SubsurfaceInputs& in, shared::ScatterConstants constants,
                       Source source)
{
    const int levels = constants.level;
    for (int level = 0; level < levels; ++level) {
        constants.level = level;
        constants.is_last = level + 1 == levels ? 1U : 0U;
        if (in.execution.shares_by_groups()) {
            auto pass = graph.compute("subsurface/blur", shaders::scatter_blur_tile_comp);
            source.light = add_blur(pass, graph, in, constants, source);
            continue;
        }
        for (const bool is_upright : {false, true}) {
            auto pass = graph.compute(is_upright ? "subsurface/columns" : "subsurface/rows",
                                      shaders::scatter_blur_comp);
            pass.variant(is_upright ? shared::subsurface_is_upright : 0U);
            source.light = add_blur(pass, graph, in, constants, source);
        }
    }
    return source.sum;
}

} // namespace

shared::SubsurfaceParameters parameters_of(const SubsurfaceStyle& style)
{
    shared::SubsurfaceParameters parameters{};
    if (style.depth_m > 0.0F) {
        parameters.absorbed_per_m = -glm::log(glm::max(style.tint, 1e-4F)) / style.depth_m;
    }
    parameters.strength = shines(style) ? style.strength : 0.0F;
    parameters.behind = is_clear(style) ? style.behind : 0.0F;
    parameters.behind_blur = style.behind_blur;
    parameters.behind_tint = style.behind_tint;
    parameters.ior = refracts(style) ? style.ior : 1.0F;
    if (scatters(style)) {
        parameters.scatter_m = style.scatter_m * style.scatter_color;
    }
    parameters.sheet_m = style.sheet_m;
    return parameters;
}

SubsurfaceStyle seen_through(SubsurfaceStyle style, const Material& material, float color_share)
{
    const Transmission& seen = *material.transmission;
    style.enabled = true;
    style.scatter_m = 0.0F;
    style.strength = 0.0F; // `behind` already shows transmitted light, so none is added
    style.depth_m = seen.attenuation_m;
    style.tint = glm::mix(glm::vec3(1.0F), seen.attenuation_color, color_share);
    style.sheet_m = seen.thickness_m;
    style.behind = seen.share * (1.0F - material.metallic); // metals are opaque, so they show no background
    style.behind_blur = rough_blur * material.roughness * material.roughness;
    style.behind_tint = color_share;
    style.ior = seen.ior;
    return style;
}

bool shines(const SubsurfaceStyle& style)
{
    return style.enabled && style.depth_m > 0.0F && style.strength > 0.0F;
}

bool scatters(const SubsurfaceStyle& style)
{
    return style.enabled && style.scatter_m * widest(style) > 0.0F;
}

bool is_clear(const SubsurfaceStyle& style)
{
    return style.enabled && style.behind > 0.0F;
}

bool shows_lines(const SubsurfaceStyle& style)
{
    return is_clear(style) && style.behind >= shared::least_line_share;
}

bool refracts(const SubsurfaceStyle& style)
{
    return is_clear(style) && style.refraction == Refraction::thick && style.ior > 1.0F;
}

uint32_t reach_px(const SubsurfaceStyle& style, float pixels_per_mm)
{
    const bool has_reach = (scatters(style) && style.space == Space::page) || is_clear(style);
    const uint32_t spread = has_reach ? reach_of_levels(levels_within(style.reach_mm, pixels_per_mm)) : 0U;
    if (!refracts(style)) {
        return spread;
    }
    return spread +
           static_cast<uint32_t>(std::ceil(style.refraction_mm * pixels_per_mm + shared::bent_footprint_px));
}

FarSide add_far_side(gpu::Graph& graph, const SubsurfaceInputs& in, gpu::BufferId behind,
                     gpu::BufferId triangles, gpu::BufferId posed_vertices)
{
    const shared::ScatterConstants constants = constants_of(in, 0);
    const glm::uvec2 half_px = constants.half_px;
    const auto image = [&](const char* name, gpu::Format format) {
        return graph.image(name, {.width = half_px.x, .height = half_px.y, .format = format});
    };
    const gpu::BufferId no_tiles = gpu::add_empty_tile_list(graph, "subsurface/far tiles", half_px);
    auto pass = graph.compute("subsurface/exit", shaders::exit_comp);
    pass.uniform(in.frame).sample(in.draw).sample(in.depth).sample(in.normal);
    pass.sample(behind, gpu::Format::rg32ui).sample(triangles).sample(posed_vertices);
    pass.variant(bind_variants(pass, in));
    const gpu::ImageId draw = pass.write(image("subsurface/far draw", gpu::Format::r32ui));
    const gpu::ImageId depth = pass.write(image("subsurface/far depth", gpu::Format::r32f));
    const gpu::ImageId normal = pass.write(image("subsurface/far normal", gpu::Format::rg32ui));
    const gpu::BufferId tiles = pass.modify(no_tiles);
    pass.push(constants).dispatch_over_page(half_px.x, half_px.y);
    return {draw, depth, normal, tiles};
}

gpu::ImageId add_scatter(gpu::Graph& graph, const SubsurfaceInputs& in, gpu::ImageId light,
                         const std::optional<Through>& through, bool spreads)
{
    const uint32_t levels = spreads ? levels_within(in.reach_mm, in.pixels_per_mm) : 0U;
    const shared::ScatterConstants constants = constants_of(in, levels);
    const glm::uvec2 across = (in.size_px + shared::scatter_square_px - 1U) / shared::scatter_square_px;
    const uint64_t squares = uint64_t{across.x} * across.y;
    // The buffer of squares holds the list, then the blurs' dispatch sizes, then flags of listed squares.
    const gpu::BufferId none_listed = gpu::add_empty_group_list(graph, "subsurface/squares", squares,
                                                                4U * shared::most_scatter_levels + squares);
    const uint32_t variant = (through ? shared::subsurface_shines : 0U) |
                             (spreads ? shared::subsurface_spreads : 0U) | looking(in);
    auto source = graph.compute("subsurface/source", shaders::scatter_source_comp);
    source.uniform(in.frame).sample(in.draw).sample(in.depth).sample(light);
    source.variant(variant | bind_variants(source, in));
    source.sample(through ? through->far_side.draw : in.draw);
    source.sample(through ? through->far_side.depth : in.depth).sample(through ? through->light : light);
    const auto written = [&](const char* name, gpu::Format format, bool is_wanted) {
        const glm::uvec2 size_px = is_wanted ? constants.half_px : glm::uvec2(1);
        return source.write(graph.image(name, {.width = size_px.x, .height = size_px.y, .format = format}));
    };
    const gpu::ImageId lit = written("subsurface/source", gpu::Format::rgba32f, spreads);
    const gpu::ImageId spread = written("subsurface/spread", gpu::Format::rgba16f, spreads);
    const gpu::ImageId kept = written("subsurface/sum", gpu::Format::rgba32f, true);
    const gpu::ImageId shone = written("subsurface/through", gpu::Format::rgba16f, through.has_value());
    const gpu::BufferId listed = source.modify(none_listed);
    source.push(constants).dispatch_over_page(constants.half_px.x, constants.half_px.y);
    const gpu::ImageId sum =
        add_blurs(graph, in, constants,
                  {lit, spread, kept, listed, sizeof(uint32_t) * (shared::tile_list_first + squares)});
    auto pass = graph.compute("subsurface/page", shaders::scatter_page_comp);
    pass.uniform(in.frame).sample(in.draw).sample(in.depth).sample(sum).sample(shone);
    pass.variant(variant | bind_variants(pass, in));
    const gpu::ImageId result = pass.modify(light);
    pass.read(listed).push(constants).dispatch_indirect(listed);
    return result;
}

namespace {

/// Adds passes that halve the background repeatedly. Returns it at full size, half size, quarter size and so
/// on.
std::vector<gpu::ImageId> add_halves(gpu::Graph& graph, const BehindInputs& in)
{
    std::vector<gpu::ImageId> levels{in.painted};
    glm::uvec2 size_px = in.common.size_px;
    for (size_t i = 1; i < shared::behind_levels; ++i) {
        size_px = glm::max((size_px + 1U) / 2U, glm::uvec2(1));
        auto pass = graph.compute("subsurface/halve", shaders::behind_halve_comp);
        pass.sample(levels.back());
        levels.push_back(pass.write(graph.image(
            "subsurface/halves", {.width = size_px.x, .height = size_px.y, .format = gpu::Format::rgba16f})));
        pass.dispatch_over(size_px.x, size_px.y);
    }
    return levels;
}

} // namespace

gpu::ImageId add_behind(gpu::Graph& graph, const BehindInputs& in, gpu::ImageId wash)
{
    const SubsurfaceInputs& common = in.common;
    auto inside = graph.compute("subsurface/clear", shaders::behind_inside_comp);
    inside.uniform(common.frame).sample(common.draw);
    inside.sample(common.parameters, gpu::Format::rgba32f);
    inside.sample(common.variant_of_draw.value_or(common.parameters), gpu::Format::r32ui);
    inside.sample(in.triangles).sample(in.posed_vertices);
    inside.sample(in.background, gpu::Format::rg32ui);
    for (size_t i = 0; i < inside_layers; ++i) {
        inside.sample(in.inside[std::min(i, in.inside.size() - 1)], gpu::Format::rg32ui);
    }
    inside.sample(in.color);
    const gpu::ImageId clear = inside.write(
        graph.image("subsurface/clear",
                    {.width = common.size_px.x, .height = common.size_px.y, .format = gpu::Format::rgba32f}));
    const gpu::ImageId share = inside.write(
        graph.image("subsurface/share",
                    {.width = common.size_px.x, .height = common.size_px.y, .format = gpu::Format::r16f}));
    inside.variant(common.variant_of_draw ? shared::subsurface_has_variants : 0U);
    inside.dispatch_over(common.size_px.x, common.size_px.y);

    const std::vector<gpu::ImageId> levels = add_halves(graph, in);
    auto lay = graph.compute("subsurface/behind",
                             in.bent ? shaders::behind_lay_bent_comp : shaders::behind_lay_comp);
    lay.sample(clear).sample(share);
    for (const gpu::ImageId level : levels) {
        lay.sample(level, gpu::Sampling::linear);
    }
    if (in.bent) {
        lay.sample(*in.bent);
    }
    const gpu::ImageId laid = lay.modify(wash);
    lay.push(common.reach_mm * common.pixels_per_mm / 3.0F);
    lay.dispatch_over(common.size_px.x, common.size_px.y);
    return laid;
}

gpu::ImageId add_refraction(gpu::Graph& graph, const RefractionInputs& in)
{
    const SubsurfaceInputs& common = in.common;
    auto pass = graph.compute("subsurface/refract", shaders::refract_comp);
    pass.uniform(common.frame).sample(common.draw).sample(common.normal);
    pass.variant(bind_variants(pass, common));
    pass.sample(in.triangles).sample(in.posed_vertices);
    pass.sample(in.background, gpu::Format::rg32ui);
    pass.sample(in.inside[0], gpu::Format::rg32ui).sample(in.inside[1], gpu::Format::rg32ui);
    const gpu::ImageId seen = pass.write(
        graph.image("subsurface/seen",
                    {.width = common.size_px.x, .height = common.size_px.y, .format = gpu::Format::rgba32f}));
    pass.push(in.most_mm * common.pixels_per_mm).dispatch_over(common.size_px.x, common.size_px.y);
    return seen;
}

gpu::ImageId add_bent_lines(gpu::Graph& graph, gpu::ImageId bent, gpu::ImageId behind, gpu::ImageId lines,
                            glm::uvec2 size_px)
{
    auto pass = graph.compute("subsurface/bent lines", shaders::bend_lines_comp);
    pass.sample(bent).sample(behind, gpu::Sampling::linear);
    const gpu::ImageId drawn = pass.modify(lines);
    pass.dispatch_over(size_px.x, size_px.y);
    return drawn;
}

namespace {

/// Largest scattering distance d, in texels, whose diffusion profile fits in `levels` blur levels.
float most_spread_tx(uint32_t levels)
{
    return 0.25F * static_cast<float>(std::sqrt((std::exp2(2.0 * levels) - 1.0) / 3.0));
}

uint32_t levels_for(float spread_tx)
{
    uint32_t levels = 1;
    while (levels < shared::most_texture_levels && most_spread_tx(levels) < spread_tx) {
        ++levels;
    }
    return levels;
}

shared::TextureConstants texture_constants(const TextureInputs& in)
{
    return {
        .size = in.size, .most_tx = most_spread_tx(levels_for(in.most_spread_tx)), .level = 0, .is_last = 0U};
}

gpu::ImageId map_image(gpu::Graph& graph, const TextureInputs& in, const char* name, gpu::Format format)
{
    return graph.image(name, {.width = in.size, .height = in.size, .format = format});
}

} // namespace

TextureSurface add_texture_surface(gpu::Graph& graph, const TextureInputs& in)
{
    auto pass = graph.compute("subsurface/texels", shaders::texture_surface_comp);
    pass.sample(in.map_texels).sample(in.map_corners, gpu::Format::rg32ui);
    pass.sample(in.triangles).sample(in.posed_vertices).sample(in.draws).sample(in.materials);
    const gpu::ImageId draw = pass.write(map_image(graph, in, "subsurface/map draw", gpu::Format::r32ui));
    const gpu::ImageId normal =
        pass.write(map_image(graph, in, "subsurface/map normal", gpu::Format::rg32ui));
    const gpu::ImageId points = pass.write(map_image(graph, in, "subsurface/points", gpu::Format::rgba32f));
    pass.push(texture_constants(in)).dispatch_over(in.size, in.size);
    return {draw, normal, points};
}

TextureLight add_texture_scatter(gpu::Graph& graph, const TextureInputs& in, const TextureSurface& surface,
                                 gpu::ImageId light)
{
    shared::TextureConstants constants = texture_constants(in);
    const uint32_t levels = levels_for(in.most_spread_tx);
    const auto image = [&](const char* name) { return map_image(graph, in, name, gpu::Format::rgba32f); };
    auto source = graph.compute("subsurface/map source", shaders::texture_source_comp);
    source.sample(surface.draw).sample(surface.points).sample(light);
    source.sample(in.parameters, gpu::Format::rgba32f);
    source.sample(in.variant_of_draw.value_or(in.parameters), gpu::Format::r32ui);
    source.variant(in.variant_of_draw ? shared::subsurface_has_variants : 0U);
    gpu::ImageId blurred = source.write(image("subsurface/map light"));
    const gpu::ImageId spread = source.write(image("subsurface/map spread"));
    gpu::ImageId sum = source.write(image("subsurface/map sum"));
    source.push(constants).dispatch_over(in.size, in.size);
    for (uint32_t level = 0; level < levels; ++level) {
        constants.level = static_cast<int>(level);
        constants.is_last = level + 1 == levels ? 1U : 0U;
        for (const bool is_upright : {false, true}) {
            auto pass = graph.compute(is_upright ? "subsurface/map columns" : "subsurface/map rows",
                                      shaders::texture_blur_comp);
            pass.sample(spread).sample(surface.points).sample(blurred).sample(sum);
            pass.variant(is_upright ? shared::subsurface_is_upright : 0U);
            blurred = pass.write(image("subsurface/map blurred"));
            const gpu::ImageId next_sum = pass.write(
                is_upright ? image("subsurface/map sum")
                           : graph.image("subsurface/no map sum",
                                         {.width = 1, .height = 1, .format = gpu::Format::rgba32f}));
            pass.push(constants).dispatch_over(in.size, in.size);
            sum = is_upright ? next_sum : sum;
        }
    }
    return {spread, sum};
}

gpu::ImageId add_texture_page(gpu::Graph& graph, const TextureInputs& in, const TextureLight& spread,
                              gpu::BufferId frame, gpu::BufferId visibility, gpu::ImageId light,
                              glm::uvec2 size_px)
{
    auto pass = graph.compute("subsurface/map page", shaders::texture_page_comp);
    pass.uniform(frame).sample(visibility, gpu::Format::rg32ui);
    pass.sample(in.triangles).sample(in.posed_vertices).sample(in.map_corners, gpu::Format::rg32ui);
    pass.sample(spread.spread).sample(spread.sum);
    const gpu::ImageId result = pass.modify(light);
    pass.push(texture_constants(in)).dispatch_over(size_px.x, size_px.y);
    return result;
}

} // namespace estampe::subsurface
