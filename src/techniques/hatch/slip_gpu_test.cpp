// SPDX-License-Identifier: MIT
// Strokes stick to a deforming body: in every frame of a clip, each pixel's stroke coordinate is the
// rest-pose position of the point that the pixel shows.
#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>
#include <gtest/gtest.h>

#include <estampe/shapes.hpp>

#include "support/drawing.hpp"
#include "support/scenes.hpp"

namespace estampe {
namespace {

constexpr glm::uvec2 slip_page_px{320, 240};

/// An arm of 4 m that bends at its middle by 80 degrees within a second.
Scene bending_arm()
{
    std::vector<glm::vec2> profile{{0.0F, 0.0F}};
    for (int i = 0; i <= 32; ++i) {
        profile.emplace_back(0.5F, 0.125F * static_cast<float>(i));
    }
    profile.emplace_back(0.0F, 4.0F);
    Primitive arm = shapes::lathe(profile, 32);
    arm.uvs[0].clear();
    for (const glm::vec3& position : arm.positions) {
        const float bent = glm::smoothstep(1.4F, 2.6F, position.y);
        arm.joints_0.emplace_back(0, 1, 0, 0);
        arm.weights_0.emplace_back(1.0F - bent, bent, 0.0F, 0.0F);
    }
    Scene scene = test::scene_of(std::move(arm));
    scene.skins.emplace_back();
    scene.nodes[0].skin = 0;
    for (Index joint = 1; joint <= 2; ++joint) {
        const float height = joint == 1 ? 0.0F : 2.0F;
        scene.skins[0].joints.push_back(joint);
        scene.skins[0].joint_from_bind.push_back(glm::translate(glm::mat4(1.0F), {0.0F, -height, 0.0F}));
        scene.nodes.push_back({.parent = joint == 1 ? no_index : 1U,
                               .transform = {.translation = {0.0, static_cast<double>(height), 0.0}}});
    }
    scene.nodes[1].children.push_back(2);
    scene.roots.push_back(1);
    const glm::quat bent = glm::angleAxis(glm::radians(80.0F), glm::vec3(0.0F, 0.0F, 1.0F));
    scene.animations.push_back({.channels = {{.node = 2,
                                              .path = AnimatedPath::rotation,
                                              .times_s = {0.0F, 1.0F},
                                              .values = {0, 0, 0, 1, bent.x, bent.y, bent.z, bent.w}}},
                                .duration_s = 1.0F});
    return scene;
}

/// Largest distance on the page, over ten moments, between a stroke and its point on the surface.
double slip_px(const Scene& scene, const Camera& camera)
{
    double worst = 0.0;
    size_t looked_at = 0;
    for (int moment = 0; moment < 10; ++moment) {
        const double time_s = static_cast<double>(scene.animations[0].duration_s) * moment / 9.0;
        test::Drawing drawing(scene, camera, slip_page_px, time_s);
        const auto surface = drawing.surface();
        const auto page = drawing.visibility();
        const auto posed = drawing.posed();
        for (size_t i = 0; i < page.size(); ++i) {
            if (page[i] == 0 || (surface.draw[i] >> 26U & 7U) != 0) {
                continue; // background, or strokes that follow UVs
            }
            const glm::uvec4 corners = drawing.layout.triangles[static_cast<uint32_t>(page[i])];
            const size_t row = i / slip_page_px.x;
            const glm::dvec3 from = drawing.point_at(
                {static_cast<double>(i % slip_page_px.x) + 0.5, static_cast<double>(row) + 0.5},
                static_cast<double>(surface.depth[i]));
            const glm::dvec3 a(posed[corners.x].position);
            const glm::dvec3 e1 = glm::dvec3(posed[corners.y].position) - a;
            const glm::dvec3 e2 = glm::dvec3(posed[corners.z].position) - a;
            const glm::dvec3 normal = glm::cross(e1, e2);
            if (glm::dot(normal, normal) < 1e-24) {
                continue;
            }
            const double v = glm::dot(glm::cross(from - a, e2), normal) / glm::dot(normal, normal);
            const double w = glm::dot(glm::cross(e1, from - a), normal) / glm::dot(normal, normal);
            const auto& rest = drawing.layout.stroke_coordinates;
            const glm::dvec3 expected = glm::dvec3(rest[corners.x]) * (1.0 - v - w) +
                                        glm::dvec3(rest[corners.y]) * v + glm::dvec3(rest[corners.z]) * w;
            const double per_px = std::max(glm::length(glm::dvec3(surface.footprint_dx[i])),
                                           glm::length(glm::dvec3(surface.footprint_dy[i])));
            worst = std::max(worst, glm::distance(expected, glm::dvec3(surface.coordinate[i])) / per_px);
            ++looked_at;
        }
    }
    EXPECT_GT(looked_at, 5000U);
    return worst;
}

TEST(HatchSlip, StrokesStickToABendingArm)
{
    const double slip = slip_px(bending_arm(), {.eye = {-1.0, 3.0, 7.0}, .target = {-0.8, 2.0, 0.0}});
    fmt::print("worst slip {:.4f} px\n", slip);
    EXPECT_LT(slip, 0.5);
}

TEST(HatchSlip, StrokesStickToModelsThatAreAtHand)
{
    const char* folder = std::getenv("ESTAMPE_MODELS");
    std::vector<std::filesystem::path> paths;
    if (folder != nullptr) {
        for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
            if (entry.path().extension() == ".glb") {
                paths.push_back(entry.path());
            }
        }
    }
    for (const std::filesystem::path& path : paths) {
        Scene scene = load_scene(path);
        if (scene.animations.empty()) {
            continue;
        }
        for (Mesh& mesh : scene.meshes) {
            for (Primitive& primitive : mesh.primitives) {
                primitive.uvs[0].clear(); // makes all strokes follow the rest pose
            }
        }
        const ScenePose pose = pose_scene(scene, 0.0);
        const double slip = slip_px(scene, framing_camera(scene, pose, 4.0 / 3.0));
        fmt::print("{}: worst slip {:.4f} px\n", path.filename().string(), slip);
        EXPECT_LT(slip, 0.5) << path;
    }
}

} // namespace
} // namespace estampe
