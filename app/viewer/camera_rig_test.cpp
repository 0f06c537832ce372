// SPDX-License-Identifier: MIT
#include "viewer/camera_rig.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace estampe::viewer {
namespace {

constexpr double tolerance = 1e-9;

Bounds box(double half_m)
{
    Bounds bounds;
    bounds.extend(glm::dvec3(-half_m));
    bounds.extend(glm::dvec3(half_m));
    return bounds;
}

CameraRig rig_of(const Camera& home, double half_m = 1.0)
{
    CameraRig rig;
    rig.set_scene(home, box(half_m));
    return rig;
}

double distance(const Camera& camera)
{
    return glm::length(camera.eye - camera.target);
}

TEST(CameraRig, OrbitKeepsDistanceAndTargetAndNeverTurnsOver)
{
    CameraRig rig = rig_of({.eye = {3.0, 2.0, 4.0}});
    const double before = distance(rig.camera());
    for (int i = 0; i < 300; ++i) {
        rig.turn({0.013 * i, 0.07});
        EXPECT_NEAR(distance(rig.camera()), before, 1e-6);
        EXPECT_EQ(rig.camera().target, glm::dvec3(0.0));
        const glm::dvec3 right = glm::cross(rig.camera().target - rig.camera().eye, rig.camera().up);
        EXPECT_GT(glm::length(right), 1e-3) << "the eye stands over the head";
    }
    EXPECT_GT(rig.camera().eye.y, 0.9 * before) << "a drag down looks from above";
}

TEST(CameraRig, DragsUpAndDownEndAtThePoles)
{
    for (const double drag : {0.07, -0.07}) {
        CameraRig rig = rig_of({.eye = {3.0, 0.0, 4.0}});
        const glm::dvec3 right = glm::cross(-rig.camera().eye, rig.camera().up);
        for (int i = 0; i < 100; ++i) {
            rig.turn({0.0, drag});
            EXPECT_GT(glm::dot(glm::cross(-rig.camera().eye, rig.camera().up), right), 0.0) << i;
        }
        EXPECT_GT(std::copysign(rig.camera().eye.y, rig.camera().eye.y * drag), 4.9);
    }
}

TEST(CameraRig, DragOfTheViewsHeightGoesHalfAround)
{
    CameraRig rig = rig_of({.eye = {0.0, 0.0, 5.0}});
    rig.turn({1.0, 0.0});
    EXPECT_NEAR(rig.camera().eye.z, -5.0, tolerance);
    CameraRig small = rig_of({.eye = {0.0, 0.0, 5.0}});
    small.turn({0.1, 0.0});
    EXPECT_LT(small.camera().eye.x, 0.0) << "what is near follows the pointer to the right";
}

TEST(CameraRig, PanMovesWhatIsLookedAtWithThePointer)
{
    const Camera home{.eye = {0.0, 0.0, 5.0}, .vertical_fov_rad = 0.6};
    CameraRig rig = rig_of(home);
    rig.pan({0.5, 0.25});
    const double height_m = 2.0 * 5.0 * std::tan(0.3);
    EXPECT_NEAR(rig.camera().target.x, -0.5 * height_m, tolerance);
    EXPECT_NEAR(rig.camera().target.y, 0.25 * height_m, tolerance);
    EXPECT_NEAR(distance(rig.camera()), 5.0, tolerance);
}

TEST(CameraRig, ZoomComesNearerAndNeverThrough)
{
    CameraRig rig = rig_of({.eye = {0.0, 0.0, 5.0}});
    rig.zoom(3.0);
    EXPECT_NEAR(distance(rig.camera()), 5.0 * std::pow(0.9, 3.0), tolerance);
    rig.zoom(1000.0);
    EXPECT_GT(distance(rig.camera()), 0.0);
    EXPECT_GT(rig.camera().eye.z, 0.0);
    rig.zoom(-1e6);
    EXPECT_TRUE(std::isfinite(distance(rig.camera())));
}

TEST(CameraRig, ParallelProjectionShowsTheTargetAsLarge)
{
    const Camera home{.eye = {0.0, 0.0, 5.0}, .vertical_fov_rad = 0.6};
    CameraRig rig = rig_of(home);
    rig.toggle_projection();
    ASSERT_TRUE(rig.camera().orthographic_half_height_m);
    EXPECT_NEAR(*rig.camera().orthographic_half_height_m, 5.0 * std::tan(0.3), tolerance);
    rig.zoom(1.0);
    EXPECT_NEAR(*rig.camera().orthographic_half_height_m, 0.9 * 5.0 * std::tan(0.3), tolerance);
    rig.toggle_projection();
    EXPECT_FALSE(rig.camera().orthographic_half_height_m);
}

TEST(CameraRig, FlyingTurnsTheLookAndLeavesTheEye)
{
    CameraRig rig = rig_of({.eye = {0.0, 1.0, 5.0}, .target = {0.0, 1.0, 0.0}});
    rig.set_mode(CameraMode::fly);
    rig.turn({-0.3, 0.0});
    EXPECT_EQ(rig.camera().eye, glm::dvec3(0.0, 1.0, 5.0));
    EXPECT_GT(rig.camera().target.x, 0.0) << "what was at the right comes in";
    const glm::dvec3 ahead = glm::normalize(rig.camera().target - rig.camera().eye);
    rig.go({0.0, 0.0, 1.0}, 1.0, false);
    const glm::dvec3 way = rig.camera().eye - glm::dvec3(0.0, 1.0, 5.0);
    EXPECT_NEAR(glm::dot(glm::normalize(way), ahead), 1.0, tolerance);
    const double height_m = rig.camera().eye.y;
    rig.go({0.0, 1.0, 0.0}, 1.0, false);
    const double rise_m = rig.camera().eye.y - height_m;
    EXPECT_GT(rise_m, 0.0);
    rig.go({0.0, -1.0, 0.0}, 1.0, true);
    EXPECT_NEAR(rig.camera().eye.y, height_m - 3.0 * rise_m, tolerance) << "four times as fast";
}

TEST(CameraRig, WalkersStayOnTheGround)
{
    CameraRig rig;
    rig.set_scene({.eye = {0.0, 9.0, 5.0}, .target = {0.0, 0.0, 0.0}}, box(10.0),
                  [](const glm::dvec3& place) { return std::optional(0.1 * place.x); });
    rig.set_mode(CameraMode::walk);
    EXPECT_NEAR(rig.camera().eye.y, 1.7, tolerance);
    rig.go({1.0, 1.0, 0.0}, 2.0, false);
    EXPECT_GT(rig.camera().eye.x, 1.0);
    EXPECT_NEAR(rig.camera().eye.y, 0.1 * rig.camera().eye.x + 1.7, tolerance);
}

TEST(CameraRig, SidesShowTheWholeAndHomeIsWhereItBegan)
{
    const Camera home{.eye = {3.0, 2.0, 4.0}, .vertical_fov_rad = 0.6};
    CameraRig rig = rig_of(home, 2.0);
    for (const ViewSide side : {ViewSide::front, ViewSide::right, ViewSide::top, ViewSide::isometric}) {
        rig.look_from(side);
        EXPECT_GT(distance(rig.camera()) * std::sin(0.3), box(2.0).radius());
        EXPECT_NEAR(glm::length(rig.camera().up), 1.0, tolerance);
        EXPECT_GT(glm::length(glm::cross(rig.camera().target - rig.camera().eye, rig.camera().up)), 1.0);
    }
    rig.look_from(ViewSide::top);
    EXPECT_GT(rig.camera().eye.y, 5.0);
    EXPECT_NEAR(rig.camera().eye.x, 0.0, tolerance);
    rig.go_home();
    EXPECT_EQ(rig.camera().eye, home.eye);
}

} // namespace
} // namespace estampe::viewer
