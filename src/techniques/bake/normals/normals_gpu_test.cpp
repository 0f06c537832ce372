// SPDX-License-Identifier: MIT
// Plain meshes that are drawn with baked normal maps.
#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

#include "support/drawing.hpp"
#include "techniques/bake/normals/test_support.hpp"

namespace estampe::bake::testing {
namespace {

constexpr uint32_t side_px = 200;

/// The scene with this map as the normal map of its first material.
Scene with_map(Scene scene, const Image& map)
{
    scene.textures.push_back({.image = map});
    scene.materials[0].normal_texture.texture = 0;
    return scene;
}

/// Distances between the drawn normals of a picture and the wanted normals at the points that are drawn,
/// from the smallest to the largest.
std::vector<double> errors_of(const Scene& scene, const Camera& camera,
                              const std::function<glm::dvec3(const glm::dvec3&)>& wanted)
{
    test::Drawing drawing(scene, camera, glm::uvec2(side_px));
    const test::SurfacePixels surface = drawing.surface();
    std::vector<double> errors;
    for (size_t i = 0; i < surface.depth.size(); ++i) {
        if (surface.depth[i] > 0.0F) {
            errors.push_back(glm::distance(glm::dvec3(surface.shading_normal[i]),
                                           wanted(drawing.point_seen(i, surface.depth[i]))));
        }
    }
    std::ranges::sort(errors);
    return errors;
}

TEST(DrawnBakedNormals, ASquareIsDrawnLikeTheWaves)
{
    const Scene plain = test::scene_of(square());
    const Image map = bake_normals(plain, test::scene_of(waves()), {.size = 256, .distance_m = 0.1}).map;
    // Drawn points are relative to the centre of the square.
    const std::vector<double> errors =
        errors_of(with_map(plain, map), {.eye = {0.5, 0.2, 1.6}, .target = {0.5, 0.5, 0.0}},
                  [](const glm::dvec3& p) { return wave_normal(p.x + 0.5, p.y + 0.5); });
    ASSERT_GT(errors.size(), 10000U);
    RecordProperty("worst", std::to_string(errors.back()));
    EXPECT_LT(errors.back(), 0.02);
}

TEST(DrawnBakedNormals, ALowSphereIsDrawnRound)
{
    const Scene plain = test::scene_of(globe(24, 12));
    const Image map =
        bake_normals(plain, test::scene_of(globe(512, 256)), {.size = 1024, .distance_m = 0.1}).map;
    const Camera camera = test::front_camera(4.0, 0.45);
    const auto radial = [](const glm::dvec3& p) { return glm::normalize(p); };
    const std::vector<double> errors = errors_of(with_map(plain, map), camera, radial);
    ASSERT_GT(errors.size(), 10000U);
    RecordProperty("worst", std::to_string(errors.back()));
    EXPECT_LT(errors.back(), 0.02);
}

} // namespace
} // namespace estampe::bake::testing
