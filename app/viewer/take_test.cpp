// SPDX-License-Identifier: MIT
#include "viewer/picture_thread.hpp"

#include <gtest/gtest.h>

namespace estampe::viewer {
namespace {

TEST(Take, GoesStraightBetweenWhatWasSeen)
{
    const auto first = std::make_shared<const app::ChosenStyle>();
    const auto second = std::make_shared<const app::ChosenStyle>();
    Take take;
    take.add({.at_s = 0.0, .camera = {.eye = {0.0, 0.0, 4.0}}, .time_s = 0.2, .style = first});
    take.add({.at_s = 2.0, .camera = {.eye = {2.0, 0.0, 4.0}}, .time_s = 1.2, .style = second});
    take.add({.at_s = 3.0, .camera = {.eye = {2.0, 0.0, 4.0}}, .time_s = 0.1, .style = second});
    EXPECT_EQ(take.length_s(), 3.0);
    const Take::Sample middle = take.at(1.0);
    EXPECT_EQ(middle.camera.eye, glm::dvec3(1.0, 0.0, 4.0));
    EXPECT_NEAR(middle.time_s, 0.7, 1e-12);
    EXPECT_EQ(middle.style, first);
    EXPECT_EQ(take.at(2.5).time_s, 1.2) << "an animation that began anew is not run backwards";
    EXPECT_EQ(take.at(9.0).time_s, 0.1);
    EXPECT_EQ(take.at(2.0).style, second);
}

} // namespace
} // namespace estampe::viewer
