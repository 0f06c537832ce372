// SPDX-License-Identifier: MIT
#include "gpu/fills.hpp"
#include "shaders/far_tiles_comp.hpp"
#include "techniques/surface/surface.hpp"

namespace estampe::surface {

gpu::BufferId add_far_tiles(gpu::Graph& graph, const FarInputs& in, float from_m)
{
    const glm::uvec2 tiles = (in.size_px + 7U) / 8U;
    const gpu::BufferId none = gpu::add_empty_tile_list(graph, "far tiles", in.size_px);
    auto pass = graph.compute("surface/far tiles", shaders::far_tiles_comp);
    pass.uniform(in.frame).sample(in.depth);
    const gpu::BufferId listed = pass.modify(none);
    pass.push(from_m).dispatch_over(tiles.x, tiles.y);
    return listed;
}

} // namespace estampe::surface
