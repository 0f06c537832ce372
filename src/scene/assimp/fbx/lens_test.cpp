// SPDX-License-Identifier: MIT
#include "scene/assimp/fbx/document.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace estampe::fbx {
namespace {

Properties camera(std::initializer_list<std::pair<const char*, double>> numbers)
{
    Properties properties;
    for (const auto& [name, number] : numbers)
        properties.own[name] = {number};
    return properties;
}

/// Half the height of the picture at a distance of 1.
double tangent(const Properties& properties)
{
    return std::tan(0.5 * lens_of(properties, Document{}).vertical_fov_rad);
}

constexpr double both = 0.0;
constexpr double horizontal = 1.0;
constexpr double vertical = 2.0;
constexpr double focal_length = 3.0;

TEST(FbxLens, ApertureModesSayWhichAngleIsMeant)
{
    const double t = std::tan(glm::radians(20.0));
    EXPECT_NEAR(tangent(camera({{"ApertureMode", vertical}, {"FieldOfView", 40}})), t, 1e-9);
    EXPECT_NEAR(tangent(camera({{"FieldOfView", 40}})), t, 1e-9) << "vertical is the default";
    EXPECT_NEAR(tangent(camera({{"ApertureMode", horizontal},
                                {"FieldOfView", 40},
                                {"AspectWidth", 1920},
                                {"AspectHeight", 1080}})),
                t * 9.0 / 16.0, 1e-9);
    EXPECT_NEAR(tangent(camera({{"ApertureMode", horizontal}, {"FieldOfView", 40}})), t / 1.6, 1e-9)
        << "320 by 200 where nothing is said";
    EXPECT_NEAR(tangent(camera({{"ApertureMode", both}, {"FieldOfViewX", 70}, {"FieldOfViewY", 40}})), t,
                1e-9);
}

TEST(FbxLens, FocalLengthsAreSeenThroughTheFilmsGate)
{
    const auto lens = [](double fit, double width) {
        return tangent(camera({{"ApertureMode", focal_length},
                               {"FocalLength", 25.4},
                               {"FilmWidth", 2.0},
                               {"FilmHeight", 1.0},
                               {"GateFit", fit},
                               {"AspectWidth", width},
                               {"AspectHeight", 1.0}}));
    };
    EXPECT_NEAR(lens(0, 4.0), 0.5, 1e-9) << "none: the film's height";
    EXPECT_NEAR(lens(1, 4.0), 0.5, 1e-9) << "vertical";
    EXPECT_NEAR(lens(2, 4.0), 0.25, 1e-9) << "horizontal";
    EXPECT_NEAR(lens(3, 4.0), 0.25, 1e-9) << "fill, a wider picture";
    EXPECT_NEAR(lens(3, 1.0), 0.5, 1e-9) << "fill, a narrower picture";
    EXPECT_NEAR(lens(4, 4.0), 0.5, 1e-9) << "overscan, a wider picture";
    EXPECT_NEAR(lens(4, 1.0), 1.0, 1e-9) << "overscan, a narrower picture";
    EXPECT_NEAR(tangent(camera({{"FocalLength", 25.4}, {"FilmWidth", 2.0}, {"FilmHeight", 1.0}})), 0.5, 1e-9)
        << "no angle is given";
}

TEST(FbxLens, NearPlaneAndParallelProjectionAreInMetres)
{
    Document inches;
    inches.settings.own["UnitScaleFactor"] = {2.54};
    EXPECT_NEAR(lens_of(camera({{"NearPlane", 10}}), inches).near_m, 0.254, 1e-9);
    EXPECT_NEAR(lens_of(camera({{"NearPlane", -10}}), inches).near_m, 1e-4, 1e-9);
    const Properties parallel = camera({{"CameraProjectionType", 1}, {"OrthoZoom", 4}});
    EXPECT_TRUE(lens_of(parallel, inches).orthographic);
    EXPECT_NEAR(lens_of(parallel, inches).half_height_m, 0.5 * 4 * 30 * 0.0254, 1e-9);
    Document blender;
    blender.creator = "Blender (stable FBX IO) - 3.4.0";
    const Properties wide = camera({{"CameraProjectionType", 1},
                                    {"OrthoZoom", 4},
                                    {"GateFit", 2},
                                    {"AspectWidth", 1000},
                                    {"AspectHeight", 500}});
    EXPECT_NEAR(lens_of(wide, blender).half_height_m, 1.0, 1e-9);
}

TEST(FbxLens, NonsenseLeavesTheDefaults)
{
    EXPECT_EQ(lens_of(Properties{}, Document{}).vertical_fov_rad, SceneCamera{}.vertical_fov_rad);
    const Properties odd = camera({{"ApertureMode", 99},
                                   {"GateFit", -4},
                                   {"FieldOfView", 720},
                                   {"FocalLength", -1},
                                   {"FilmWidth", 0},
                                   {"AspectHeight", 0}});
    EXPECT_EQ(lens_of(odd, Document{}).vertical_fov_rad, SceneCamera{}.vertical_fov_rad);
}

} // namespace
} // namespace estampe::fbx
