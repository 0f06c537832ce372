// SPDX-License-Identifier: MIT
#include "features/common/surface_map.hpp"

#include <bit>
#include <optional>

#include <fmt/format.h>

#include <estampe/error.hpp>

#include "gpu/resources.hpp"
#include "scene/charts/charts.hpp"

namespace estampe::features {
namespace {

/// Returns the triangles of each draw call that are put into the texture atlas.
std::vector<std::vector<uint32_t>> triangles_of_draws(const pose::MeshData& layout)
{
    std::vector<std::vector<uint32_t>> of_draw(layout.draws.size());
    for (const uint32_t triangle : pose::solid_triangles(layout)) {
        of_draw[layout.triangles[triangle].w & shared::triangle_draw_mask].push_back(triangle);
    }
    return of_draw;
}

/// Makes a chart of the atlas from one of the file's UV sets; none if neither set is usable.
std::optional<charts::Chart> chart_of_uvs(const pose::MeshData& layout, const shared::DrawRecord& draw,
                                          const std::vector<uint32_t>& triangles,
                                          const std::vector<glm::vec3>& places)
{
    for (const bool is_second : {true, false}) {
        std::vector<glm::vec2> uvs;
        for (const uint32_t triangle : triangles) {
            for (int corner = 0; corner < 3; ++corner) {
                const uint32_t vertex = layout.triangles[triangle][corner] - draw.first_posed_vertex;
                const shared::RestVertex& rest = layout.rest_vertices[draw.first_rest_vertex + vertex];
                uvs.push_back(is_second ? rest.uv_1 : rest.uv_0);
            }
        }
        if (std::optional<charts::Chart> own = charts::own_chart(places, uvs)) {
            return own;
        }
    }
    return std::nullopt;
}

charts::Atlas packed(const std::vector<charts::Chart>& cut, size_t triangle_count, uint32_t size)
{
    try {
        return charts::pack_charts(cut, triangle_count, size);
    } catch (const Error&) {
        throw Error(fmt::format("the scene's {} charts do not fit into a map of {} x {} texels", cut.size(),
                                size, size),
                    "texels", "allow occlusion.texels or subsurface.texels more");
    }
}

} // namespace

SurfaceMapData make_surface_map(const pose::MeshData& layout, uint32_t size)
{
    const auto unit_m = static_cast<float>(layout.stroke_unit_m);
    const std::vector<std::vector<uint32_t>> of_draw = triangles_of_draws(layout);
    SurfaceMapData map{.size = size};
    std::vector<charts::Chart> all;
    for (size_t draw = 0; draw < of_draw.size(); ++draw) {
        const std::vector<uint32_t>& triangles = of_draw[draw];
        std::vector<glm::vec3> places;
        for (const uint32_t triangle : triangles) {
            for (int corner = 0; corner < 3; ++corner) {
                places.push_back(unit_m * layout.stroke_coordinates[layout.triangles[triangle][corner]]);
            }
        }
        std::optional<charts::Chart> own = chart_of_uvs(layout, layout.draws[draw], triangles, places);
        map.cut_draws += own || triangles.empty() ? 0U : 1U;
        std::vector<charts::Chart> cut =
            own ? std::vector<charts::Chart>{std::move(*own)} : charts::cut_charts(places);
        for (charts::Chart& chart : cut) {
            for (uint32_t& triangle : chart.triangles) {
                triangle = triangles[triangle];
            }
            all.push_back(std::move(chart));
        }
    }
    const charts::Atlas atlas = packed(all, layout.triangles.size(), size);
    map.texels_per_m = atlas.texels_per_m;
    map.corners.assign(3 * layout.triangles.size(), glm::vec2(-1.0F));
    for (const uint32_t triangle : atlas.triangles) {
        for (size_t corner = 3 * size_t{triangle}; corner < 3 * size_t{triangle} + 3; ++corner) {
            map.corners[corner] = atlas.corners[corner];
        }
    }
    map.texels.assign(size_t{size} * size, glm::uvec4(0));
    for (const charts::Texel& texel : charts::covered_texels(atlas)) {
        map.texels[texel.place] = {texel.triangle + 1, std::bit_cast<uint32_t>(texel.weights.x),
                                   std::bit_cast<uint32_t>(texel.weights.y), 0};
    }
    return map;
}

SurfaceMap upload_surface_map(gpu::Device& device, const SurfaceMapData& data)
{
    return {.texels = gpu::upload_buffer(device, "texels of surfaces", data.texels),
            .corners = gpu::upload_buffer(device, "corners in the map", data.corners),
            .size = data.size,
            .texels_per_m = data.texels_per_m,
            .cut_draws = data.cut_draws};
}

} // namespace estampe::features
