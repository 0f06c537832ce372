// SPDX-License-Identifier: MIT
// A cape on a walking body.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <functional>

#include "features/cloth/cloth_solids.hpp"
#include "gpu/resources.hpp"
#include "set_ups.hpp"
#include "techniques/cloth/cloth_test_support.hpp"

namespace estampe::features {
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
    ASSERT_EQ(bones.size(), 14U); // twelve limbs, and two from the hips to the legs
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

/// A body with a cape, and the motion of what holds the cape.
struct Worn {
    const Scene& scene;
    cloth::Sheet sheet;
    std::function<glm::mat4(const ScenePose& pose)> place; ///< transform of the sheet
};

/// How a cape moved and how deep it sank in.
struct Wear {
    double deepest_m = 0.0; ///< in any capsule, or in a visible body
    double off_shoulders_m = 0.0;
    size_t touching = 0;
};

/// Distance from a place to a capsule's surface, negative inside.
double away_from_m(const cloth::Solid& capsule, const glm::dvec3& place_m)
{
    const glm::dvec3 axis(capsule.rotation * glm::vec3(0.0F, capsule.half_m.y, 0.0F));
    const glm::dvec3 off = place_m - glm::dvec3(capsule.centre_m);
    const double share = glm::clamp(glm::dot(off, axis) / glm::dot(axis, axis), -1.0, 1.0);
    return glm::length(off - share * axis) - double{capsule.half_m.x};
}

/// A scene's bodies posed on the CPU, for a cloth test without a renderer.
class PosedBodies {
public:
    PosedBodies(const Scene& scene, cloth::Lab& lab)
        : scene_(scene), lab_(lab), layout_(pose::build_meshes(scene, 0)),
          bodies_(seen_bodies(scene, layout_))
    {
        std::vector<cloth::Body> meshes;
        for (const SeenBody& body : bodies_) {
            meshes.push_back(body.mesh);
        }
        lab_.cloths().set_bodies(test::shared_device(), meshes);
    }

    /// Sets the bodies' pose at the end of the next run.
    void go_to(const ScenePose& pose)
    {
        const glm::vec3 anchor(layout_.anchor);
        const pose::PoseData data = pose::pose_meshes(layout_, scene_, pose);
        vertices_.assign(layout_.draw_of_vertex.size(), {});
        for (size_t draw = 0; draw < layout_.sources.size(); ++draw) {
            const pose::DrawSource& source = layout_.sources[draw];
            const Primitive& primitive =
                scene_.meshes[scene_.nodes[source.node].mesh].primitives[source.primitive];
            const shared::DrawRecord& record = data.draws[draw];
            for (size_t i = 0; i < primitive.joints_0.size(); ++i) {
                glm::vec3 place(0.0F);
                for (int k = 0; k < 4; ++k) {
                    const glm::mat4& joint = data.joints[record.first_joint + primitive.joints_0[i][k]];
                    place += primitive.weights_0[i][k] *
                             glm::vec3(joint * glm::vec4(primitive.positions[i], 1.0F));
                }
                vertices_[record.first_posed_vertex + i].position = place + anchor;
            }
        }
        posed_ = gpu::upload_buffer(test::shared_device(), "posed", vertices_);
        solids_.clear();
        for (uint32_t i = 0; i < bodies_.size(); ++i) {
            solids_.push_back(placed_body(bodies_[i], layout_, data, i));
            solids_.back().centre_m += anchor;
        }
        lab_.cloths().set_solids(test::shared_device(), solids_);
        lab_.at_first = [this](gpu::Graph& graph, cloth::Cloths::Handles& handles) {
            lab_.cloths().add_bodies(graph, handles, gpu::import_whole(graph, "posed", posed_));
        };
    }

