// SPDX-License-Identifier: MIT
#include "gpu/fills.hpp"
#include "shaders/seen_tiles_comp.hpp"
#include "techniques/raster/raster.hpp"

namespace estampe::raster {

gpu::BufferId add_seen_tiles(gpu::Graph& graph, const gpu::Name& name, gpu::BufferId visibility,
                             glm::uvec2 size_px)
{
    const glm::uvec2 tiles = (size_px + 7U) / 8U;
    const gpu::BufferId none = gpu::add_empty_tile_list(graph, "seen tiles", size_px);
    auto pass = graph.compute(name + "/tiles", shaders::seen_tiles_comp);
    pass.sample(visibility, gpu::Format::rg32ui);
    const gpu::BufferId seen = pass.modify(none);
    pass.push(size_px).dispatch_over(tiles.x, tiles.y);
    return seen;
}

} // namespace estampe::raster
