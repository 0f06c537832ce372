// SPDX-License-Identifier: MIT
#include "features/lighting/lightmaps.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include <estampe/error.hpp>
#include <estampe/lightmap.hpp>

#include "core/color.hpp"
#include "scene/static_triangles.hpp"

namespace estampe::features {
namespace {

// Place of a mesh in the scene: node, primitive, instance.
using Place = std::tuple<Index, uint32_t, uint32_t>;

/// Calls `visit` for each triangle, with the triangle's number, its draw call, and its number within the draw
/// call.
template <class Visit>
void visit_triangles(const pose::MeshData& meshes, const Visit& visit)
{
    std::vector<uint32_t> seen(meshes.draws.size(), 0);
    for (size_t i = 0; i < meshes.triangles.size(); ++i) {
        const uint32_t draw = meshes.triangles[i].w & shared::triangle_draw_mask;
        visit(i, draw, seen[draw]++);
    }
}

/// Mean luminance of the lightmap over the triangles that have it. Each triangle is sampled at its centre and
/// weighted by its area in the map.
float mean_level(const lightmap::MapData& map, const pose::MeshData& meshes)
{
    double sum = 0.0;
    double room = 0.0;
    visit_triangles(meshes, [&](size_t triangle, uint32_t draw, uint32_t /*number*/) {
        const shared::LightmapSlot& slot = map.slots[draw];
        if (slot.layer == shared::no_lightmap) {
            return;
        }
        const LightImage& picture = map.layers[slot.layer];
        const glm::vec2* corner = &map.corners[3 * triangle];
        const glm::vec2 a = corner[1] - corner[0];
        const glm::vec2 b = corner[2] - corner[0];
        const glm::vec2 middle = corner[0] + (a + b) / 3.0F;
        const auto x =
            std::min(static_cast<uint32_t>(middle.x * static_cast<float>(picture.width)), picture.width - 1);
        const auto y = std::min(static_cast<uint32_t>(middle.y * static_cast<float>(picture.height)),
                                picture.height - 1);
        const double own = std::abs(a.x * b.y - a.y * b.x);
        sum += own *
               static_cast<double>(slot.strength * luminance(picture.texels[size_t{y} * picture.width + x]));
        room += own;
    });
    return static_cast<float>(sum / std::max(room, 1e-12));
}

/// Returns the lightmap that the file assigns to a draw call: by node, otherwise by material, otherwise for
/// the whole scene.
std::optional<WornPicture> picture_of(const Lightmap& map, Index node, Index material)
{
    if (node < map.of_node.size() && map.of_node[node]) {
        return map.of_node[node];
    }
    return material < map.of_material.size() && map.of_material[material] ? map.of_material[material]
                                                                          : map.of_scene;
}

/// Collects the lightmaps that the scene's file assigns to meshes, with the meshes' own UVs.
lightmap::MapData worn_pictures(const Lightmap& map, const Scene& scene, const pose::MeshData& meshes)
{
    lightmap::MapData data{.layers = map.pictures};
    data.slots.assign(meshes.draws.size(), {.layer = shared::no_lightmap});
    std::vector<const Primitive*> primitives(meshes.draws.size(), nullptr);
    std::vector<uint32_t> uv_sets(meshes.draws.size(), 0);
    bool is_worn = false;
    for (size_t i = 0; i < meshes.sources.size(); ++i) {
        const pose::DrawSource& source = meshes.sources[i];
        const Index material = meshes.draws[i].material;
        const Primitive& primitive = scene.meshes[scene.nodes[source.node].mesh].primitives[source.primitive];
        const auto worn = picture_of(map, source.node, material);
        if (!worn || primitive.topology != Topology::triangles || primitive.uvs[worn->uv_set].empty() ||
            scene.materials[material].alpha_mode == AlphaMode::blend) {
            continue;
        }
        is_worn = true;
        data.slots[i] = {.layer = worn->picture, .strength = worn->intensity};
        primitives[i] = &primitive;
        uv_sets[i] = worn->uv_set;
    }
    if (!is_worn) {
        throw Error("the scene names lightmaps, but no mesh has the UVs that they are laid on by", "lightmap",
                    "texCoord says which of the two sets of UVs is meant; 1 unless given");
    }
    data.corners.assign(3 * meshes.triangles.size(), glm::vec2(0.0F));
    visit_triangles(meshes, [&](size_t triangle, uint32_t draw, uint32_t number) {
        for (size_t k = 0; k < 3 && primitives[draw] != nullptr; ++k) {
            const uint32_t vertex = primitives[draw]->indices[3 * size_t{number} + k];
            data.corners[3 * triangle + k] =
                glm::clamp(primitives[draw]->uvs[uv_sets[draw]][vertex], 0.0F, 1.0F);
        }
    });
    return data;
}

} // namespace

lightmap::MapData worn_map(const Lightmap& map, const Scene& scene, const pose::MeshData& meshes)
{
    if (!map.pictures.empty()) {
        return worn_pictures(map, scene, meshes);
    }
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
    const lightmap::MapData data = worn_map(*map, scene, meshes);
    return WornLight{.maps = lightmap::upload_maps(device, data),
                     .exposure = map->pictures.empty() ? map->exposure : 0.0F,
                     .level = mean_level(data, meshes),
                     .kinds = map->baked_lights};
}

uint32_t kind_of(const shared::LightRecord& record)
{
    const uint32_t type = record.type & shared::light_type_mask;
    return type == shared::light_directional ? baked_directional
           : type >= shared::light_spot      ? baked_spot
                                             : baked_point;
}

float make_room(light::Lighting& lighting, const std::optional<WornLight>& worn,
                const lightmap::LightmapStyle& style)
{
    if (!worn) {
        return 0.0F;
    }
    const WornLight& baked = *worn;
    std::erase_if(lighting.records,
                  [&](const shared::LightRecord& record) { return (kind_of(record) & baked.kinds) != 0; });
    lighting.directional_count = (baked.kinds & baked_directional) != 0 ? 0 : lighting.directional_count;
    const float scale = style.strength * (baked.exposure > 0.0F ? lighting.exposure / baked.exposure : 1.0F);
    if (!style.balance) {
        return scale;
    }
    // With the style's exposure, well-lit places have a brightness of about 1 plus the ambient light. With a
    // lightmap, their brightness would be 1 plus the light of the lightmap.
    const float dimmed = (1.0F + luminance(lighting.ambient)) / (1.0F + scale * baked.level);
    lighting.ambient *= dimmed;
    for (shared::LightRecord& record : lighting.records) {
        record.color *= dimmed;
    }
    return scale * dimmed;
}

} // namespace estampe::features
