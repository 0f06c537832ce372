// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include <estampe/shapes.hpp>

#include "scene/static_triangles.hpp"
#include "support/folder.hpp"
#include "support/scenes.hpp"
#include "techniques/bake/bake.hpp"

namespace estampe::bake::testing {

using test::Folder;

/// The surface with its front and back sides exchanged.
inline Primitive inside_out(Primitive primitive)
{
    for (size_t i = 0; i + 2 < primitive.indices.size(); i += 3) {
        std::swap(primitive.indices[i + 1], primitive.indices[i + 2]);
    }
    for (glm::vec3& normal : primitive.normals) {
        normal = -normal;
    }
    return primitive;
}

/// One closed surface of the given albedo.
inline Scene room_of(Primitive primitive, const glm::vec3& albedo,
                     const glm::vec3& emissive = glm::vec3(0.0F))
{
    Scene scene;
    test::add_object(scene, std::move(primitive), albedo);
    scene.materials[0].double_sided = false;
    scene.materials[0].emissive = emissive;
    return scene;
}

inline Lightmap baked(const Scene& scene, const BakeSettings& settings)
{
    Bake bake(scene, settings);
    while (bake.work(1.0)) {
    }
    return bake.map();
}

/// The light at a place of the map, interpolated between texels.
inline glm::vec3 light_at(const LightImage& image, const glm::vec2& place)
{
    const glm::vec2 texel = place * glm::vec2(image.width, image.height) - 0.5F;
    const glm::vec2 floor = glm::floor(texel);
    const glm::vec2 f = texel - floor;
    const auto at = [&](int dx, int dy) {
        const int x = std::clamp(static_cast<int>(floor.x) + dx, 0, static_cast<int>(image.width) - 1);
        const int y = std::clamp(static_cast<int>(floor.y) + dy, 0, static_cast<int>(image.height) - 1);
        return image.texels[static_cast<size_t>(y) * image.width + static_cast<size_t>(x)];
    };
    return glm::mix(glm::mix(at(0, 0), at(1, 0), f.x), glm::mix(at(0, 1), at(1, 1), f.x), f.y);
}

/// The light in the middle of a static triangle.
inline glm::vec3 light_on(const Lightmap& map, size_t triangle)
{
    const glm::vec2* corner = &map.corners[3 * triangle];
    return light_at(map.light, (corner[0] + corner[1] + corner[2]) / 3.0F);
}

} // namespace estampe::bake::testing
