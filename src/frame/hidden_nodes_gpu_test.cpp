// SPDX-License-Identifier: MIT
// A hidden node is drawn as if it did not exist; a material variant is drawn with its materials.
#include <gtest/gtest.h>

#include <estampe/renderer.hpp>
#include <estampe/shapes.hpp>

#include "support/gpu_device.hpp"
#include "support/scenes.hpp"

namespace estampe {
namespace {

Image draw_nodes(const Scene& scene)
{
    constexpr RenderSettings small{.width = 192, .height = 144};
    const Camera camera{.eye = {4.0, 4.0, 7.0}, .target = {0.5, 0.5, 0.0}};
    test::shared_renderer().set_scene(scene);
    return test::shared_renderer().render(camera, {}, small);
}

/// A box on a floor.
Scene stage()
{
    Scene scene = test::scene_of(shapes::plane(8.0F, 8.0F));
    test::add_object(scene, shapes::box(glm::vec3(1.0F)), glm::vec3(0.8F));
    return scene;
}

/// The stage, and a node that carries a lamp and a tower whose shadow falls on the floor.
Scene with_tower(bool visible)
{
    Scene scene = stage();
    const Index tower =
        test::add_object(scene, shapes::box({0.6F, 3.0F, 0.6F}), glm::vec3(0.8F), {2.0, 0.0, -1.0});
    test::add_sun(scene, {-1.0, 1.0, 0.3});
    const Index sun = static_cast<Index>(scene.nodes.size() - 1);
    const Index above = static_cast<Index>(scene.nodes.size());
    scene.nodes.push_back({.name = "hidden", .children = {tower, sun}, .visible = visible});
    scene.nodes[tower].parent = scene.nodes[sun].parent = above;
    std::erase_if(scene.roots, [&](Index root) { return root == tower || root == sun; });
    scene.roots.push_back(above);
    return scene;
}

TEST(HiddenNodes, AreDrawnAsIfTheyWereNotThere)
{
    const Image without = draw_nodes(stage());
    EXPECT_EQ(draw_nodes(with_tower(false)), without)
        << "neither the tower, its shadow nor the light is left";
    EXPECT_NE(draw_nodes(with_tower(true)), without);
}

TEST(MaterialVariants, AreDrawnOfTheirMaterials)
{
    Scene scene = stage();
    const Image by_default = draw_nodes(scene);
    scene.materials.push_back({.name = "night", .base_color = {0.05F, 0.05F, 0.3F, 1.0F}, .metallic = 0.0F});
    scene.variants = {"night"};
    scene.meshes[1].primitives[0].variant_materials = {static_cast<Index>(scene.materials.size() - 1)};
    EXPECT_EQ(draw_nodes(scene), by_default);
    apply_variant(scene, "night");
    EXPECT_NE(draw_nodes(scene), by_default);
    apply_variant(scene, "");
    EXPECT_EQ(draw_nodes(scene), by_default);
}

} // namespace
} // namespace estampe
