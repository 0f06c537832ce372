// SPDX-License-Identifier: MIT
// A cape on a body that walks.
#include <gtest/gtest.h>

#include "frame/bone_capsules.hpp"
#include "set_ups.hpp"
#include "techniques/cloth/cloth_test_support.hpp"

namespace estampe::frame {
namespace {

const Node& cape_of(const Scene& scene)
{
    return *std::ranges::find_if(scene.nodes, [](const Node& node) { return node.cloth.has_value(); });
}

cloth::Sheet sheet_of(const Scene& scene)
{
    const Primitive& primitive = scene.meshes[cape_of(scene).mesh].primitives[0];
    cloth::Sheet sheet{.rest_m = primitive.positions, .held = primitive.held, .cloth = *cape_of(scene).cloth};
    for (size_t i = 0; i < primitive.indices.size(); i += 3) {
        sheet.triangles.emplace_back(primitive.indices[i], primitive.indices[i + 1],
                                     primitive.indices[i + 2]);
    }
    return sheet;
}

TEST(BoneCapsules, AreAsThickAsLimbs)
{
    const Scene scene = make_set_up("cape", 0.5F).scene;
    const std::vector<BoneCapsule> bones = bone_capsules(scene);
    ASSERT_EQ(bones.size(), 14U); // twelve limbs, and from the hips to either leg
    const ScenePose pose = pose_scene(scene, 0.0);
    std::vector<float> radii_m;
    for (const BoneCapsule& bone : bones) {
        const cloth::Solid solid = placed_bone(bone, pose, glm::dvec3(0.0));
        EXPECT_EQ(solid.kind, cloth::SolidKind::capsule);
        radii_m.push_back(solid.half_m.x);
    }
    std::ranges::sort(radii_m);
    EXPECT_NEAR(radii_m[0], 0.045F, 1e-3F); // lower arms
    EXPECT_NEAR(radii_m[1], 0.045F, 1e-3F);
    EXPECT_NEAR(radii_m[2], 0.055F, 1e-3F);
    EXPECT_NEAR(radii_m.back(), 0.15F, 1e-3F);
}

TEST(BoneCapsules, ACapeOnAWalkerNeverEntersThem)
{
    const Scene scene = make_set_up("cape", 0.6F).scene;
    const std::vector<BoneCapsule> bones = bone_capsules(scene);
    const cloth::Sheet sheet = sheet_of(scene);
    const Primitive& primitive = scene.meshes[cape_of(scene).mesh].primitives[0];
    const Skin& skin = scene.skins[cape_of(scene).skin];
    const uint32_t joint = primitive.joints_0[0].x;
    cloth::Lab lab(sheet);
    lab.air.air_kg_m3 = 1.2F;
    const auto go_to = [&](double time_s) {
        const ScenePose pose = pose_scene(scene, time_s);
        const glm::mat4 place =
            glm::mat4(pose.world_from_node[skin.joints[joint]]) * skin.joint_from_bind[joint];
        lab.move_to([&](glm::vec3 rest) { return glm::vec3(place * glm::vec4(rest, 1.0F)); });
        std::vector<cloth::Solid> solids;
        for (const BoneCapsule& bone : bones) {
            solids.push_back(placed_bone(bone, pose, glm::dvec3(0.0)));
        }
        lab.cloths().set_solids(test::shared_device(), solids);
        return solids;
    };
    lab.cloths().forget_before();
    std::ignore = go_to(0.0);
    std::ignore = lab.carry(glm::mat4(0.0F));
    std::ignore = lab.run(0.5);
    double deepest_m = 0.0;
    size_t touching = 0;
    for (int i = 1; i <= 45; ++i) { // a stride and a half
        const std::vector<cloth::Solid> solids = go_to(i / 30.0);
        const cloth::State state = lab.run(1.0 / 30.0);
        for (size_t k = 0; k < state.places_m.size(); ++k) {
            if (sheet.held[k] > 0.0F) {
                continue;
            }
            for (const cloth::Solid& solid : solids) {
                const glm::dvec3 axis(solid.rotation * glm::vec3(0.0F, solid.half_m.y, 0.0F));
                const glm::dvec3 off = state.places_m[k] - glm::dvec3(solid.centre_m);
                const double share = glm::clamp(glm::dot(off, axis) / glm::dot(axis, axis), -1.0, 1.0);
                const double away_m = glm::length(off - share * axis) - double{solid.half_m.x};
                deepest_m = std::max(deepest_m, -away_m);
                touching += away_m < 0.012 ? 1 : 0;
            }
        }
    }
    EXPECT_LE(deepest_m, 1e-3);
    EXPECT_GT(touching, 100U);
}

} // namespace
} // namespace estampe::frame
