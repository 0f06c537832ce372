// SPDX-License-Identifier: MIT
#include "kit.hpp"

#include <cmath>
#include <numbers>

namespace kit {

using namespace estampe; // NOLINT(google-build-using-namespace): this whole file uses one library

Primitive turned(const std::vector<glm::vec2>& rings, uint32_t segments)
{
    Primitive result;
    const auto band = [&](glm::vec2 from, glm::vec2 to) {
        const auto first = static_cast<uint32_t>(result.positions.size());
        const glm::vec2 way = to - from;
        const float length_m = std::max(glm::length(way), 1e-6F);
        for (uint32_t i = 0; i <= segments; ++i) {
            const float angle = 2.0F * std::numbers::pi_v<float> * static_cast<float>(i % segments) /
                                static_cast<float>(segments);
            const glm::vec2 out(std::cos(angle), -std::sin(angle));
            for (const glm::vec2& ring : {from, to}) {
                result.positions.emplace_back(ring.x * out.x, ring.y, ring.x * out.y);
                result.normals.emplace_back(way.y / length_m * out.x, -way.x / length_m,
                                            way.y / length_m * out.y);
                result.uvs[0].emplace_back(ring.y, static_cast<float>(i) * from.x * 0.2F);
            }
            if (i < segments) {
                const uint32_t k = first + 2 * i;
                const auto corners = {k, k + 2, k + 1, k + 1, k + 2, k + 3};
                result.indices.insert(result.indices.end(), corners.begin(), corners.end());
            }
        }
    };
    band({0.0F, rings.front().y}, rings.front());
    for (size_t i = 0; i + 1 < rings.size(); ++i) {
        band(rings[i], rings[i + 1]);
    }
    band(rings.back(), {0.0F, rings.back().y});
    return result;
}

Primitive block(glm::vec3 half_m)
{
    Primitive result;
    for (int face = 0; face < 6; ++face) {
        const int axis = face / 2;
        const float side = face % 2 == 0 ? 1.0F : -1.0F;
        glm::vec3 normal(0.0F);
        glm::vec3 u(0.0F);
        glm::vec3 v(0.0F);
        normal[axis] = side;
        u[(axis + 1) % 3] = side;
        v[(axis + 2) % 3] = 1.0F;
        const auto first = static_cast<uint32_t>(result.positions.size());
        for (int corner = 0; corner < 4; ++corner) {
            const glm::vec2 at((corner & 1) != 0 ? 1.0F : -1.0F, (corner & 2) != 0 ? 1.0F : -1.0F);
            result.positions.push_back(half_m * (normal + at.x * u + at.y * v));
            result.normals.push_back(normal);
            result.uvs[0].emplace_back(glm::dot(half_m, glm::abs(u)) * at.x,
                                       glm::dot(half_m, glm::abs(v)) * at.y);
        }
        const auto corners = {first, first + 1, first + 3, first, first + 3, first + 2};
        result.indices.insert(result.indices.end(), corners.begin(), corners.end());
    }
    return result;
}

Scene empty_scene()
{
    Scene scene;
    scene.materials.push_back({.name = "plain", .base_color = {0.85F, 0.83F, 0.8F, 1.0F}, .metallic = 0.0F});
    scene.materials.push_back({.name = "sheet", .base_color = {0.9F, 0.88F, 0.84F, 1.0F}, .metallic = 0.0F});
    return scene;
}

Index add(Scene& scene, const std::string& name, Primitive primitive, glm::dvec3 place_m,
          ClothCollider collider)
{
    const auto node = static_cast<Index>(scene.nodes.size());
    scene.meshes.push_back({.name = name, .primitives = {std::move(primitive)}});
    scene.nodes.push_back({.name = name,
                           .transform = {.translation = place_m},
                           .mesh = static_cast<Index>(scene.meshes.size() - 1),
                           .collider = collider});
    scene.roots.push_back(node);
    return node;
}

Index add_sheet(Scene& scene, glm::uvec2 particles, glm::dvec3 corner_m, glm::vec3 along_m, glm::vec3 down_m,
                const Hold& hold, const Cloth& cloth)
{
    Primitive sheet = cloth_sheet(particles.x, particles.y, glm::vec3(0.0F), along_m, down_m);
    sheet.material = 1;
    for (uint32_t i = 0; i < sheet.held.size(); ++i) {
        const glm::uvec2 place(i % particles.x, i / particles.x);
        const glm::vec2 share = glm::vec2(place) / glm::vec2(particles - 1U);
        sheet.held[i] = hold ? hold(share) : 0.0F;
    }
    const Index node = add(scene, "sheet", std::move(sheet), corner_m, ClothCollider::none);
    scene.nodes[node].cloth = cloth;
    return node;
}

} // namespace kit
