// SPDX-License-Identifier: MIT
#include "features/common/surface_map.hpp"

#include <gtest/gtest.h>

#include <estampe/error.hpp>
#include <estampe/shapes.hpp>

#include "support/scenes.hpp"

namespace estampe::features {
namespace {

SurfaceMapData map_of(const Scene& scene, uint32_t size)
{
    return make_surface_map(pose::build_meshes(scene, 0), size);
}

/// Share of the atlas that surfaces cover.
double covered(const SurfaceMapData& map)
{
    double count = 0.0;
    for (const glm::uvec4& texel : map.texels) {
        count += texel.x > 0 ? 1.0 : 0.0;
    }
    return count / static_cast<double>(map.texels.size());
}

TEST(SurfaceMap, TakesTheFilesCoordinatesWhereTheyServe)
{
    Scene scene = test::scene_of(shapes::plane(2.0F, 2.0F, 4));
    const SurfaceMapData own = map_of(scene, 64);
    EXPECT_EQ(own.cut_draws, 0U);
    EXPECT_GT(covered(own), 0.8);
    // A surface with UVs turned by 180 degrees is turned in the atlas too.
    const glm::vec2 before = own.corners.front();
    for (glm::vec2& uv : scene.meshes.front().primitives.front().uvs[0]) {
        uv = 1.0F - uv;
    }
    const SurfaceMapData turned = map_of(scene, 64);
    const glm::vec2 sum = turned.corners.front() + before;
    EXPECT_NEAR(sum.x, sum.y, 1e-3);
    EXPECT_NE(turned.corners.front(), before);
}

TEST(SurfaceMap, CutsWhatHasNone)
{
    for (const bool has_uvs : {false, true}) {
        Scene scene = test::scene_of(shapes::sphere(0.5F, 24, 16));
        auto& uvs = scene.meshes.front().primitives.front().uvs[0];
        if (has_uvs) { // all triangles overlap
            std::ranges::fill(uvs, glm::vec2(0.5F));
        } else {
            uvs.clear();
        }
        const SurfaceMapData map = map_of(scene, 128);
        EXPECT_EQ(map.cut_draws, 1U);
        EXPECT_GT(covered(map), 0.3);
    }
}

TEST(SurfaceMap, HasATexelAtEachOfItsPlaces)
{
    Scene scene = test::scene_of(shapes::torus(0.6F, 0.2F, 24, 12));
    test::add_object(scene, shapes::box({1.0F, 1.0F, 1.0F}), glm::vec3(1.0F), {2.0, 0.0, 0.0});
    const pose::MeshData layout = pose::build_meshes(scene, 0);
    const SurfaceMapData map = make_surface_map(layout, 256);
    for (uint32_t triangle = 0; triangle < layout.opaque.count; ++triangle) {
        const glm::vec2* corner = &map.corners[size_t{3} * triangle];
        ASSERT_GT(corner[0].x, 0.0F) << triangle;
        const glm::uvec2 middle((corner[0] + corner[1] + corner[2]) / 3.0F);
        const glm::uvec4& texel = map.texels[size_t{middle.y} * map.size + middle.x];
        ASSERT_GT(texel.x, 0U);
        EXPECT_EQ(layout.triangles[texel.x - 1].w, layout.triangles[triangle].w) << "another object's";
    }
    for (uint32_t triangle = layout.ground.first; triangle < layout.ground.first + layout.ground.count;
         ++triangle) {
        EXPECT_LT(map.corners[size_t{3} * triangle].x, 0.0F);
    }
}

TEST(SurfaceMap, SaysWhatDoesNotFit)
{
    Scene scene = test::scene_of(shapes::sphere(0.5F, 24, 16));
    for (int i = 0; i < 40; ++i) {
        test::add_object(scene, shapes::box({1.0F, 1.0F, 1.0F}), glm::vec3(1.0F), {2.0 * i, 0.0, 0.0});
    }
    try {
        (void)map_of(scene, 64);
        FAIL();
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("64 x 64"), std::string::npos) << error.what();
    }
}

} // namespace
} // namespace estampe::features
