// SPDX-License-Identifier: MIT
#include "techniques/occlusion/discs/disc_map.hpp"

#include "gpu/imports.hpp"
#include "shaders/disc_map_gather_comp.hpp"
#include "shaders/disc_map_page_comp.hpp"
#include "techniques/occlusion/discs/disc_passes.hpp"

namespace estampe::occlusion {

DiscMapBuffers make_disc_map(gpu::Device& device, uint32_t size)
{
    DiscMapBuffers map;
    map.found =
        gpu::Buffer(device, "open of texels", sizeof(glm::vec4) * size * size, gpu::MemoryUse::device);
    map.size = size;
    return map;
}

gpu::BufferId add_disc_map(gpu::Graph& graph, DiscBuffers& discs, DiscMapBuffers& map,
                           const DiscMapInputs& in, const DiscSettings& settings)
{
    const gpu::BufferId found = gpu::import_whole(graph, "open of texels", map.found);
    if (map.is_found && map.radius_m == settings.radius_m && (map.has_thrown || !settings.throws)) {
        return found;
    }
    const shared::DiscConstants constants = constants_of(discs.disc_count, settings);
    const gpu::BufferId tree = add_disc_tree(graph, discs, in.posed_vertices, constants);
    auto gather = graph.compute("occlusion/texels", shaders::disc_map_gather_comp);
    gather.sample(in.map_texels).sample(in.triangles).sample(in.posed_vertices);
    gather.sample(tree, gpu::Format::rgba32f);
    gather.sample(gpu::import_whole(graph, "colors of discs", discs.colors), gpu::Format::rgba32f);
    const gpu::BufferId written = gather.write(found);
    gather.variant(settings.throws ? shared::discs_throw : 0U);
    gather.push(constants).dispatch_items(map.size * map.size);
    map.is_found = true;
    map.has_thrown = settings.throws;
    map.radius_m = settings.radius_m;
    return written;
}

OpenPage add_disc_map_page(gpu::Graph& graph, const DiscMapPageInputs& in, const OcclusionStyle& style)
{
    struct Constants {
        float strength;
        float bleeding;
        int32_t size;
    };

    auto pass = graph.compute("occlusion/page", shaders::disc_map_page_comp);
    pass.uniform(in.frame).sample(in.visibility, gpu::Format::rg32ui);
    pass.sample(in.triangles).sample(in.posed_vertices);
    pass.sample(in.map_corners, gpu::Format::rg32ui).sample(in.found, gpu::Format::rgba32f);
    const OpenPage page = write_page(graph, pass, in.size_px, in.throws);
    pass.push(Constants{style.strength, style.bleeding, static_cast<int32_t>(in.map_size)});
    pass.dispatch_over(in.size_px.x, in.size_px.y);
    return page;
}

} // namespace estampe::occlusion
