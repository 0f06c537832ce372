// SPDX-License-Identifier: MIT
#include "techniques/shadow/heightfield/height_shadow.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <stdexcept>

#include "shaders/height_climb_comp.hpp"
#include "shaders/height_level_comp.hpp"
#include "shaders/height_pyramid_comp.hpp"
#include "shaders/height_resolve_comp.hpp"
#include "shaders/height_sweep_comp.hpp"
#include "techniques/shadow/alternatives/march.hpp"
#include "techniques/shadow/heightfield/height_fields.hpp"

namespace estampe::shadow {

HeightFields height_fields_of(const gpu::Graph& graph, const HeightShadowInputs& in)
{
    const gpu::ImageDesc& height = graph.describe(in.height);
    const auto count = static_cast<uint32_t>(in.texel_m.size());
    const glm::uvec2 size(height.width, height.height / std::max(count, 1U));
    if (count == 0 || std::min(size.x, size.y) < 2 || std::max(size.x, size.y) > 16384 ||
        size.y * count != height.height) {
        throw std::logic_error("a height shadow takes fields of 2 x 2 to 16384 x 16384 texels");
    }
    const glm::dvec2 level(in.towards_sun.x, in.towards_sun.z);
    const double length = glm::length(level);
    return {.size = size,
            .count = count,
            .sunwards = length > 1e-9 ? level / length : glm::dvec2(1.0, 0.0),
            .elevation_rad = std::atan2(in.towards_sun.y, length),
            .sun = {.cos_elevation = static_cast<float>(length),
                    .sin_elevation = static_cast<float>(in.towards_sun.y),
                    .radius_rad = static_cast<float>(in.sun_radius_rad)}};
}

gpu::ImageId height_result(gpu::Graph& graph, const char* name, const HeightFields& fields)
{
    return graph.image(
        name, {.width = fields.size.x, .height = fields.count * fields.size.y, .format = gpu::Format::r16f});
}

namespace {

/// The number that is written per texel: the sun's visibility, or the horizon's height above the sun.
enum class Written : uint32_t { visibility, horizon };

/// Most loop rounds per line in one dispatch, including rounds that remove steps from the line's convex hull.
/// The limit exists because lavapipe stops a thread after 65535 rounds.
constexpr uint32_t steps_a_dispatch = 2048;

shared::SweepConstants sweep_constants(const HeightFields& fields)
{
    const bool along_y = std::abs(fields.sunwards.y) > std::abs(fields.sunwards.x);
    const double along = along_y ? fields.sunwards.y : fields.sunwards.x;
    const double across = along_y ? fields.sunwards.x : fields.sunwards.y;
    const double slope = -across / std::abs(along);
    return {.size = fields.size,
            .steps_along_y = along_y ? 1U : 0U,
            .from_far_end = along > 0.0 ? 1U : 0U,
            .slope = static_cast<int>(std::lround(slope * 65536.0)),
            .step_texels = static_cast<float>(std::sqrt(1.0 + slope * slope))};
}

gpu::ImageId add_sweep(gpu::Graph& graph, const HeightShadowInputs& in, const HeightFields& fields,
                       Written written)
{
    shared::SweepConstants sweep = sweep_constants(fields);
    const bool along_y = sweep.steps_along_y != 0;
    const uint32_t steps = along_y ? fields.size.y : fields.size.x;
    const uint32_t across = along_y ? fields.size.x : fields.size.y;
    const auto moved = static_cast<uint32_t>((std::abs(sweep.slope) * static_cast<int>(steps - 1) >> 16) + 1);
    gpu::BufferId seen = graph.buffer(
        "height shadow/seen", {.size_bytes = sizeof(uint32_t) * fields.count * steps * (across + 1ULL)});
    for (uint32_t first = 0; first < steps; first += steps_a_dispatch) {
        sweep.first_step = first;
        sweep.end_step = std::min(first + steps_a_dispatch, steps);
        auto pass = graph.compute("height shadow/sweep", shaders::height_sweep_comp);
        pass.sample(in.height);
        seen = first == 0 ? pass.write(seen) : pass.modify(seen);
        pass.push(sweep).dispatch((across + moved) / 64 + 1, 1, fields.count);
    }
    auto pass = graph.compute("height shadow/resolve", shaders::height_resolve_comp);
    pass.sample(in.height).read(seen);
    const gpu::ImageId result = pass.write(height_result(graph, "height shadow", fields));
    pass.variant(static_cast<uint32_t>(written));
    shared::ResolveConstants constants{.sweep = sweep, .sun = fields.sun};
    std::ranges::copy(in.texel_m, constants.texel_m);
    pass.push(constants).dispatch_over(fields.size.x, fields.size.y, fields.count);
    return result;
}

/// Range of horizon slopes that affect the result.
glm::vec2 slopes_that_matter(const HeightFields& fields, double radius_rad, Written written)
{
    const auto slope = [](double rad) {
        return rad < 1.57 ? std::clamp(static_cast<float>(std::tan(rad)), 0.0F, steepest_slope)
                          : steepest_slope;
    };
    // A shadow edge runs between a texel whose horizon is below the sun and a texel whose horizon is above.
    // Horizons far from the sun hardly move the edge.
    const double reach_rad = written == Written::horizon ? std::max(0.15, 16.0 * radius_rad) : radius_rad;
    return {slope(std::max(fields.elevation_rad - reach_rad, 0.0)),
            slope(std::max(fields.elevation_rad + reach_rad, 0.0))};
}

gpu::ImageId add_pyramid(gpu::Graph& graph, const HeightShadowInputs& in, const HeightFields& fields,
                         Written written)
{
    const glm::uvec2 cells = fields.size - 1U;
    const uint32_t rows = std::bit_ceil(cells.y);
    const auto topmost =
        static_cast<uint32_t>(std::min(std::bit_width(std::max(cells.x, cells.y)), std::bit_width(rows)) - 1);
    shared::PyramidConstants pyramid{.cells = cells,
                                     .rows = rows,
                                     .sunwards = glm::vec2(fields.sunwards),
                                     .slopes = slopes_that_matter(fields, in.sun_radius_rad, written),
                                     .sun = fields.sun,
                                     .wanted = in.wanted};
    std::ranges::copy(in.texel_m, pyramid.texel_m);
    auto base = graph.compute("height shadow/pyramid", shaders::height_pyramid_comp);
    base.sample(in.height);
    gpu::ImageId greatest = base.write(graph.image(
        "height shadow/greatest",
        {.width = cells.x + (cells.x + 1) / 2, .height = fields.count * rows, .format = gpu::Format::r32f}));
    base.push(pyramid).dispatch_over_page(cells.x, cells.y, fields.count);
    for (pyramid.level = 1; pyramid.level <= topmost; ++pyramid.level) {
        auto pass = graph.compute("height shadow/pyramid", shaders::height_level_comp);
        greatest = pass.modify(greatest);
        pass.push(pyramid).dispatch_over(((cells.x - 1) >> pyramid.level) + 1,
                                         ((cells.y - 1) >> pyramid.level) + 1, fields.count);
    }
    pyramid.level = topmost;
    auto pass = graph.compute("height shadow/climb", shaders::height_climb_comp);
    pass.sample(in.height).sample(greatest);
    const gpu::ImageId result = pass.write(height_result(graph, "height shadow", fields));
    pass.variant(static_cast<uint32_t>(written));
    pass.push(pyramid).dispatch_over_page(fields.size.x, fields.size.y, fields.count);
    return result;
}

} // namespace

gpu::ImageId add_height_shadow(gpu::Graph& graph, const HeightShadowInputs& in,
                               const HeightShadowStyle& style)
{
    const HeightFields fields = height_fields_of(graph, in);
    switch (style.method) {
    case HeightMethod::sweep:
        return add_sweep(graph, in, fields, Written::visibility);
    case HeightMethod::pyramid:
        return add_pyramid(graph, in, fields, Written::visibility);
    case HeightMethod::above:
        return add_blur(graph, in, fields, style, add_pyramid(graph, in, fields, Written::visibility));
    case HeightMethod::march:
        break;
    }
    return add_march(graph, in, fields, style);
}

gpu::ImageId add_height_horizon(gpu::Graph& graph, const HeightShadowInputs& in,
                                const HeightShadowStyle& style)
{
    const HeightFields fields = height_fields_of(graph, in);
    if (blurs(style.method)) {
        throw std::logic_error("a blurred shadow of heights knows no horizon");
    }
    return style.method == HeightMethod::sweep ? add_sweep(graph, in, fields, Written::horizon)
                                               : add_pyramid(graph, in, fields, Written::horizon);
}

} // namespace estampe::shadow
