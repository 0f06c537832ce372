// SPDX-License-Identifier: MIT
#include "techniques/subsurface/subsurface.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "shaders/exit_comp.hpp"
#include "shaders/scatter_blur_comp.hpp"
#include "shaders/scatter_page_comp.hpp"
#include "shaders/scatter_source_comp.hpp"
#include "shaders/through_comp.hpp"

namespace estampe::subsurface {
namespace {

// Burley's profile along a line, found by least squares: within 0.2 % everywhere in its integral. Standard
// deviations are multiples of its d.
constexpr float kept_share = 0.07947F;
constexpr std::array<shared::ScatterLevel, shared::scatter_levels> levels{
    {{.blur = 0.4704F, .share = 0.24378F},
     {.blur = 1.5209F, .share = 0.41632F},
     {.blur = 4.3009F, .share = 0.26043F}}};

// Of the sum of all blurs, three standard deviations each.
constexpr float reach_of_d = 3.0F * (0.4704F + 1.5209F + 4.3009F);

/// Weights of the taps, which come to one: what of a Gaussian lies about each, up to the middle between it
/// and the next.
std::array<float, shared::scatter_taps + 1> weights_of(float deviation)
{
    const auto place = [](float tap) { return shared::scatter_spacing * (tap + 0.25F * tap * tap); };
    const auto below = [&](float x) {
        return 0.5F * std::erf(x / (deviation * std::numbers::sqrt2_v<float>));
    };
    std::array<float, shared::scatter_taps + 1> weights{};
    float from = 0.0F;
    for (uint32_t i = 0; i < weights.size(); ++i) {
        const auto tap = static_cast<float>(i);
        const float to = 0.5F * (place(tap) + place(tap + 1.0F));
        weights.at(i) = i == 0 ? 2.0F * below(to) : below(to) - below(from);
        from = to;
    }
    const float whole = 2.0F * below(from);
    std::ranges::for_each(weights, [&](float& weight) { weight /= whole; });
    return weights;
}

float widest(const SubsurfaceStyle& style)
{
    return std::max({style.scatter_color.x, style.scatter_color.y, style.scatter_color.z});
}

/// Binds looks and numbers of looks; the variant says whether there are any.
uint32_t bind_looks(gpu::Pass& pass, const SubsurfaceInputs& in)
{
    pass.read(in.looks).read(in.look_of_draw.value_or(in.looks));
    return in.look_of_draw ? shared::subsurface_has_looks : 0U;
}

} // namespace

shared::SubsurfaceLook look_of(const SubsurfaceStyle& style)
{
    shared::SubsurfaceLook look{};
    if (shines(style)) {
        look.strength = style.strength;
        look.absorbed_per_m = -glm::log(glm::max(style.tint, 1e-4F)) / style.depth_m;
    }
    if (scatters(style)) {
        look.scatter_m = style.scatter_m * widest(style);
        for (int channel = 0; channel < 3; ++channel) {
            const auto weights = weights_of(std::max(style.scatter_color[channel] / widest(style), 0.01F));
            for (uint32_t i = 0; i < weights.size(); ++i) {
                look.weights[i][channel] = weights.at(i);
            }
        }
    }
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

uint32_t reach_px(const SubsurfaceStyle& style, float pixels_per_mm)
{
    constexpr uint32_t neighbours_px = 4;
    return scatters(style) ? static_cast<uint32_t>(std::ceil(style.reach_mm * pixels_per_mm)) + neighbours_px
                           : 0U;
}

FarSide add_far_side(gpu::Graph& graph, const SubsurfaceInputs& in, gpu::BufferId behind,
                     gpu::BufferId triangles, gpu::BufferId posed_vertices)
{
    const auto image = [&](const char* name, gpu::Format format) {
        return graph.image(name, {.width = in.size_px.x, .height = in.size_px.y, .format = format});
    };
    auto pass = graph.compute("subsurface/exit", shaders::exit_comp);
    pass.uniform(in.frame).sample(in.draw).sample(in.depth).sample(in.normal);
    pass.sample(behind, gpu::Format::rg32ui).sample(triangles).sample(posed_vertices);
    pass.variant(bind_looks(pass, in));
    const gpu::ImageId draw = pass.write(image("subsurface/far draw", gpu::Format::r32ui));
    const gpu::ImageId depth = pass.write(image("subsurface/far depth", gpu::Format::r32f));
    const gpu::ImageId normal = pass.write(image("subsurface/far normal", gpu::Format::rg32ui));
    pass.dispatch_over(in.size_px.x, in.size_px.y);
    return {draw, depth, normal};
}

gpu::ImageId add_through(gpu::Graph& graph, const SubsurfaceInputs& in, const FarSide& far_side,
                         gpu::ImageId far_light, gpu::ImageId light)
{
    auto pass = graph.compute("subsurface/through", shaders::through_comp);
    pass.uniform(in.frame).sample(far_side.draw).sample(in.depth).sample(far_side.depth).sample(far_light);
    pass.variant(bind_looks(pass, in));
    const gpu::ImageId sum = pass.modify(light);
    pass.dispatch_over(in.size_px.x, in.size_px.y);
    return sum;
}

gpu::ImageId add_scatter(gpu::Graph& graph, const SubsurfaceInputs& in, gpu::ImageId light)
{
    const glm::uvec2 from_half = (in.from_px + 1U) / 2U;
    const glm::uvec2 last_half = (in.from_px + in.size_px - 1U) / 2U;
    shared::ScatterConstants constants{.from_half = from_half,
                                       .half_px = glm::max(last_half + 1U, from_half + 1U) - from_half,
                                       .most_px = in.reach_mm * in.pixels_per_mm / reach_of_d,
                                       .level = {},
                                       .kept = kept_share};
    const auto image = [&](const char* name, glm::uvec2 size_px) {
        return graph.image(name, {.width = size_px.x, .height = size_px.y, .format = gpu::Format::rgba32f});
    };
    const auto half_image = [&](const char* name) { return image(name, constants.half_px); };
    auto source = graph.compute("subsurface/source", shaders::scatter_source_comp);
    source.uniform(in.frame).sample(in.draw).sample(in.depth).sample(light);
    source.variant(bind_looks(source, in));
    const gpu::ImageId taken = source.write(half_image("subsurface/source"));
    const gpu::ImageId spread = source.write(half_image("subsurface/spread"));
    source.push(constants).dispatch_over(constants.half_px.x, constants.half_px.y);
    gpu::ImageId blurred = taken;
    gpu::ImageId sum = taken;
    for (const shared::ScatterLevel& level : levels) {
        constants.level = level;
        const bool is_first = &level == levels.data();
        for (const bool is_upright : {false, true}) {
            auto pass = graph.compute(is_upright ? "subsurface/columns" : "subsurface/rows",
                                      shaders::scatter_blur_comp);
            pass.uniform(in.frame).sample(spread).sample(blurred).sample(sum);
            pass.read(in.looks).read(in.looks);
            pass.variant((is_upright ? shared::subsurface_is_upright : 0U) |
                         (is_first ? shared::subsurface_is_first : 0U));
            const gpu::ImageId next = pass.write(half_image("subsurface/blurred"));
            const gpu::ImageId next_sum = pass.write(is_upright ? half_image("subsurface/sum")
                                                                : image("subsurface/no sum", glm::uvec2(1)));
            pass.push(constants).dispatch_over(constants.half_px.x, constants.half_px.y);
            blurred = next;
            sum = is_upright ? next_sum : sum;
        }
    }
    auto pass = graph.compute("subsurface/page", shaders::scatter_page_comp);
    pass.uniform(in.frame).sample(in.draw).sample(in.depth).sample(sum).sample(taken);
    pass.variant(bind_looks(pass, in));
    const gpu::ImageId result = pass.modify(light);
    pass.push(constants).dispatch_over(in.size_px.x, in.size_px.y);
    return result;
}

} // namespace estampe::subsurface
