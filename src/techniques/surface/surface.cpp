// SPDX-License-Identifier: MIT
#include "techniques/surface/surface.hpp"

#include "gpu/transfers.hpp"
#include "shaders/far_tiles_comp.hpp"
#include "shaders/resolve_comp.hpp"
#include "shaders/stroke_kind.glsl.h"
#include "techniques/surface/resolve_variant.glsl.h"

namespace estampe::surface {

Surface add_resolve(gpu::Graph& graph, const ResolveInputs& in)
{
    const auto image = [&](const char* name, gpu::Format format) {
        return graph.image(name, {.width = in.size_px.x, .height = in.size_px.y, .format = format});
    };
    auto pass = graph.compute("surface", shaders::resolve_comp);
    pass.uniform(in.frame).sample(in.visibility, gpu::Format::rg32ui);
    pass.sample(in.triangles).sample(in.posed_vertices).sample(in.draws);
    pass.sample(in.rest_vertices).read(in.stroke_coordinates).sample(in.materials);
    pass.read(in.stroke_kinds).read(in.form_coordinates);
    for (const gpu::ImageId texture : in.textures) {
        pass.sample(texture, gpu::Sampling::linear_repeat);
    }
    const gpu::ImageId draw = pass.write(image("surface/draw", gpu::Format::r32ui));
    const gpu::ImageId depth = pass.write(image("surface/depth", gpu::Format::r32f));
    const gpu::ImageId normal = pass.write(image("surface/normal", gpu::Format::rg32ui));
    const gpu::ImageId color = pass.write(image("surface/color", gpu::Format::rgba8));
    const gpu::ImageId coordinate = pass.write(image("surface/coordinate", gpu::Format::rgba32f));
    const gpu::ImageId footprint = pass.write(image("surface/footprint", gpu::Format::rgba32ui));
    const SceneNeeds& needs = in.needs;
    const auto has_strokes = [&](uint32_t kind) { return (in.strokes_present >> kind & 1U) != 0; };
    pass.variant(needs.texture_classes | (needs.normal_maps ? shared::resolve_has_normal_maps : 0U) |
                 (needs.vertex_colors ? shared::resolve_has_vertex_colors : 0U) |
                 (has_strokes(shared::strokes_uv) ? shared::resolve_has_uv_strokes : 0U) |
                 (needs.second_uvs ? shared::resolve_has_second_uvs : 0U) |
                 (needs.moves ? 0U : shared::resolve_stands_still) |
                 (has_strokes(shared::strokes_form) ? shared::resolve_has_form_strokes : 0U) |
                 (has_strokes(shared::strokes_page) ? shared::resolve_has_page_strokes : 0U) |
                 (needs.occlusion ? shared::resolve_has_occlusion : 0U));
    pass.push(in.strokes_per_m).dispatch_over_page(in.size_px.x, in.size_px.y);
    return {draw, depth, normal, color, coordinate, footprint};
}

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
