// SPDX-License-Identifier: MIT
#include "techniques/subsurface/subsurface.hpp"

#include <algorithm>
#include <cmath>

#include "gpu/fills.hpp"
#include "shaders/exit_comp.hpp"
#include "shaders/scatter_blur_comp.hpp"
#include "shaders/scatter_page_comp.hpp"
#include "shaders/scatter_source_comp.hpp"
#include "shaders/through_comp.hpp"
#include "shaders/tile_list.glsl.h"

namespace estampe::subsurface {
namespace {

/// How far off the page the light of a pixel spreads over so many levels.
uint32_t reach_of_levels(uint32_t levels)
{
    constexpr uint32_t neighbours_px = 4;
    return 4U * ((1U << levels) - 1U) + neighbours_px;
}

/// As many as the style's reach has room for.
uint32_t levels_within(float reach_mm, float pixels_per_mm)
{
    uint32_t levels = 1;
    while (levels < shared::most_scatter_levels &&
           static_cast<float>(reach_of_levels(levels + 1)) <= reach_mm * pixels_per_mm + 4.0F) {
        ++levels;
    }
    return levels;
}

/// The d of the profile whose tail the widest of so many blurs holds.
float most_spread_px(uint32_t levels)
{
    const double blurred = 4.0 * (std::exp2(2.0 * levels) - 1.0) / 3.0;
    return 0.25F * static_cast<float>(std::sqrt(blurred + 0.85));
}

float widest(const SubsurfaceStyle& style)
{
    return std::max({style.scatter_color.x, style.scatter_color.y, style.scatter_color.z});
}

/// Binds looks and numbers of looks; the variant says whether there are any.
uint32_t bind_looks(gpu::Pass& pass, const SubsurfaceInputs& in)
{
    pass.sample(in.looks, gpu::Format::rgba32f);
    pass.sample(in.look_of_draw.value_or(in.looks), gpu::Format::r32ui);
    return in.look_of_draw ? shared::subsurface_has_looks : 0U;
}

} // namespace

shared::SubsurfaceLook look_of(const SubsurfaceStyle& style)
{
    shared::SubsurfaceLook look{};
    if (style.depth_m > 0.0F) {
        look.absorbed_per_m = -glm::log(glm::max(style.tint, 1e-4F)) / style.depth_m;
    }
    look.strength = shines(style) ? style.strength : 0.0F;
    look.behind = is_clear(style) ? style.behind : 0.0F;
    look.behind_blur = style.behind_blur;
    if (scatters(style)) {
        look.scatter_m = style.scatter_m * style.scatter_color;
    }
    look.sheet_m = style.sheet_m;
    return look;
}

bool shines(const SubsurfaceStyle& style)
{
    return style.drawn && style.depth_m > 0.0F && style.strength > 0.0F;
}

bool scatters(const SubsurfaceStyle& style)
{
    return style.drawn && style.scatter_m * widest(style) > 0.0F;
}

bool is_clear(const SubsurfaceStyle& style)
{
    return style.drawn && style.behind > 0.0F;
}

uint32_t reach_px(const SubsurfaceStyle& style, float pixels_per_mm)
{
    const bool has_reach = (scatters(style) && style.space == Space::page) || is_clear(style);
    return has_reach ? reach_of_levels(levels_within(style.reach_mm, pixels_per_mm)) : 0U;
}

FarSide add_far_side(gpu::Graph& graph, const SubsurfaceInputs& in, gpu::BufferId behind,
                     gpu::BufferId triangles, gpu::BufferId posed_vertices)
{
    const auto image = [&](const char* name, gpu::Format format) {
        return graph.image(name, {.width = in.size_px.x, .height = in.size_px.y, .format = format});
    };
    const glm::uvec2 tiles_across = (in.size_px + 7U) / 8U;
    const uint64_t words = shared::tile_list_first + uint64_t{tiles_across.x} * tiles_across.y;
    const gpu::BufferId no_tiles =
        gpu::add_empty_list(graph, "subsurface/far tiles", (sizeof(uint32_t) * words + 15) / 16 * 16);
    auto pass = graph.compute("subsurface/exit", shaders::exit_comp);
    pass.uniform(in.frame).sample(in.draw).sample(in.depth).sample(in.normal);
    pass.sample(behind, gpu::Format::rg32ui).sample(triangles).sample(posed_vertices);
    pass.variant(bind_looks(pass, in));
    const gpu::ImageId draw = pass.write(image("subsurface/far draw", gpu::Format::r32ui));
    const gpu::ImageId depth = pass.write(image("subsurface/far depth", gpu::Format::r32f));
    const gpu::ImageId normal = pass.write(image("subsurface/far normal", gpu::Format::rg32ui));
    const gpu::BufferId tiles = pass.modify(no_tiles);
    pass.dispatch_over(in.size_px.x, in.size_px.y);
    return {draw, depth, normal, tiles};
}

gpu::ImageId add_through(gpu::Graph& graph, const SubsurfaceInputs& in, const FarSide& far_side,
                         gpu::ImageId far_light, gpu::ImageId light)
{
    auto pass = graph.compute("subsurface/through", shaders::through_comp);
    pass.uniform(in.frame).sample(far_side.draw).sample(in.depth).sample(far_side.depth).sample(far_light);
    pass.variant(bind_looks(pass, in));
    const gpu::ImageId sum = pass.modify(light);
    pass.read(far_side.tiles).dispatch_indirect(far_side.tiles);
    return sum;
}

gpu::ImageId add_scatter(gpu::Graph& graph, const SubsurfaceInputs& in, gpu::ImageId light)
{
    const glm::uvec2 from_half = (in.from_px + 1U) / 2U;
    const glm::uvec2 last_half = (in.from_px + in.size_px - 1U) / 2U;
    const uint32_t levels = levels_within(in.reach_mm, in.pixels_per_mm);
    shared::ScatterConstants constants{.from_half = from_half,
                                       .half_px = glm::max(last_half + 1U, from_half + 1U) - from_half,
                                       .most_px = most_spread_px(levels),
                                       .level = static_cast<int>(levels),
                                       .is_last = 0U};
    const auto half_image = [&](const char* name) {
        return graph.image(
            name,
            {.width = constants.half_px.x, .height = constants.half_px.y, .format = gpu::Format::rgba32f});
    };
    const gpu::BufferId none = gpu::add_zeros(graph, "subsurface/needs", sizeof(glm::uvec4) * (levels + 1));
    auto source = graph.compute("subsurface/source", shaders::scatter_source_comp);
    source.uniform(in.frame).sample(in.draw).sample(in.depth).sample(light);
    source.variant(bind_looks(source, in));
    gpu::ImageId blurred = source.write(half_image("subsurface/source"));
    const gpu::ImageId spread = source.write(half_image("subsurface/spread"));
    gpu::ImageId sum = source.write(half_image("subsurface/sum"));
    const gpu::BufferId needs = source.modify(none);
    source.push(constants).dispatch_over(constants.half_px.x, constants.half_px.y);
    for (uint32_t level = 0; level < levels; ++level) {
        constants.level = static_cast<int>(level);
        constants.is_last = level + 1 == levels ? 1U : 0U;
        for (const bool is_upright : {false, true}) {
            auto pass = graph.compute(is_upright ? "subsurface/columns" : "subsurface/rows",
                                      shaders::scatter_blur_comp);
            pass.uniform(in.frame).sample(spread).sample(blurred);
            pass.variant(is_upright ? shared::subsurface_is_upright : 0U);
            blurred = pass.write(half_image("subsurface/blurred"));
            sum = pass.modify(sum);
            pass.push(constants).dispatch_indirect(needs, sizeof(glm::uvec4) * (level + 1));
        }
    }
    auto pass = graph.compute("subsurface/page", shaders::scatter_page_comp);
    pass.uniform(in.frame).sample(in.draw).sample(in.depth).sample(sum);
    pass.variant(bind_looks(pass, in));
    const gpu::ImageId result = pass.modify(light);
    pass.push(constants).dispatch_indirect(needs);
    return result;
}

} // namespace estampe::subsurface
