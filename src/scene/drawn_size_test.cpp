// SPDX-License-Identifier: MIT
#include "scene/scene_limits.hpp"

#include <gtest/gtest.h>

#include <estampe/error.hpp>
#include <estampe/shapes.hpp>

#include "core/job_limits.hpp"
#include "scene/static_triangles.hpp"
#include "support/scenes.hpp"
#include "techniques/pose/mesh_data.hpp"

namespace estampe {
namespace {

std::string refusal_of(const Scene& scene)
{
    try {
        check_drawn_size(scene);
    } catch (const Error& error) {
        return error.what();
    }
    return {};
}

TEST(DrawnSize, CountsWhatIsPutOnTheDevice)
{
    Scene scene = test::scene_of(shapes::box({1.0F, 1.0F, 1.0F}));
    scene.nodes[0].instances.resize(5, glm::mat4(1.0F));
    test::add_object(scene, shapes::sphere(1.0F), glm::vec3(1.0F));
    Primitive lines;
    lines.topology = Topology::lines;
    lines.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}};
    lines.indices = {0, 1, 1, 2};
    test::add_object(scene, lines, glm::vec3(1.0F));
    lines.topology = Topology::points;
    test::add_object(scene, lines, glm::vec3(1.0F));
    const pose::MeshData built = pose::build_meshes(scene, static_cast<Index>(scene.materials.size() - 1));
    const DrawnSize size = drawn_size(scene);
    EXPECT_EQ(size.vertices + 4, built.draw_of_vertex.size()) << "and four of the ground";
    EXPECT_EQ(size.triangles + 2, built.triangles.size());
    EXPECT_EQ(refusal_of(scene), "");
}

TEST(DrawnSize, RefusesAMeshThatIsShownTooOften)
{
    Scene scene = test::scene_of(shapes::sphere(1.0F, 512, 512));
    scene.name = "swarm";
    const size_t vertices = scene.meshes[0].primitives[0].positions.size();
    scene.nodes[0].instances.resize((size_t{1} << 31U) / vertices + 1, glm::mat4(1.0F));
    EXPECT_NE(refusal_of(scene).find("swarm: the scene shows "), std::string::npos) << refusal_of(scene);
    EXPECT_THROW(static_cast<void>(framing_camera(scene, pose_scene(scene, 0.0), 1.0)), Error);
    EXPECT_THROW(static_cast<void>(static_triangles(scene)), Error);
    EXPECT_THROW(static_cast<void>(pose::build_meshes(scene, 0)), Error);
}

TEST(DrawnSize, ALimitOnMemoryCountsTexturesToo)
{
    Scene scene = test::scene_of(shapes::sphere(1.0F, 256, 256));
    scene.name = "ball";
    WorkLimits limits;
    limits.max_memory_bytes = uint64_t{8} << 30U;
    const JobLimits of_test(limits);
    EXPECT_EQ(refusal_of(scene), "");
    scene.nodes[0].instances.resize(1000, glm::mat4(1.0F));
    const std::string many = refusal_of(scene);
    EXPECT_TRUE(many.starts_with("ball: drawing ")) << many;
    EXPECT_NE(many.find("more than 8.0 GiB, the limit of --max-memory; use a lighter scene"),
              std::string::npos)
        << many;
    scene.nodes[0].instances.clear();
    scene.textures.resize(1);
    scene.textures[0].image.width = scene.textures[0].image.height = 40000;
    EXPECT_NE(refusal_of(scene).find("--max-memory"), std::string::npos) << refusal_of(scene);
}

} // namespace
} // namespace estampe
