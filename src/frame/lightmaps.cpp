// SPDX-License-Identifier: MIT
#include "frame/lightmaps.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include <estampe/error.hpp>

#include "core/luminance.hpp"
#include "scene/static_triangles.hpp"

namespace estampe::frame {
namespace {

using Place = std::tuple<Index, uint32_t, uint32_t>; // node, primitive, instance

/// Calls `visit` with each triangle, its draw and its number among the triangles of that draw.
template <class Visit>
void visit_triangles(const pose::MeshData& meshes, const Visit& visit)
{
    std::vector<uint32_t> seen(meshes.draws.size(), 0);
    for (size_t i = 0; i < meshes.triangles.size(); ++i) {
        const uint32_t draw = meshes.triangles[i].w & shared::triangle_draw_mask;
        visit(i, draw, seen[draw]++);
    }
}

/// Mean over the triangles of a map, each at its middle and by the room that it takes.
float mean_level(const Lightmap& map)
{
    double sum = 0.0;
    double room = 0.0;
    for (size_t i = 0; i + 2 < map.corners.size(); i += 3) {
        const glm::vec2 a = map.corners[i + 1] - map.corners[i];
        const glm::vec2 b = map.corners[i + 2] - map.corners[i];
        const glm::vec2 middle = map.corners[i] + (a + b) / 3.0F;
        const auto x = std::min(static_cast<uint32_t>(middle.x * static_cast<float>(map.light.width)),
                                map.light.width - 1);
        const auto y = std::min(static_cast<uint32_t>(middle.y * static_cast<float>(map.light.height)),
                                map.light.height - 1);
        const double own = std::abs(a.x * b.y - a.y * b.x);
        sum += own * luminance(map.light.texels[size_t{y} * map.light.width + x]);
        room += own;
    }
    return static_cast<float>(sum / std::max(room, 1e-12));
}

} // namespace

uint32_t kind_of(const shared::LightRecord& light)
{
    const uint32_t type = light.type & 255U;
    return type == shared::light_directional ? baked_directional
           : type >= shared::light_spot      ? baked_spot
                                             : baked_point;
}

lightmap::MapData worn_map(const Lightmap& map, const Scene& scene, const pose::MeshData& meshes)
{
    const StaticTriangles still = static_triangles(scene);
    if (map.geometry != geometry_fingerprint(still) || map.corners.size() != 3 * still.count()) {
        throw Error("the lightmap was made for another scene", "lightmap",
                    "bake it again, from the scene as it is now");
    }
    std::map<Place, uint32_t> first_triangle;
    for (const StaticDraw& draw : still.draws) {
        first_triangle[{draw.node, draw.primitive, draw.instance}] = draw.first_triangle;
    }
    lightmap::MapData data{.layers = {map.light}};
    data.slots.assign(meshes.draws.size(), {.layer = shared::no_lightmap});
    std::vector<uint32_t> first_of_draw(meshes.draws.size(), 0);
    for (size_t i = 0; i < meshes.sources.size(); ++i) {
        const pose::DrawSource& source = meshes.sources[i];
        const auto found = first_triangle.find({source.node, source.primitive, source.instance});
        if (found != first_triangle.end() &&
            scene.materials[meshes.draws[i].material].alpha_mode != AlphaMode::blend) {
            data.slots[i] = {.layer = 0, .strength = 1.0F};
            first_of_draw[i] = found->second;
        }
    }
    data.corners.assign(3 * meshes.triangles.size(), glm::vec2(0.0F));
    visit_triangles(meshes, [&](size_t triangle, uint32_t draw, uint32_t number) {
        for (size_t k = 0; k < 3 && data.slots[draw].layer != shared::no_lightmap; ++k) {
            const size_t still_triangle = size_t{first_of_draw[draw]} + number;
            data.corners[3 * triangle + k] = map.corners[3 * still_triangle + k];
        }
    });
    return data;
}

std::optional<WornLight> upload_baked(gpu::Device& device, const Lightmap* map, const Scene& scene,
                                      const pose::MeshData& meshes)
{
    if (map == nullptr) {
        return std::nullopt;
    }
    return WornLight{.maps = lightmap::upload_maps(device, worn_map(*map, scene, meshes)),
                     .exposure = map->exposure,
                     .level = mean_level(*map),
                     .kinds = map->baked_lights};
}

float make_room(light::Lighting& lighting, const std::optional<WornLight>& worn,
                const lightmap::LightmapStyle& style)
{
    if (!worn) {
        return 0.0F;
    }
    const WornLight& baked = *worn;
    std::erase_if(lighting.records,
                  [&](const shared::LightRecord& light) { return (kind_of(light) & baked.kinds) != 0; });
    lighting.directional_count = (baked.kinds & baked_directional) != 0 ? 0 : lighting.directional_count;
    const float scale = style.strength * lighting.exposure / baked.exposure;
    if (!style.balance) {
        return scale;
    }
    // Well-lit places come to about one and the ambient light; now they come to one and the map.
    const float dimmed = (1.0F + luminance(lighting.ambient)) / (1.0F + scale * baked.level);
    lighting.ambient *= dimmed;
    for (shared::LightRecord& light : lighting.records) {
        light.color *= dimmed;
    }
    return scale * dimmed;
}

} // namespace estampe::frame
