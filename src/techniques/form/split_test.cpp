// SPDX-License-Identifier: MIT
#include "techniques/form/split.hpp"

#include <gtest/gtest.h>

#include "techniques/form/form_test_meshes.hpp"

namespace estampe::form {
namespace {

using namespace test;

TEST(FormSplit, KeepsEveryCornerAndCopiesFewVertices)
{
    const TestMesh mesh = ball(24, [](const glm::vec3& p) { return glm::vec3(1.5F, 1.0F, 0.8F) * p; });
    const FormField field = follow(mesh, 0.25F);
    const auto count = static_cast<uint32_t>(mesh.positions.size());
    const SplitMesh split = split_at_jumps(mesh.indices, count, field);
    ASSERT_EQ(split.indices.size(), mesh.indices.size());
    ASSERT_EQ(split.sources.size(), split.coordinates.size());
    for (size_t i = 0; i < split.indices.size(); ++i) {
        ASSERT_EQ(split.sources[split.indices[i]], mesh.indices[i]);
        ASSERT_LT(glm::distance(split.coordinates[split.indices[i]], field.corners[i / 3][i % 3]), 1e-3F);
    }
    EXPECT_GT(split.sources.size(), count);
    EXPECT_LT(split.sources.size(), count + count / 5);
}

TEST(FormSplit, LeavesWholeMeshesAlone)
{
    const TestMesh mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {9, 9, 9}}, {0, 1, 2}};
    const SplitMesh split = split_at_jumps(mesh.indices, 4, follow(mesh, 0.5F));
    EXPECT_EQ(split.indices, mesh.indices);
    EXPECT_EQ(split.sources, (std::vector<uint32_t>{0, 1, 2, 3}));
    EXPECT_EQ(split.coordinates[3], glm::vec2(0.0F));
}

} // namespace
} // namespace estampe::form
