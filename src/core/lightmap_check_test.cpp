// SPDX-License-Identifier: MIT
// Lightmaps and pictures that come from another process are refused unless they are well formed.
#include <functional>

#include <gtest/gtest.h>

#include "core/exr.hpp"
#include "core/image_codec.hpp"

namespace estampe {
namespace {

Lightmap sample()
{
    Lightmap map;
    map.light = {.width = 1, .height = 2, .texels = {glm::vec3(1.0F), glm::vec3(2.0F)}};
    map.corners = {{0, 0}, {1, 0}, {0, 1}};
    map.pictures = {map.light};
    map.of_node = {std::nullopt, WornPicture{}};
    map.of_material = {WornPicture{}};
    map.of_scene = WornPicture{};
    return map;
}

void expect_refused(const std::function<void(Lightmap&)>& damage)
{
    Lightmap map = sample();
    EXPECT_TRUE(is_well_formed(map));
    damage(map);
    EXPECT_FALSE(is_well_formed(map));
}

TEST(ReceivedLightmap, DamageIsRefused)
{
    expect_refused([](Lightmap& map) { map.light.texels.pop_back(); });
    expect_refused([](Lightmap& map) { map.pictures[0].width = 2; });
    expect_refused([](Lightmap& map) { map.corners.pop_back(); });
    expect_refused([](Lightmap& map) { map.corners[1].x = 1.5F; });
    expect_refused([](Lightmap& map) { map.exposure = 0.0F; });
    expect_refused([](Lightmap& map) { map.baked_lights = 8; });
    expect_refused([](Lightmap& map) { map.of_node[1]->picture = 1; });
    expect_refused([](Lightmap& map) { map.of_material[0]->uv_set = 2; });
    expect_refused([](Lightmap& map) { map.of_scene->picture = 1; });
}

TEST(ReceivedImage, DamageIsRefused)
{
    const Image good{.width = 1, .height = 2, .rgba = std::vector<uint8_t>(8)};
    EXPECT_TRUE(is_well_formed(good));
    EXPECT_FALSE(is_well_formed(Image{}));
    EXPECT_FALSE(is_well_formed({.width = 2, .height = 2, .rgba = good.rgba}));
    EXPECT_FALSE(is_well_formed({.width = 0x80000001, .height = 1, .rgba = std::vector<uint8_t>(4)}));
}

} // namespace
} // namespace estampe
