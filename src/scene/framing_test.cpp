// SPDX-License-Identifier: MIT
// Contents of the framed view: random scenes, their shadows, and objects on wide floors.
#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include <estampe/error.hpp>
#include <estampe/shapes.hpp>

#include "scene/pose.hpp"
#include "scene/view_analysis/view_analysis.hpp"
#include "support/scenes.hpp"

namespace estampe {
namespace {

constexpr double wide_aspect = 16.0 / 9.0;

/// Projects points to the picture, -1 to 1 in both directions.
class WidePage {
public:
    explicit WidePage(const Camera& camera)
        : eye_(camera.eye), forward_(glm::normalize(camera.target - camera.eye)),
          right_(glm::normalize(glm::cross(forward_, camera.up))), up_(glm::cross(right_, forward_)),
          half_height_(std::tan(0.5 * camera.vertical_fov_rad))
    {
    }

    [[nodiscard]] glm::dvec2 at(const glm::dvec3& point) const
    {
        const glm::dvec3 v = point - eye_;
        const double scale = 1.0 / (glm::dot(v, forward_) * half_height_);
        return {glm::dot(v, right_) * scale / wide_aspect, glm::dot(v, up_) * scale};
    }

private:
    glm::dvec3 eye_, forward_, right_, up_;
    double half_height_;
};

struct PictureExtent {
    glm::dvec2 min{std::numeric_limits<double>::infinity()};
    glm::dvec2 max{-std::numeric_limits<double>::infinity()};

