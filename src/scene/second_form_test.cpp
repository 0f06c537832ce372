// SPDX-License-Identifier: MIT
#include "scene/smooth_surface.hpp"

#include <gtest/gtest.h>

namespace estampe {
namespace {

/// Sides of a triangle on a surface whose normals change by `form` times the offset.
std::array<SideChange, 3> sides_of(const std::array<glm::dvec2, 3>& corners, const glm::dvec3& form)
{
    const glm::dmat2 changes(form.x, form.y, form.y, form.z);
    std::array<SideChange, 3> sides;
    for (size_t k = 0; k < 3; ++k) {
        const glm::dvec2 way = corners.at((k + 1) % 3) - corners.at(k);
        sides.at(k) = {way, changes * way};
    }
    return sides;
}

constexpr std::array<glm::dvec2, 3> corners{glm::dvec2(0.1, 0.2), glm::dvec2(1.3, 0.4), glm::dvec2(0.5, 1.7)};

TEST(SecondForm, IsThatOfASurfaceWhoseNormalsChangeEvenly)
{
    for (const glm::dvec3 form : {glm::dvec3(0.5, 0.0, 0.5), glm::dvec3(2.0, -0.3, -1.0)}) {
        const glm::dvec3 found = second_form(sides_of(corners, form), 1e-12);
        EXPECT_LT(glm::distance(found, form), 1e-12);
    }
}

TEST(SecondForm, ATriangleWithoutBreadthDoesNotBend)
{
    const std::array<glm::dvec2, 3> line{glm::dvec2(0.0), glm::dvec2(1.0, 0.0), glm::dvec2(3.0, 0.0)};
    EXPECT_EQ(second_form(sides_of(line, {1.0, 0.0, 1.0}), 1e-12), glm::dvec3(0.0));
    EXPECT_EQ(second_form(sides_of(corners, {1.0, 0.0, 1.0}), 1.0), glm::dvec3(0.0));
}

} // namespace
} // namespace estampe
