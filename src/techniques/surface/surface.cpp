// SPDX-License-Identifier: MIT
#include "techniques/surface/surface.hpp"

#include "gpu/transfers.hpp"
#include "shaders/far_tiles_comp.hpp"
#include "shaders/resolve_comp.hpp"
#include "shaders/shade.glsl.h"
#include "shaders/shade_comp.hpp"
#include "shaders/shade_tiles_comp.hpp"
#include "shaders/stroke_kind.glsl.h"
#include "techniques/surface/resolve_variant.glsl.h"
#include "techniques/surface/shade.glsl.h"

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

gpu::ImageId add_shade(gpu::Graph& graph, const ShadeInputs& in)
{
    gpu::ImageId image = graph.image(
        "surface/shade", {.width = in.size_px.x, .height = in.size_px.y, .format = gpu::Format::rgba16f});
    std::optional<gpu::BufferId> tiles;
    if (in.lists_tiles) {
        const glm::uvec2 tile_count = (in.size_px + 7U) / 8U;
        const gpu::BufferId none = gpu::add_empty_tile_list(graph, "tiles in shade", in.size_px);
        auto listing = graph.compute("surface/shade tiles", shaders::shade_tiles_comp);
        listing.sample(in.draw).sample(in.records);
        tiles = listing.modify(none);
        listing.push(in.size_px).dispatch_over(tile_count.x, tile_count.y);
        image = gpu::add_fill(graph, "surface/shade blank", image,
                              glm::vec4(0.0F, 0.0F, 0.0F, shared::shade_absent));
    }
    auto pass = graph.compute("surface/shade", shaders::shade_comp);
    pass.uniform(in.frame).sample(in.visibility, gpu::Format::rg32ui);
    pass.sample(in.triangles).sample(in.posed_vertices).sample(in.draws);
    pass.sample(in.rest_vertices).sample(in.records);
    for (const gpu::ImageId texture : in.textures) {
        pass.sample(texture, gpu::Sampling::linear_repeat);
    }
    pass.sample(in.pictures.value_or(in.textures.front()), gpu::Sampling::linear_repeat);
    pass.sample(in.normal).sample(in.sun);
    const gpu::ImageId shade = tiles ? pass.modify(image) : pass.write(image);
    pass.read(tiles.value_or(in.visibility));
    pass.variant(in.texture_classes | (in.pictures ? shared::shade_has_pictures : 0U) |
                 (in.has_steps ? shared::shade_has_steps : 0U) | (tiles ? shared::shade_has_tiles : 0U));
    pass.push(shared::ShadeConstants{.towards_sun = in.towards_sun});
    if (tiles) {
        pass.dispatch_indirect(*tiles);
    } else {
        pass.dispatch_over(in.size_px.x, in.size_px.y);
    }
    return shade;
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
