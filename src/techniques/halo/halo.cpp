// SPDX-License-Identifier: MIT
#include "techniques/halo/halo.hpp"

#include <cmath>

#include "shaders/halo.glsl.h"
#include "shaders/halo_distance_comp.hpp"
#include "shaders/halo_edges_comp.hpp"
#include "shaders/halo_things_comp.hpp"
#include "techniques/halo/halo.glsl.h"

namespace estampe::halo {

namespace {

/// Width of the widest edge of a floor that is no thing.
int edge_texels(float pixels_per_mm)
{
    constexpr float edge_mm = 1.2F;
    return static_cast<int>(std::ceil(edge_mm * pixels_per_mm / static_cast<float>(shared::halo_texel_px)));
}

} // namespace

gpu::ImageId add_distances(gpu::Graph& graph, const HaloInputs& in)
{
    // A tile of a page may begin and end within texels.
    const glm::uvec2 size = (in.size_px + 2U * (shared::halo_texel_px - 1U)) / shared::halo_texel_px;
    const gpu::ImageDesc image{.width = size.x, .height = size.y, .format = gpu::Format::r16f};
    auto things = graph.compute("halo/things", shaders::halo_things_comp);
    things.uniform(in.frame).sample(in.draw).sample(in.normal);
    gpu::ImageId distances = things.write(graph.image("halo/things", image));
    things.push(shared::HaloThingConstants{.ground_draws = in.ground_draws}).dispatch_over(size.x, size.y);
    auto edges = graph.compute("halo/edges", shaders::halo_edges_comp);
    edges.sample(distances);
    distances = edges.write(graph.image("halo/edges", image));
    edges.push(shared::HaloEdgeConstants{.size_texels = size, .reach_texels = edge_texels(in.pixels_per_mm)})
        .dispatch_over(size.x, size.y);
    for (const glm::ivec2 along : {glm::ivec2(1, 0), glm::ivec2(0, 1)}) {
        auto pass = graph.compute("halo/distance", shaders::halo_distance_comp);
        pass.sample(distances);
        distances = pass.write(graph.image("halo/distance", image));
        pass.push(shared::HaloConstants{.size_texels = size,
                                        .along = along,
                                        .reach_texels = static_cast<int>(std::ceil(
                                            in.reach_px / static_cast<float>(shared::halo_texel_px)))})
            .dispatch_over(size.x, size.y);
    }
    return distances;
}

uint32_t reach_px(float halo_mm, float pixels_per_mm)
{
    if (halo_mm <= 0.0F) {
        return 0;
    }
    // An edge is recognised by what lies beside it. Texels may begin before a tile and end behind it.
    const uint32_t texels = static_cast<uint32_t>(edge_texels(pixels_per_mm)) + 2U;
    return static_cast<uint32_t>(std::ceil(halo_mm * pixels_per_mm)) + texels * shared::halo_texel_px;
}

} // namespace estampe::halo
