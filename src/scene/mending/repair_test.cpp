// SPDX-License-Identifier: MIT
#include "scene/mending/repair.hpp"

#include <gtest/gtest.h>

#include <estampe/shapes.hpp>

#include "support/scenes.hpp"

namespace estampe {
namespace {

Primitive& primitive_of(Scene& scene, Index node = 0)
{
    return scene.meshes[scene.nodes[node].mesh].primitives[0];
}

Material& material_of(Scene& scene, Index node = 0)
{
    return scene.materials[primitive_of(scene, node).material];
}

glm::vec3 face_normal(const Primitive& primitive, size_t triangle)
{
    const uint32_t* const corners = &primitive.indices[3 * triangle];
    const glm::vec3 a = primitive.positions[corners[0]];
    return glm::cross(primitive.positions[corners[1]] - a, primitive.positions[corners[2]] - a);
}

size_t turned_inwards(const Primitive& primitive)
{
    size_t count = 0;
    for (size_t t = 0; t < primitive.indices.size() / 3; ++t) {
        count +=
            glm::dot(face_normal(primitive, t), primitive.normals[primitive.indices[3 * t]]) < 0.0F ? 1U : 0U;
    }
    return count;
}

/// A box with right normals, in which every third triangle has reversed winding.
Scene patchwork(bool double_sided)
{
    Scene scene = test::scene_of(shapes::box({1.0F, 1.0F, 1.0F}));
    material_of(scene).double_sided = double_sided;
    Primitive& box = primitive_of(scene);
    for (size_t t = 0; t < box.indices.size() / 3; t += 3) {
        std::swap(box.indices[3 * t + 1], box.indices[3 * t + 2]);
    }
    return scene;
}

TEST(TurnByNormals, MixedOrdersOfTwoSidedSurfacesFollowTheNormals)
{
    Scene scene = patchwork(true);
    EXPECT_EQ(turned_inwards(primitive_of(scene)), 4U);
    turn_by_normals(scene);
    EXPECT_EQ(turned_inwards(primitive_of(scene)), 0U);
}

TEST(TurnByNormals, TheOrderOfAOneSidedSurfaceSaysWhatMayBeSeen)
{
    Scene scene = patchwork(false);
    turn_by_normals(scene);
    EXPECT_EQ(turned_inwards(primitive_of(scene)), 4U);
}

TEST(TurnByNormals, MarksOfEdgesTurnWithTheirTriangles)
{
    Scene scene = patchwork(true);
    Primitive& box = primitive_of(scene);
    box.edge_marks.assign(box.indices.size() / 3, 0);
    box.edge_marks[0] = 1; // marks the edge from the first corner to the second
    const uint32_t a = box.indices[0];
    const uint32_t b = box.indices[1];
    turn_by_normals(scene);
    EXPECT_EQ(box.edge_marks[0], 4) << "from the last corner to the first";
    EXPECT_EQ(box.indices[0], a);
    EXPECT_EQ(box.indices[2], b);
}

/// A sphere in one part and a box in another, both one-sided.
Scene figure()
{
    Scene scene = test::scene_of(shapes::sphere(0.5F, 16, 8));
    test::add_object(scene, shapes::box({0.6F, 1.0F, 0.4F}), glm::vec3(0.5F), {0.0, -1.4, 0.0});
    for (Material& material : scene.materials) {
        material.double_sided = false;
    }
    return scene;
}

Primitive grown_inside_out(Primitive primitive, float by_m)
{
    for (size_t v = 0; v < primitive.positions.size(); ++v) {
        primitive.positions[v] += by_m * primitive.normals[v];
    }
    for (size_t i = 0; i + 2 < primitive.indices.size(); i += 3) {
        std::swap(primitive.indices[i + 1], primitive.indices[i + 2]);
    }
    return primitive;
}

void add_one_sided(Scene& scene, const Primitive& primitive, const glm::dvec3& place)
{
    const Index node = test::add_object(scene, primitive, glm::vec3(0.0F), place);
    material_of(scene, node).double_sided = false;
}

size_t drawn_count(const Scene& scene)
{
    return static_cast<size_t>(
        std::ranges::count_if(scene.nodes, [](const Node& node) { return node.mesh != no_index; }));
}

TEST(OutlineHulls, ALargerCopyTurnedInsideOutIsLeftOut)
{
    Scene scene = figure();
    add_one_sided(scene, grown_inside_out(shapes::sphere(0.5F, 16, 8), 0.02F), {});
    leave_out_outline_hulls(scene);
    EXPECT_EQ(drawn_count(scene), 2U);
    ASSERT_EQ(scene.warnings.size(), 1U);
    EXPECT_NE(scene.warnings[0].find("outline hull"), std::string::npos);
}

TEST(OutlineHulls, OneHullAroundAllPartsIsLeftOut)
{
    Scene scene = figure();
    Primitive hull = grown_inside_out(shapes::sphere(0.5F, 16, 8), 0.02F);
    shapes::append(hull, grown_inside_out(shapes::box({0.6F, 1.0F, 0.4F}), 0.02F),
                   glm::translate(glm::mat4(1.0F), {0.0F, -1.4F, 0.0F}));
    add_one_sided(scene, hull, {});
    leave_out_outline_hulls(scene);
    EXPECT_EQ(drawn_count(scene), 2U);
}

TEST(OutlineHulls, OtherThingsStay)
{
    const Primitive ball = shapes::sphere(0.5F, 16, 8);
    Scene scene = figure();
    add_one_sided(scene, grown_inside_out(ball, 0.02F), {3.0, 0.0, 0.0}); // encloses nothing
    Primitive shell = ball;                                               // a larger copy that faces outwards
    for (glm::vec3& position : shell.positions) {
        position *= 1.04F;
    }
    add_one_sided(scene, shell, {});
    add_one_sided(scene, grown_inside_out(ball, 1.5F), {}); // a surrounding sky
    const Index two_sided = test::add_object(scene, grown_inside_out(ball, 0.02F), glm::vec3(0.0F));
    material_of(scene, two_sided).double_sided = true;
    leave_out_outline_hulls(scene);
    EXPECT_EQ(drawn_count(scene), 6U);
    EXPECT_TRUE(scene.warnings.empty());
}

/// A card with a texture whose alpha is a function of position.
template <class Alpha>
Scene card(const Alpha& alpha)
{
    Scene scene = test::scene_of(shapes::quad(1.0F, 1.0F));
    Primitive& quad = primitive_of(scene);
    quad.uvs[0].clear();
    for (const glm::vec3& position : quad.positions) {
        quad.uvs[0].emplace_back(position.x + 0.5F, 1.0F - position.y);
    }
    constexpr uint32_t side = 64;
    Texture& texture = scene.textures.emplace_back();
    texture.image = {.width = side, .height = side, .rgba = {}};
    for (uint32_t i = 0; i < side * side; ++i) {
        const glm::dvec2 place((i % side + 0.5) / side, (i / side + 0.5) / side);
        texture.image.rgba.insert(texture.image.rgba.end(),
                                  {90, 160, 60, static_cast<uint8_t>(255.0 * alpha(place) + 0.5)});
    }
    material_of(scene).alpha_mode = AlphaMode::blend;
    material_of(scene).base_color_texture.texture = 0;
    return scene;
}

template <class Alpha>
AlphaMode mode_of(const Alpha& alpha)
{
    Scene scene = card(alpha);
    find_cut_out_materials(scene);
    return material_of(scene).alpha_mode;
}

double distance_from_middle(const glm::dvec2& place)
{
    return glm::distance(place, glm::dvec2(0.5));
}

TEST(CutOuts, LeavesAreMaskedSolidThingsOpaqueAndSoftOnesStay)
{
    const auto leaf = [](const glm::dvec2& place) { return distance_from_middle(place) < 0.3 ? 1.0 : 0.0; };
    const auto soft_leaf = [](const glm::dvec2& place) {
        return std::clamp((0.3 - distance_from_middle(place)) / 0.08, 0.0, 1.0);
    };
    const auto smoke = [](const glm::dvec2& place) {
        return std::clamp(1.0 - 2.0 * distance_from_middle(place), 0.0, 1.0);
    };
    EXPECT_EQ(mode_of(leaf), AlphaMode::mask);
    EXPECT_EQ(mode_of(soft_leaf), AlphaMode::mask);
    EXPECT_EQ(mode_of(smoke), AlphaMode::blend);
    EXPECT_EQ(mode_of([](const glm::dvec2&) { return 1.0; }), AlphaMode::opaque);
    EXPECT_EQ(mode_of([](const glm::dvec2&) { return 0.3; }), AlphaMode::blend) << "glass";
    EXPECT_EQ(mode_of([](const glm::dvec2& place) { return place.x < 0.5 ? 1.0 : 0.3; }), AlphaMode::blend)
        << "a window in its frame";
}

TEST(CutOuts, OnlyWhatTheSurfaceCoversCounts)
{
    // The left half of the texture is a leaf, the right half glass.
    const auto atlas = [](const glm::dvec2& place) {
        return place.x > 0.5 ? 0.3 : distance_from_middle({2.0 * place.x, place.y}) < 0.3 ? 1.0 : 0.0;
    };
    for (const bool is_leaf : {true, false}) {
        Scene scene = card(atlas);
        for (glm::vec2& uv : primitive_of(scene).uvs[0]) {
            uv.x = 0.5F * uv.x + (is_leaf ? 0.0F : 0.5F);
        }
        find_cut_out_materials(scene);
        EXPECT_EQ(material_of(scene).alpha_mode, is_leaf ? AlphaMode::mask : AlphaMode::blend);
    }
}

TEST(CutOuts, SoftHairIsMaskedAndSmokeHasNoEdges)
{
    const auto hair = [](const glm::dvec2& place) {
        return std::clamp(1.6 - 4.0 * std::abs(std::fmod(8.0 * place.x, 1.0) - 0.5), 0.0, 1.0);
    };
    EXPECT_EQ(mode_of(hair), AlphaMode::mask);
    const auto clear_parts = [](const auto& alpha) {
        Scene scene = card(alpha);
        find_cut_out_materials(scene);
        EXPECT_EQ(material_of(scene).alpha_mode, AlphaMode::blend);
        return material_of(scene).has_clear_parts;
    };
    EXPECT_TRUE(clear_parts([](const glm::dvec2& place) {
        return std::clamp(1.0 - 2.2 * distance_from_middle(place), 0.0, 1.0);
    }));
    EXPECT_TRUE(
        clear_parts([](const glm::dvec2& place) { return distance_from_middle(place) < 0.3 ? 0.3 : 0.0; }));
    EXPECT_FALSE(clear_parts([](const glm::dvec2&) { return 0.3; }));
}

TEST(CutOuts, AMaskThatCutsNothingIsOpaque)
{
    Scene scene = card([](const glm::dvec2& place) { return 0.6 + 0.4 * place.x; });
    material_of(scene).alpha_mode = AlphaMode::mask;
    find_cut_out_materials(scene);
    EXPECT_EQ(material_of(scene).alpha_mode, AlphaMode::opaque);
}

TEST(CutOuts, FoliageIsWhatIsCutOutToAGoodPart)
{
    const auto is_foliage = [](AlphaMode mode, double least_radius) {
        Scene scene = card(
            [&](const glm::dvec2& place) { return distance_from_middle(place) < least_radius ? 0.0 : 1.0; });
        material_of(scene).alpha_mode = mode;
        find_cut_out_materials(scene);
        return material_of(scene).is_foliage;
    };
    EXPECT_TRUE(is_foliage(AlphaMode::mask, 0.3));
    EXPECT_TRUE(is_foliage(AlphaMode::blend, 0.3));
    EXPECT_FALSE(is_foliage(AlphaMode::mask, 0.1)) << "a wall with a small hole";
    EXPECT_FALSE(is_foliage(AlphaMode::opaque, 0.3));
}

TEST(CutOuts, AClearMaterialStaysBlended)
{
    Scene scene = card([](const glm::dvec2&) { return 1.0; });
    material_of(scene).base_color.w = 0.4F;
    find_cut_out_materials(scene);
    EXPECT_EQ(material_of(scene).alpha_mode, AlphaMode::blend);
}

} // namespace
} // namespace estampe