    /// How deep a place is inside a body, judged by the triangles before and behind it; 0 outside.
    [[nodiscard]] double depth_m(const glm::dvec3& place_m) const
    {
        double deepest_m = 0.0;
        for (size_t i = 0; i < bodies_.size(); ++i) {
            const glm::quat back = glm::inverse(solids_[i].rotation);
            const auto own_of = [&](const glm::vec3& place) { return back * (place - glm::vec3(place_m)); };
            float front_m = -1.0F;
            float behind_m = -1.0F;
            float nearest_m = 1.0F;
            for (const glm::uvec3& triangle : bodies_[i].mesh.triangles) {
                const glm::vec3 a = own_of(vertices_[triangle.x].position);
                const glm::vec3 b = own_of(vertices_[triangle.y].position);
                const glm::vec3 c = own_of(vertices_[triangle.z].position);
                const glm::vec3 shares(b.x * c.y - b.y * c.x, c.x * a.y - c.y * a.x, a.x * b.y - a.y * b.x);
                const float sum = shares.x + shares.y + shares.z;
                nearest_m = std::min(nearest_m, glm::length(a));
                if (sum != 0.0F && glm::all(glm::greaterThanEqual(shares / sum, glm::vec3(0.0F)))) {
                    const float z_m = glm::dot(shares / sum, glm::vec3(a.z, b.z, c.z));
                    front_m = std::max(front_m, z_m);
                    behind_m = std::max(behind_m, -z_m);
                }
            }
            deepest_m = std::max(deepest_m, double{std::min({front_m, behind_m, nearest_m})});
        }
        return deepest_m;
    }

private:
    const Scene& scene_;
    cloth::Lab& lab_;
    std::vector<shared::PosedVertex> vertices_;
    std::vector<cloth::Solid> solids_;
    pose::MeshData layout_;
    std::vector<SeenBody> bodies_;
    gpu::Buffer posed_;
};

/// Simulates half a second at rest, and `seconds` of motion. Measures the depth within visible bodies by
/// their triangles.
Wear worn_for(const Worn& worn, double seconds, cloth::ClothBodies kind = cloth::ClothBodies::capsules)
{
    const std::vector<BoneCapsule> bones = bone_capsules(worn.scene);
    cloth::Lab lab(worn.sheet);
    lab.air.air_kg_m3 = 1.2F;
    std::optional<PosedBodies> posed;
    if (kind == cloth::ClothBodies::depth) {
        posed.emplace(worn.scene, lab);
    }
    std::vector<cloth::Solid> solids;
    glm::mat4 place(1.0F);
    const auto go_to = [&](double time_s) {
        const ScenePose pose = pose_scene(worn.scene, time_s);
        place = worn.place(pose);
        lab.move_to([&](glm::vec3 rest) { return glm::vec3(place * glm::vec4(rest, 1.0F)); });
        solids.clear();
        for (const BoneCapsule& bone : bones) {
            solids.push_back(placed_bone(bone, pose, glm::dvec3(0.0)));
        }
        if (posed) {
            posed->go_to(pose);
        } else {
            lab.cloths().set_solids(test::shared_device(), solids);
        }
    };
    lab.cloths().forget_before();
    go_to(0.0);
    std::ignore = lab.carry(glm::mat4(0.0F));
    std::ignore = lab.run(0.5);
    Wear wear;
    for (int i = 1; i <= std::lround(30.0 * seconds); ++i) {
        go_to(i / 30.0);
        const cloth::State state = lab.run(1.0 / 30.0);
        for (size_t k = 0; k < state.places_m.size(); ++k) {
            if (worn.sheet.held[k] > 0.0F) {
                const glm::dvec3 wanted_m(place * glm::vec4(worn.sheet.rest_m[k], 1.0F));
                wear.off_shoulders_m =
                    std::max(wear.off_shoulders_m, glm::distance(state.places_m[k], wanted_m));
                continue;
            }
            if (posed) {
                wear.deepest_m = std::max(wear.deepest_m, posed->depth_m(state.places_m[k]));
            }
            for (const cloth::Solid& solid : solids) {
                const double away_m = away_from_m(solid, state.places_m[k]);
                wear.deepest_m = std::max(wear.deepest_m, posed ? 0.0 : -away_m);
                wear.touching += away_m < 0.012 ? 1 : 0;
            }
        }
    }
    return wear;
}

/// Two strides of the walker in its cape.
Wear walked(cloth::ClothBodies kind)
{
    const Scene scene = make_set_up("cape", 0.6F).scene;
    const Skin& skin = scene.skins[cape_of(scene).skin];
    const uint32_t joint = scene.meshes[cape_of(scene).mesh].primitives[0].joints_0[0].x;
    return worn_for({.scene = scene,
                     .sheet = sheet_of(scene),
                     .place =
                         [&](const ScenePose& pose) {
                             return glm::mat4(pose.world_from_node[skin.joints[joint]]) *
                                    skin.joint_from_bind[joint];
                         }},
                    2.0, kind);
}

TEST(SeenBodies, ACapeOnAWalkerNeverEntersThem)
{
    const Wear wear = walked(cloth::ClothBodies::depth);
    EXPECT_LE(wear.off_shoulders_m, 1e-5);
    EXPECT_GT(wear.touching, 100U);
}

TEST(BoneCapsules, ACapeOnAWalkerNeverEntersThem)
{
    const Wear wear = walked(cloth::ClothBodies::capsules);
    EXPECT_LE(wear.deepest_m, 1e-3);
    EXPECT_LE(wear.off_shoulders_m, 1e-5);
    EXPECT_GT(wear.touching, 100U);
}

Index node_named(const Scene& scene, const std::string& name)
{
    const auto found = std::ranges::find_if(scene.nodes, [&](const Node& node) { return node.name == name; });
    return static_cast<Index>(found - scene.nodes.begin());
}

/// A quarter of a cone around the back, from the shoulders down, along the world's axes. The arms pass
/// through the sides of capsule bodies, and must not pinch the cape.
cloth::Sheet cape_about(glm::dvec3 shoulders_m, glm::dvec3 back, double shoulder_m)
{
    cloth::Sheet sheet = cloth::grid_sheet({23, 25}, {}, {1.0F, 0.0F, 0.0F}, {0.0F, -1.0F, 0.0F},
                                           {.density_kg_m2 = 0.25F, .bending_n_m = 1e-4F});
    const glm::dvec3 across = glm::cross(back, glm::dvec3(0.0, 1.0, 0.0));
    for (glm::vec3& place : sheet.rest_m) {
        const double angle = (double{place.x} - 0.5) * 1.7;
        const double radius_m = shoulder_m * (2.0 - 1.3 * double{place.y});
        sheet.held.push_back(place.y == 0.0F ? 1.0F : 0.0F);
        place = glm::vec3(shoulders_m + radius_m * (std::cos(angle) * back + std::sin(angle) * across) +
                          glm::dvec3(0.0, 5.5 * shoulder_m * double{place.y}, 0.0));
    }
    return sheet;
}

/// Two strides of the model CesiumMan in a cape; none if the folder of the model is not given.
std::optional<Wear> model_walked(cloth::ClothBodies kind)
{
    const char* folder = std::getenv("ESTAMPE_MODELS");
    if (folder == nullptr) {
        return std::nullopt;
    }
    const Scene scene =
        load_scene(std::filesystem::path(folder) / "CesiumMan" / "glTF-Binary" / "CesiumMan.glb");
    const ScenePose pose = pose_scene(scene, 0.0);
    const auto place_of = [&](const char* name) {
        return glm::dvec3(pose.world_from_node.at(node_named(scene, name))[3]);
    };
    const glm::dvec3 left_m = place_of("Skeleton_arm_joint_L__4_");
    const glm::dvec3 right_m = place_of("Skeleton_arm_joint_R");
    glm::dvec3 back = glm::normalize(glm::cross(glm::dvec3(0.0, 1.0, 0.0), right_m - left_m));
    const glm::dvec3 toes = place_of("leg_joint_R_5") - place_of("leg_joint_R_3");
    back *= glm::dot(back, toes) > 0.0 ? -1.0 : 1.0;
    const Index chest = node_named(scene, "torso_joint_3");
    const glm::dmat4 chest_from_world = glm::inverse(pose.world_from_node.at(chest));
    return worn_for(
        {.scene = scene,
         .sheet = cape_about(0.5 * (left_m + right_m), back, 0.5 * glm::distance(left_m, right_m)),
         .place =
             [&](const ScenePose& now) { return glm::mat4(now.world_from_node[chest] * chest_from_world); }},
        2.0 * scene.animations.at(0).duration_s, kind);
}

TEST(BoneCapsules, ACapeOnAModelThatWalksNeverEntersThem)
{
    if (const auto wear = model_walked(cloth::ClothBodies::capsules)) {
        EXPECT_LE(wear->deepest_m, 1e-3);
        EXPECT_LE(wear->off_shoulders_m, 1e-5);
        EXPECT_GT(wear->touching, 100U);
    }
}

TEST(SeenBodies, ACapeOnAModelThatWalksNeverEntersIt)
{
    if (const auto wear = model_walked(cloth::ClothBodies::depth)) {
        EXPECT_LE(wear->deepest_m, 1e-3);
        EXPECT_LE(wear->off_shoulders_m, 1e-5);
        EXPECT_GT(wear->touching, 100U);
    }
}

} // namespace
} // namespace estampe::features
