// SPDX-License-Identifier: MIT
#include "techniques/motion_blur/alternatives/within_outline.hpp"

#include <array>

#include <gtest/gtest.h>

namespace estampe::motion_blur {
namespace {

TEST(Stretch, ListsVerticesAtOnePlaceOfOneDraw)
{
    const std::array<glm::vec3, 6> places{glm::vec3(1, 0, 0), glm::vec3(0, 0, 0), glm::vec3(1, 0, 0),
                                          glm::vec3(1, 0, 0), glm::vec3(0, 0, 0), glm::vec3(0, 0, 1)};
    const std::array<uint32_t, 6> draws{0, 0, 0, 1, 0, 1};
    const CoincidentList list = list_coincident(places, draws);
    const auto members_of = [&](size_t vertex) {
        const glm::uvec2 part = list.of_vertex[vertex];
        return std::vector<uint32_t>(list.members.begin() + part.x, list.members.begin() + part.x + part.y);
    };
    EXPECT_EQ(members_of(0), (std::vector<uint32_t>{0, 2}));
    EXPECT_EQ(members_of(2), (std::vector<uint32_t>{0, 2}));
    EXPECT_EQ(members_of(1), (std::vector<uint32_t>{1, 4}));
    EXPECT_EQ(members_of(3), std::vector<uint32_t>{3}) << "of another draw";
    EXPECT_EQ(members_of(5), std::vector<uint32_t>{5});
    EXPECT_TRUE(list_coincident({}, {}).members.empty());
}

} // namespace
} // namespace estampe::motion_blur
