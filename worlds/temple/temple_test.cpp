// SPDX-License-Identifier: MIT
#include "temple/temple.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <string>

#include <gtest/gtest.h>

#include "temple/site.hpp"

namespace temple {
namespace {

using estampe::Scene;

/// FNV-1a hash of everything that is drawn.
uint64_t hash_of(const Scene& scene)
{
    uint64_t hash = 0xcbf29ce484222325U;
    const auto add = [&hash](const void* data, size_t size) {
        const auto* bytes = static_cast<const unsigned char*>(data);
        for (size_t i = 0; i < size; ++i) {
            hash = (hash ^ bytes[i]) * 0x100000001b3U;
        }
    };
    for (const estampe::Mesh& mesh : scene.meshes) {
        for (const estampe::Primitive& part : mesh.primitives) {
            add(part.positions.data(), part.positions.size() * sizeof(glm::vec3));
            add(part.normals.data(), part.normals.size() * sizeof(glm::vec3));
            add(part.uvs[0].data(), part.uvs[0].size() * sizeof(glm::vec2));
            add(part.indices.data(), part.indices.size() * sizeof(uint32_t));
            add(part.edge_marks.data(), part.edge_marks.size());
        }
    }
    for (const estampe::Node& node : scene.nodes) {
        add(&node.transform.translation, sizeof(glm::dvec3));
    }
    const std::string ground = estampe::terrain_toml(scene.terrain->description());
    add(ground.data(), ground.size());
    for (double x = -90.0; x < 90.0; x += 7.3) {
        const double height_m = scene.terrain->sample(x, 0.7 * x, 3.0).height_m;
        add(&height_m, sizeof height_m);
    }
    return hash;
}

size_t triangles_of(const Scene& scene)
{
    size_t indices = 0;
    for (const estampe::Mesh& mesh : scene.meshes) {
        for (const estampe::Primitive& part : mesh.primitives) {
            indices += part.indices.size();
        }
    }
    return indices / 3;
}

TEST(Temple, TheSameNumberGivesTheSameTempleAndAnotherAnother)
{
    const uint64_t first = hash_of(build_temple(5));
    EXPECT_EQ(first, hash_of(build_temple(5)));
    EXPECT_NE(first, hash_of(build_temple(6)));
}

TEST(Temple, IsOfASizeThatCanBeDrawn)
{
    const Scene scene = build_temple(1);
    EXPECT_EQ(estampe::faults(scene), std::vector<std::string>());
    EXPECT_GT(triangles_of(scene), 150'000U);
    EXPECT_LT(triangles_of(scene), 600'000U);
    EXPECT_LT(scene.meshes.size(), 200U);
    size_t flags = 0;
    for (const estampe::Node& node : scene.nodes) {
        flags += node.cloth ? 1U : 0U;
    }
    EXPECT_EQ(flags, 12U);
    for (const estampe::Mesh& mesh : scene.meshes) {
        for (const estampe::Primitive& part : mesh.primitives) {
            for (const glm::vec3& normal : part.normals) {
                ASSERT_NEAR(glm::length(normal), 1.0F, 1e-3F) << mesh.name;
            }
            ASSERT_TRUE(part.edge_marks.empty() || part.edge_marks.size() == part.indices.size() / 3)
                << mesh.name;
        }
    }
}

TEST(Temple, HasTwelveViewpointsOverTheGround)
{
    for (const uint64_t seed : {1U, 2U, 3U}) {
        const Scene scene = build_temple(seed);
        const estampe::ScenePose pose = estampe::pose_scene(scene, 0.0);
        std::set<std::string> names;
        for (const estampe::SceneCamera& camera : scene.cameras) {
            names.insert(camera.name);
            const glm::dvec3 eye = estampe::scene_camera(scene, pose, camera.name).eye;
            EXPECT_GT(eye.y, scene.terrain->sample(eye.x, eye.z).height_m + 1.2) << camera.name;
        }
        EXPECT_EQ(names.size(), 12U);
    }
}

/// Objects in the sand reach below it wherever that could be visible.
TEST(Temple, NothingFloatsOverTheSand)
{
    for (const uint64_t seed : {1U, 2U, 3U}) {
        const Scene scene = build_temple(seed);
        for (const estampe::Node& node : scene.nodes) {
            constexpr std::array in_sand{"arcade",   "eastern arcade", "gate",    "poles", "figure",
                                         "colossus", "head",           "hand",    "tower", "far tower",
                                         "walls",    "piers",          "portico", "drum",  "column"};
            const bool is_in_sand =
                std::ranges::any_of(in_sand, [&](const char* name) { return node.name.starts_with(name); });
            if (!is_in_sand || node.mesh == estampe::no_index) {
                continue;
            }
            float lowest_m = 1e9F;
            for (const estampe::Primitive& part : scene.meshes[node.mesh].primitives) {
                for (const glm::vec3& place : part.positions) {
                    lowest_m = std::min(lowest_m, place.y);
                }
            }
            const glm::dvec3& foot = node.transform.translation;
            // The columns of the portico stand on its platform.
            const bool is_on_platform =
                std::abs(foot.x) < stairs_half_m && foot.z < stairs_foot_m && foot.z > front_z_m;
            const double ground_m = is_on_platform ? floor_m : scene.terrain->sample(foot.x, foot.z).height_m;
            EXPECT_LT(foot.y + lowest_m, ground_m + 0.01) << node.name << " of " << seed;
        }
    }
}

} // namespace
} // namespace temple
