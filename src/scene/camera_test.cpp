// SPDX-License-Identifier: MIT
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include <estampe/error.hpp>
#include <estampe/scene.hpp>
#include <estampe/shapes.hpp>
#include <estampe/views.hpp>

#include "scene/framing.hpp"
#include "scene/pose.hpp"

namespace estampe {
namespace {

Scene placed_scene(const Primitive& primitive, const glm::dmat4& placed = glm::dmat4(1.0))
{
    Scene scene;
    scene.materials.emplace_back();
    scene.meshes.push_back({.name = "", .primitives = {primitive}, .morph_weights = {}});
    scene.nodes.emplace_back();
    scene.nodes[0].mesh = 0;
    scene.nodes[0].matrix = placed;
    scene.roots = {0};
    return scene;
}

/// Extent of all vertices in the picture, -1 to 1 in both directions, and the depth of the nearest one.
struct DeepExtent {
    glm::dvec2 min{std::numeric_limits<double>::infinity()};
    glm::dvec2 max{-std::numeric_limits<double>::infinity()};
    double nearest = std::numeric_limits<double>::infinity();
};

DeepExtent extent_of(const Scene& scene, const Camera& camera, double aspect)
{
    const glm::dvec3 forward = glm::normalize(camera.target - camera.eye);
    const glm::dvec3 right = glm::normalize(glm::cross(forward, camera.up));
    const glm::dvec3 up = glm::cross(right, forward);
    const double half_height = std::tan(0.5 * camera.vertical_fov_rad);
    DeepExtent extent;
    visit_posed(scene, pose_scene(scene, 0.0), [&](const PosedPrimitive& posed) {
        for (const glm::dvec3& p : posed.positions) {
            const glm::dvec3 v = p - camera.eye;
            const double depth = glm::dot(v, forward);
            const glm::dvec2 at{glm::dot(v, right) / (depth * half_height * aspect),
                                glm::dot(v, up) / (depth * half_height)};
            extent.min = glm::min(extent.min, at);
            extent.max = glm::max(extent.max, at);
            extent.nearest = std::min(extent.nearest, depth);
        }
    });
    return extent;
}

constexpr std::array<double, 5> odd_aspects{16.0 / 9.0, 1.0, 0.4, 5.0, 0.1};

void expect_framed(const Primitive& primitive, const glm::dmat4& placed = glm::dmat4(1.0))
{
    const Scene scene = placed_scene(primitive, placed);
    for (const double aspect : odd_aspects) {
        SCOPED_TRACE(aspect);
        const Camera camera = framing_camera(scene, pose_scene(scene, 0.0), aspect);
        const DeepExtent extent = extent_of(scene, camera, aspect);
        const glm::dvec2 margin = 0.16 * glm::min(glm::dvec2(1.0 / aspect, aspect), glm::dvec2(1.0));
        for (int axis = 0; axis < 2; ++axis) {
            EXPECT_GT(extent.min[axis], -1.0 + 0.99 * margin[axis]);
            EXPECT_LT(extent.max[axis], 1.0 - 0.99 * margin[axis]);
        }
        EXPECT_LT(std::abs(extent.min.x + extent.max.x), 0.75) << "not far from the middle";
        EXPECT_GT(extent.nearest, camera.near_m);
        const glm::dvec2 fill = (extent.max - extent.min) / (2.0 - 2.0 * margin);
        EXPECT_GT(std::max(fill.x, fill.y), 0.75) << "tight, but for some room for the shadow";
        EXPECT_GT(camera.eye.y, camera.target.y) << "from above";
        EXPECT_GT(camera.eye.z - camera.target.z, camera.eye.x - camera.target.x) << "mostly from the front";
        EXPECT_GT(camera.eye.x, camera.target.x);
    }
}

TEST(Framing, HoldsTallWideAndFlatModels)
{
    expect_framed(shapes::box({1.0F, 1.0F, 1.0F}));
    expect_framed(shapes::cylinder(0.1F, 40.0F));
    expect_framed(shapes::box({60.0F, 0.5F, 1.0F}));
    expect_framed(shapes::box({0.5F, 0.5F, 60.0F}));
    expect_framed(shapes::plane(10.0F, 10.0F));
    expect_framed(shapes::torus(2.0F, 0.3F));
}

TEST(Framing, HoldsTinyHugeAndDistantModels)
{
    expect_framed(shapes::sphere(1e-4F));
    expect_framed(shapes::sphere(1e6F));
    expect_framed(shapes::sphere(1.0F), glm::translate(glm::dmat4(1.0), {1e5, -2e4, 3e5}));
}

TEST(Framing, SurvivesAPointAndNothing)
{
    Primitive point;
    point.topology = Topology::points;
    point.positions = {{3.0F, 4.0F, 5.0F}};
    point.indices = {0};
    const Scene scene = placed_scene(point);
    const Camera camera = framing_camera(scene, pose_scene(scene, 0.0), 1.5);
    EXPECT_TRUE(std::isfinite(camera.eye.x + camera.eye.y + camera.eye.z));
    EXPECT_GT(glm::distance(camera.eye, camera.target), 0.0);
    EXPECT_GT(camera.near_m, 0.0);
    const Camera nothing = framing_camera(Scene{}, pose_scene(Scene{}, 0.0), 1.5);
    EXPECT_GT(glm::distance(nothing.eye, nothing.target), 0.0);
}

TEST(Framing, StandsBackFromPointsThatHideEachOther)
{
    const Window window{.side = 0.3, .top = 0.2, .bottom = 0.2};
    const std::vector<glm::dvec3> line{{-2.0, 0.5, 1.0}, {-2.0, 0.5, 5.0}};
    const glm::dvec3 eye = centre_eye(line, window, fit_eye(line, window));
    EXPECT_NEAR(eye.x, -2.0, 1e-12);
    EXPECT_NEAR(eye.y, 0.5, 1e-12);
    EXPECT_NEAR(eye.z, 0.8, 1e-12) << "a twentieth of their depth";
}

TEST(Framing, FramesWhatHasLeftThePlaceItWasChosenAt)
{
    // The subject is chosen at time 0; by then this floor and the box on it stand far below.
    Primitive stage = shapes::box({1.0F, 1.0F, 1.0F});
    shapes::append(stage, shapes::box({20.0F, 0.01F, 20.0F}), glm::mat4(1.0F));
    const Scene scene = placed_scene(stage);
    ScenePose pose = pose_scene(scene, 0.0);
    pose.world_from_node[0][3] = {100.0, -300.0, 0.0, 1.0};
    for (const Camera& camera :
         {framing_camera(scene, pose, 1.5), view_camera(scene, pose, 1.5, direction_of(NamedView::front))}) {
        EXPECT_NEAR(camera.target.x, 100.0, 2.0);
        EXPECT_NEAR(camera.target.y, -300.0, 2.0);
        EXPECT_GT(glm::distance(camera.eye, camera.target), 20.0);
    }
}

/// A box whose triangles face inwards.
Primitive room()
{
    Primitive inside;
    shapes::append(inside, shapes::box({4.0F, 3.0F, 5.0F}), glm::mat4(1.0F));
    for (size_t i = 0; i < inside.indices.size(); i += 3)
        std::swap(inside.indices[i], inside.indices[i + 1]);
    return inside;
}

TEST(Framing, LooksThroughTheNearWallOfARoom)
{
    Scene scene = placed_scene(room());
    scene.materials[0].double_sided = true;
    const Camera cut = framing_camera(scene, pose_scene(scene, 0.0), 1.3);
    const double wall_m = cut.eye.z - 2.5;
    EXPECT_GT(wall_m, 0.0);
    EXPECT_GT(cut.near_m, wall_m);
    EXPECT_LT(cut.near_m, wall_m + 0.1);
    EXPECT_NEAR(cut.eye.y, cut.target.y, 1e-9);

    scene.materials[0].double_sided = false;
    const Camera culled = framing_camera(scene, pose_scene(scene, 0.0), 1.3);
    EXPECT_LT(culled.near_m, culled.eye.z - 2.5);
}

TEST(Framing, LooksInThroughTheOpenSide)
{
    Primitive open = room();
    std::vector<uint32_t> kept;
    for (size_t i = 0; i < open.indices.size(); i += 3) {
        const auto behind = [&](size_t k) { return open.positions[open.indices[i + k]].z < 0.0F; };
        if (!(behind(0) && behind(1) && behind(2)))
            kept.insert(kept.end(), open.indices.begin() + static_cast<std::ptrdiff_t>(i),
                        open.indices.begin() + static_cast<std::ptrdiff_t>(i) + 3);
    }
    open.indices = kept;
    const Scene scene = placed_scene(open);
    EXPECT_LT(framing_camera(scene, pose_scene(scene, 0.0), 1.3).eye.z, -2.5);
}

TEST(SceneCamera, IsFoundByNameAndByNumber)
{
    Scene scene = placed_scene(shapes::box({1, 1, 1}));
    scene.cameras.push_back({.name = "wide", .vertical_fov_rad = 0.9, .near_m = 0.2});
    scene.cameras.push_back({.name = "plan", .orthographic = true, .half_height_m = 4.0});
    scene.nodes.resize(3);
    scene.roots = {0, 1, 2};
    scene.nodes[1].camera = 1;
    scene.nodes[2].camera = 0;
    scene.nodes[2].transform.translation = {1, 2, 3};
    scene.nodes[2].transform.scale = glm::dvec3(5.0);
    scene.nodes[2].transform.rotation = glm::angleAxis(glm::radians(90.0), glm::dvec3(0, 1, 0));
    const ScenePose pose = pose_scene(scene, 0.0);
    for (const char* name : {"wide", "0"}) {
        const Camera camera = scene_camera(scene, pose, name);
        EXPECT_NEAR(camera.target.x, 0.0, 1e-9);
        EXPECT_NEAR(camera.target.z, 3.0, 1e-9);
        EXPECT_DOUBLE_EQ(camera.vertical_fov_rad, 0.9);
        EXPECT_DOUBLE_EQ(camera.near_m, 0.2);
        EXPECT_FALSE(camera.orthographic_half_height_m);
    }
    EXPECT_DOUBLE_EQ(*scene_camera(scene, pose, "plan").orthographic_half_height_m, 4.0);
    for (const char* name : {"2", "narrow", "", "-1", "0x"}) {
        try {
            (void)scene_camera(scene, pose, name);
            FAIL() << name;
        } catch (const Error& error) {
            EXPECT_NE(std::string(error.what()).find("1 \"plan\""), std::string::npos) << error.what();
        }
    }
}

TEST(ParseCamera, ReadsAllItsParts)
{
    const Camera camera = parse_camera("fov=60 eye=1,2.5,-3e1  target=0,0,0 up=0,0,2 ortho=7");
    EXPECT_EQ(camera.eye, glm::dvec3(1.0, 2.5, -30.0));
    EXPECT_EQ(camera.target, glm::dvec3(0.0));
    EXPECT_EQ(camera.up, glm::dvec3(0.0, 0.0, 1.0));
    EXPECT_NEAR(camera.vertical_fov_rad, glm::radians(60.0), 1e-12);
    EXPECT_DOUBLE_EQ(*camera.orthographic_half_height_m, 7.0);
}

TEST(ParseCamera, LooksStraightDownWithoutBeingToldWhatIsUp)
{
    EXPECT_EQ(parse_camera("eye=0,9,0 target=0,0,0").up, glm::dvec3(0.0, 0.0, -1.0));
}

TEST(ParseCamera, SaysWhatIsWrong)
{
    const std::array<std::pair<const char*, const char*>, 17> wrong{{
        {"", "\"eye\" is missing"},
        {"eye=1,2,3", "\"target\" is missing"},
        {"eye=1,2 target=0,0,0", "three numbers"},
        {"eye=1,2,3,4 target=0,0,0", "three numbers"},
        {"eye=1,b,3 target=0,0,0", "\"b\" is not a number"},
        {"eye=nan,2,3 target=0,0,0", "not a number"},
        {"eye=inf,2,3 target=0,0,0", "not a number"},
        {"eye=1,,3 target=0,0,0", "not a number"},
        {"eye=1,2,3 target=1,2,3", "same point"},
        {"eye=1,2,3 target=0,0,0 fov=0", "1 to 170"},
        {"eye=1,2,3 target=0,0,0 fov=171", "1 to 170"},
        {"eye=1,2,3 target=0,0,0 fov=wide", "not a number"},
        {"eye=1,2,3 target=0,0,0 up=2,4,6", "up must not"},
        {"eye=1,2,3 target=0,0,0 up=0,0,0", "up must not"},
        {"eye=1,2,3 target=0,0,0 ortho=-1", "greater than zero"},
        {"eye=1,2,3 target=0,0,0 zoom=2", "unknown key \"zoom\""},
        {"eye=1,2,3 eye=1,2,3 target=0,0,0 front", "given twice"},
    }};
    for (const auto& [text, message] : wrong) {
        try {
            (void)parse_camera(text);
            FAIL() << text;
        } catch (const Error& error) {
            EXPECT_NE(std::string(error.what()).find(message), std::string::npos) << error.what();
            EXPECT_NE(error.remedy().find("eye=x,y,z"), std::string::npos);
        }
    }
    EXPECT_THROW((void)parse_camera("front"), Error);
}

} // namespace
} // namespace estampe
