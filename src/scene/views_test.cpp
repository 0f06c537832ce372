// SPDX-License-Identifier: MIT
// Views from named sides and bearings: directions, margins, projections, and their syntax.
#include <estampe/shapes.hpp>
#include <estampe/views.hpp>

#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include <estampe/error.hpp>

#include "scene/pose.hpp"
#include "support/scenes.hpp"

namespace estampe {
namespace {

/// Axes of a camera, and projection of points to its page, -1 to 1 in both directions.
class CameraPage {
public:
    CameraPage(const Camera& camera, double aspect) : camera_(camera), aspect_(aspect)
    {
        forward = glm::normalize(camera.target - camera.eye);
        right = glm::normalize(glm::cross(forward, camera.up));
        up = glm::cross(right, forward);
    }

    [[nodiscard]] glm::dvec2 at(const glm::dvec3& point) const
    {
        const glm::dvec3 v = point - camera_.eye;
        const double half_height = camera_.orthographic_half_height_m.value_or(
            glm::dot(v, forward) * std::tan(0.5 * camera_.vertical_fov_rad));
        return {glm::dot(v, right) / (half_height * aspect_), glm::dot(v, up) / half_height};
    }

    glm::dvec3 forward, right, up;

private:
    Camera camera_;
    double aspect_;
};

struct Extent {
    glm::dvec2 min{1e9};
    glm::dvec2 max{-1e9};
};

Extent extent_of(const Scene& scene, const CameraPage& page)
{
    Extent extent;
    visit_posed(scene, pose_scene(scene, 0.0), [&](const PosedPrimitive& posed) {
        for (const glm::dvec3& position : posed.positions) {
            extent.min = glm::min(extent.min, page.at(position));
            extent.max = glm::max(extent.max, page.at(position));
        }
    });
    return extent;
}

/// An asymmetric object: a long box with a sphere on one end and a cone on one side.
Scene odd_scene()
{
    Scene scene = test::scene_of(shapes::box({3.0F, 1.0F, 1.4F}));
    test::add_object(scene, shapes::sphere(0.5F), glm::vec3(1.0F), {1.2, 1.3, 0.4});
    test::add_object(scene, shapes::cone(0.3F, 0.9F), glm::vec3(1.0F), {-1.8, 0.2, -0.5});
    return scene;
}

constexpr std::array<double, 5> aspects{16.0 / 9.0, 1.0, 0.4, 5.0, 0.1};

void expect_whole(const Scene& scene, const ViewDirection& from)
{
    for (const double aspect : aspects) {
        SCOPED_TRACE(aspect);
        const CameraPage page(view_camera(scene, pose_scene(scene, 0.0), aspect, from), aspect);
        const Extent extent = extent_of(scene, page);
        const glm::dvec2 margin = 0.16 * glm::min(glm::dvec2(1.0 / aspect, aspect), glm::dvec2(1.0));
        double most = 0.0;
        for (int axis = 0; axis < 2; ++axis) {
            EXPECT_GT(extent.min[axis], -1.0 + 0.999 * margin[axis]);
            EXPECT_LT(extent.max[axis], 1.0 - 0.999 * margin[axis]);
            EXPECT_NEAR(extent.min[axis] + extent.max[axis], 0.0, 0.02) << "in the middle";
            most = std::max(most, (extent.max[axis] - extent.min[axis]) / (2.0 - 2.0 * margin[axis]));
        }
        EXPECT_GT(most, from.parallel ? 0.999 : 0.97) << "fills the page one way";
    }
}

TEST(Views, AllSidesHoldTheWholeSubjectAtAnyAspect)
{
    const Scene scene = odd_scene();
    for (const char* const name : view_names()) {
        for (const bool parallel : {false, true}) {
            SCOPED_TRACE(name);
            ViewDirection from = direction_of(*named_view(name));
            from.parallel = from.parallel || parallel;
            expect_whole(scene, from);
        }
    }
    expect_whole(scene, {.azimuth_deg = 200.0, .elevation_deg = -35.0, .fov_deg = 70.0});
    expect_whole(scene, {.azimuth_deg = -10.0, .elevation_deg = 90.0, .parallel = true});
}

TEST(Views, LookFromWhereTheirNameSays)
{
    struct Expected {
        NamedView view;
        glm::dvec3 from, right;
    };

    const double third = 1.0 / std::sqrt(3.0);
    const double half = std::sqrt(0.5);
    const std::array<Expected, 7> all{{{NamedView::front, {0, 0, 1}, {1, 0, 0}},
                                       {NamedView::back, {0, 0, -1}, {-1, 0, 0}},
                                       {NamedView::right, {1, 0, 0}, {0, 0, -1}},
                                       {NamedView::left, {-1, 0, 0}, {0, 0, 1}},
                                       {NamedView::top, {0, 1, 0}, {1, 0, 0}},
                                       {NamedView::bottom, {0, -1, 0}, {1, 0, 0}},
                                       {NamedView::isometric, {third, third, third}, {half, 0, -half}}}};
    const Scene scene = odd_scene();
    for (const Expected& expected : all) {
        SCOPED_TRACE(view_names()[static_cast<size_t>(expected.view)]);
        const Camera camera = view_camera(scene, pose_scene(scene, 0.0), 1.5, direction_of(expected.view));
        const CameraPage page(camera, 1.5);
        EXPECT_LT(glm::length(page.forward + expected.from), 1e-9);
        EXPECT_LT(glm::length(page.right - expected.right), 1e-9);
        EXPECT_EQ(camera.orthographic_half_height_m.has_value(), expected.view == NamedView::isometric);
        EXPECT_GT(camera.near_m, 0.0);
    }
    const ViewDirection quarter = direction_of(NamedView::three_quarter);
    const CameraPage page(view_camera(scene, pose_scene(scene, 0.0), 1.5, quarter), 1.5);
    EXPECT_LT(page.forward.x, -0.3);
    EXPECT_LT(page.forward.y, -0.2);
    EXPECT_LT(page.forward.z, -0.6);
}

TEST(Views, IsometricAxesAreEquallyLong)
{
    const Scene scene = odd_scene();
    const CameraPage page(view_camera(scene, pose_scene(scene, 0.0), 1.0, direction_of(NamedView::isometric)),
                          1.0);
    const double x = glm::length(page.at({1, 0, 0}) - page.at({0, 0, 0}));
    EXPECT_NEAR(glm::length(page.at({0, 1, 0}) - page.at({0, 0, 0})), x, 1e-9);
    EXPECT_NEAR(glm::length(page.at({0, 0, 1}) - page.at({0, 0, 0})), x, 1e-9);
}

TEST(Views, ADistanceAndATargetAreKept)
{
    const Scene scene = odd_scene();
    const Camera camera =
        view_camera(scene, pose_scene(scene, 0.0), 1.5,
                    parse_view_direction("azimuth=90 elevation=30 distance=8 target=1,2,3 fov=40"));
    EXPECT_LT(glm::length(camera.eye - (glm::dvec3(1, 2, 3) + 8.0 * glm::dvec3(std::sqrt(0.75), 0.5, 0.0))),
              1e-9);
    EXPECT_NEAR(camera.vertical_fov_rad, glm::radians(40.0), 1e-12);
    const Camera plan =
        view_camera(scene, pose_scene(scene, 0.0), 1.5, parse_view_direction("elevation=90 ortho=4"));
    EXPECT_DOUBLE_EQ(*plan.orthographic_half_height_m, 4.0);
}

TEST(Views, SaysWhatIsWrongAndShowsTheForm)
{
    const std::array<std::pair<const char*, const char*>, 9> wrong{
        {{"distance=3", "\"azimuth\" is missing"},
         {"azimuth=here", "not a number"},
         {"azimuth=400", "-360 to 360"},
         {"azimuth=1 elevation=91", "-90 to 90"},
         {"azimuth=1 distance=0", "greater than zero"},
         {"azimuth=1 ortho=-2", "greater than zero"},
         {"azimuth=1 fov=200", "1 to 170"},
         {"azimuth=1 target=0,0,0", "target needs distance"},
         {"azimuth=1 eye=0,0,0", "unknown key \"eye\""}}};
    for (const auto& [text, message] : wrong) {
        try {
            (void)parse_view_direction(text);
            FAIL() << text;
        } catch (const Error& error) {
            EXPECT_NE(std::string(error.what()).find(message), std::string::npos) << error.what();
            EXPECT_NE(error.remedy().find("\"azimuth=30 elevation=20\""), std::string::npos);
        }
    }
}

TEST(Views, ParallelProjectionKeepsTheSizeAtTheFocus)
{
    const Camera camera{.eye = {0, 0, 10}, .target = {0, 0, 0}, .vertical_fov_rad = 0.5};
    const Camera parallel = with_parallel_projection(camera, {3, 1, 4});
    const glm::dvec3 point(0.5, 0.7, 4.0);
    EXPECT_LT(glm::length(CameraPage(camera, 1.5).at(point) - CameraPage(parallel, 1.5).at(point)), 1e-9);
    EXPECT_NEAR(*with_parallel_projection(camera, {0, 0, 20}).orthographic_half_height_m,
                10.0 * std::tan(0.25), 1e-9);
}

} // namespace
} // namespace estampe