    void extend(const glm::dvec2& at)
    {
        min = glm::min(min, at);
        max = glm::max(max, at);
    }
};

bool on_page(const glm::dvec2& at)
{
    return std::max(std::abs(at.x), std::abs(at.y)) <= 1.0;
}

/// Positions in the picture of all vertices, and of their shadows on the ground.
struct Picture {
    PictureExtent model;
    double shadow_share = 0.0; ///< share of the shadow that lies on the page
};

Picture framed_picture(const Scene& scene)
{
    const ScenePose pose = pose_scene(scene, 0.0);
    const WidePage page(framing_camera(scene, pose, wide_aspect));
    const double ground_m = scene_bounds(scene, pose).min.y;
    const glm::dvec3 sun = analyze_view(scene).towards_sun(house_sun_azimuth_deg, house_sun_elevation_deg);
    Picture picture;
    size_t shadows = 0;
    size_t inside = 0;
    visit_posed(scene, pose, [&](const PosedPrimitive& posed) {
        for (const glm::dvec3& p : posed.positions) {
            picture.model.extend(page.at(p));
            ++shadows;
            inside += on_page(page.at(p - sun * ((p.y - ground_m) / sun.y))) ? 1U : 0U;
        }
    });
    picture.shadow_share = static_cast<double>(inside) / static_cast<double>(shadows);
    return picture;
}

/// One to five different shapes near each other.
Scene random_scene(std::mt19937& random)
{
    const auto between = [&random](float low, float high) {
        return std::uniform_real_distribution<float>(low, high)(random);
    };
    Scene scene;
    const int count = std::uniform_int_distribution(1, 5)(random);
    for (int i = 0; i < count; ++i) {
        Primitive thing;
        switch (std::uniform_int_distribution(0, 4)(random)) {
        case 0:
            thing = shapes::box({between(0.3F, 3.0F), between(0.3F, 4.0F), between(0.3F, 3.0F)});
            break;
        case 1:
            thing = shapes::cylinder(between(0.1F, 1.0F), between(0.5F, 5.0F));
            break;
        case 2:
            thing = shapes::cone(between(0.3F, 1.5F), between(0.5F, 4.0F));
            break;
        case 3:
            thing = shapes::torus(between(0.6F, 2.0F), between(0.1F, 0.5F));
            break;
        default:
            thing = shapes::sphere(between(0.2F, 1.5F));
            break;
        }
        test::add_object(scene, thing, glm::vec3(1.0F),
                         {between(-2.0F, 2.0F), between(0.0F, 0.5F), between(-2.0F, 2.0F)});
    }
    return scene;
}

TEST(FramedView, HoldsRandomScenesWithMarginAndMostOfTheirShadow)
{
    std::mt19937 random(11);
    double shadow_sum = 0.0;
    for (int round = 0; round < 50; ++round) {
        SCOPED_TRACE(round);
        const Picture picture = framed_picture(random_scene(random));
        const glm::dvec2 margin(0.16 / wide_aspect, 0.16);
        for (int axis = 0; axis < 2; ++axis) {
            EXPECT_GT(picture.model.min[axis], -1.0 + 0.99 * margin[axis]);
            EXPECT_LT(picture.model.max[axis], 1.0 - 0.99 * margin[axis]);
        }
        const glm::dvec2 fill = 0.5 * (picture.model.max - picture.model.min);
        EXPECT_GT(std::max(fill.x, fill.y), 0.6) << "large";
        EXPECT_GT(picture.shadow_share, 0.7);
        shadow_sum += picture.shadow_share;
    }
    EXPECT_GT(shadow_sum / 50.0, 0.97);
}

TEST(FramedView, HoldsTheWholeShadowOfAStandingFigure)
{
    const Picture figure = framed_picture(test::scene_of(shapes::cylinder(0.25F, 1.7F)));
    EXPECT_EQ(figure.shadow_share, 1.0);
    EXPECT_GT(figure.model.max.y - figure.model.min.y, 1.3) << "two thirds of the page's height";
    EXPECT_LT(std::abs(figure.model.max.x + figure.model.min.x), 0.75);
}

TEST(FramedView, IsAsLargeFarFromTheOriginAsAtIt)
{
    const Scene home = test::scene_of(shapes::cylinder(0.25F, 1.7F));
    const Camera near = framing_camera(home, pose_scene(home, 0.0), wide_aspect);
    for (const double away_m : {1e4, 1e7, 1e9}) {
        Scene scene = home;
        scene.nodes[0].transform.translation = {away_m, 0.0, -away_m};
        const Camera far = framing_camera(scene, pose_scene(scene, 0.0), wide_aspect);
        EXPECT_NEAR(glm::distance(far.eye, far.target), glm::distance(near.eye, near.target), 1e-3) << away_m;
    }
}

TEST(FramedView, IsRefusedWhereNothingCanBeDrawn)
{
    Scene scene = test::scene_of(shapes::cylinder(0.25F, 1.7F));
    for (const double length : {3e19, 1e-20}) {
        scene.nodes[0].transform.scale = glm::dvec3(std::min(length, 1.0), std::min(length, 1.0), length);
        EXPECT_THROW(static_cast<void>(framing_camera(scene, pose_scene(scene, 0.0), 1.0 / 16384.0)), Error)
            << length;
    }
}

TEST(FramedView, LeavesNoRoomForAShadowThatIsNotThrown)
{
    Scene lit = test::scene_of(shapes::cylinder(0.25F, 1.7F));
    lit.lights.push_back({.type = LightType::point});
    lit.nodes.push_back({.light = 0});
    lit.roots.push_back(1);
    const Picture picture = framed_picture(lit);
    EXPECT_NEAR(picture.model.max.x + picture.model.min.x, 0.0, 0.02);
    EXPECT_GT(picture.model.max.y - picture.model.min.y, 1.55);
}

TEST(FramedView, FollowsTheSceneOwnSun)
{
    const auto left_of_middle = [](const glm::dvec3& towards_sun) {
        Scene scene = test::scene_of(shapes::cylinder(0.25F, 1.7F));
        test::add_sun(scene, towards_sun);
        const Picture picture = framed_picture(scene);
        return 0.5 * (picture.model.max.x + picture.model.min.x);
    };
    // The eye stands between +z and +x, so its right hand is at +x, -z.
    EXPECT_LT(left_of_middle({-0.8, 0.7, 0.55}), -0.08) << "the shadow falls to the right";
    EXPECT_GT(left_of_middle({0.8, 0.7, -0.55}), 0.08) << "and to the left";
    EXPECT_NEAR(left_of_middle({0.05, 1.0, 0.0}), 0.0, 0.05) << "and below";
}

TEST(FramedView, HoldsTheShadowOfTheSunThatItIsTold)
{
    const Scene scene = test::scene_of(shapes::cylinder(0.4F, 1.2F));
    const ScenePose pose = pose_scene(scene, 0.0);
    for (const double azimuth_deg : {-34.0, 0.0, 20.0}) {
        SCOPED_TRACE(azimuth_deg);
        const SunBearing low{.azimuth_deg = azimuth_deg, .elevation_deg = 35.0};
        const WidePage page(framing_camera(scene, pose, wide_aspect, low));
        const glm::dvec3 sun = analyze_view(scene).towards_sun(low.azimuth_deg, low.elevation_deg);
        visit_posed(scene, pose, [&](const PosedPrimitive& posed) {
            for (const glm::dvec3& p : posed.positions) {
                EXPECT_TRUE(on_page(page.at(p - sun * (p.y / sun.y))));
            }
        });
    }
}

TEST(FramedView, TheSunThatRulesTakesThePlaceOfTheScenes)
{
    Scene scene = test::scene_of(shapes::cylinder(0.25F, 1.7F));
    const ScenePose pose = pose_scene(scene, 0.0);
    const SunBearing sun{.azimuth_deg = 100.0, .elevation_deg = 30.0, .turns = false, .rules = true};
    const glm::dvec3 alone = framing_camera(scene, pose, wide_aspect, sun).eye;
    test::add_sun(scene, {-0.8, 0.7, 0.55});
    EXPECT_EQ(framing_camera(scene, pose_scene(scene, 0.0), wide_aspect, sun).eye, alone);
}

TEST(FramedView, LeavesNoRoomForAShadowThatIsNotDrawn)
{
    const Scene scene = test::scene_of(shapes::cylinder(0.4F, 1.2F));
    const ScenePose pose = pose_scene(scene, 0.0);
    const auto middle = [&](bool throws) {
        const WidePage page(framing_camera(scene, pose, wide_aspect, {.throws = throws}));
        PictureExtent model;
        visit_posed(scene, pose, [&](const PosedPrimitive& posed) {
            for (const glm::dvec3& p : posed.positions) {
                model.extend(page.at(p));
            }
        });
        return 0.5 * (model.min.x + model.max.x);
    };
    EXPECT_GT(std::abs(middle(true)), 0.1);
    EXPECT_NEAR(middle(false), 0.0, 0.02);
}

TEST(FramedView, FindsAPlaceWhereOnePointIsLeftOfTheSubject)
{
    Primitive point;
    point.positions.assign(3, glm::vec3(-4.0F));
    point.normals.assign(3, {0.0F, 1.0F, 0.0F});
    point.indices = {0, 1, 2};
    Scene scene = test::scene_of(point);
    test::add_object(scene, point, glm::vec3(1.0F), {1.0, 0.0, 0.0});
    scene.materials.front().double_sided = true;
    ScenePose pose = pose_scene(scene, 0.0);
    pose.world_from_node[0][3] =
        glm::dvec4(-4.0, -4.0, -4.0, 1.0); // it has moved away from its rest position
    for (const double page_aspect : {1.0 / 16384.0, 1.5, 16384.0, 17808.6}) {
        const Camera camera = framing_camera(scene, pose, page_aspect);
        EXPECT_LT(glm::length(camera.eye), 1e6) << page_aspect;
        EXPECT_GT(glm::distance(camera.eye, camera.target), 0.0) << page_aspect;
    }
}

TEST(FramedView, IgnoresAWideFloor)
{
    const Primitive thing = shapes::box({1.0F, 1.2F, 0.8F});
    const Scene alone = test::scene_of(thing);
    const WidePage page(framing_camera(alone, pose_scene(alone, 0.0), wide_aspect));
    for (const float side : {4.0F, 10.0F, 100.0F}) {
        SCOPED_TRACE(side);
        Scene scene = test::scene_of(shapes::plane(side, side, 8));
        test::add_object(scene, thing, glm::vec3(1.0F), {0.3, 0.0, 0.2});
        const WidePage floored(framing_camera(scene, pose_scene(scene, 0.0), wide_aspect));
        for (const glm::vec3& corner : thing.positions) {
            const glm::dvec2 apart =
                floored.at(glm::dvec3(corner) + glm::dvec3(0.3, 0.0, 0.2)) - page.at(glm::dvec3(corner));
            EXPECT_LT(glm::length(apart), 0.25) << "framed about as it is without the floor";
        }
    }
}

} // namespace
} // namespace estampe
