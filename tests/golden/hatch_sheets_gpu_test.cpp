// SPDX-License-Identifier: MIT
// Contact sheets of the hatching, which the documentation shows: one model in eight styles, and one ball over
// six octaves of distance beside a map whose levels were filtered instead of drawn.
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <estampe/renderer.hpp>
#include <estampe/shapes.hpp>

#include "golden/golden.hpp"
#include "support/folder.hpp"
#include "support/gpu_device.hpp"
#include "support/scenes.hpp"
#include "techniques/tam/files/map_files.hpp"
#include "techniques/tam/maker.hpp"

namespace estampe {
namespace {

/// A small page, drawn with the same pen as a large one.
Image tile(const Camera& camera, const std::vector<std::string>& assignments, glm::uvec2 size_px = {320, 270})
{
    Style style;
    style.set(fmt::format("paper.height_mm={}", 70 * size_px.y / 270));
    style.set("light.turn_sun=false");
    style.set("paper.margin_mm=0");
    style.set("tone.contrast=1.4");
    for (const std::string& assignment : assignments) {
        style.set(assignment);
    }
    return test::shared_renderer().render(camera, style,
                                          {.width = size_px.x, .height = size_px.y, .samples = 4});
}

/// An urn with two handles.
Scene urn()
{
    std::vector<glm::vec2> profile{{0.0F, 0.0F}, {0.4F, 0.0F}, {0.43F, 0.05F}, {0.4F, 0.1F}, {0.2F, 0.17F}};
    for (int i = 0; i <= 32; ++i) { // the belly
        const float t = static_cast<float>(i) / 32.0F;
        const float bulge = std::pow(std::sin(2.9F * std::pow(t, 1.35F)), 1.2F);
        profile.emplace_back(0.17F + 0.1F * t + 0.5F * std::max(bulge, 0.0F), 0.24F + 1.26F * t);
    }
    for (const glm::vec2 place :
         {glm::vec2(0.27F, 1.6F), glm::vec2(0.28F, 1.7F), glm::vec2(0.33F, 1.8F), glm::vec2(0.41F, 1.87F),
          glm::vec2(0.35F, 1.87F), glm::vec2(0.2F, 1.7F), glm::vec2(0.0F, 1.66F)}) {
        profile.push_back(place);
    }
    Scene scene;
    const glm::vec3 clay(0.9F, 0.86F, 0.8F);
    test::add_object(scene, shapes::lathe(profile, 72, 0.9F), clay);
    for (const float side : {-1.0F, 1.0F}) {
        Primitive handle = shapes::torus(0.22F, 0.045F, 40, 16);
        for (size_t i = 0; i < handle.positions.size(); ++i) {
            handle.positions[i] = {handle.positions[i].x, handle.positions[i].z, handle.positions[i].y};
            handle.normals[i] = {handle.normals[i].x, handle.normals[i].z, handle.normals[i].y};
        }
        for (size_t i = 0; i + 2 < handle.indices.size(); i += 3) {
            std::swap(handle.indices[i + 1], handle.indices[i + 2]);
        }
        test::add_object(scene, std::move(handle), clay, {0.45 * static_cast<double>(side), 1.5, 0.0});
    }
    return scene;
}

TEST(HatchSheet, OneModelInEightStyles)
{
    test::shared_renderer().set_scene(urn());
    const Camera camera{.eye = {1.5, 1.9, 3.4}, .target = {0.42, 0.9, 0.0}, .vertical_fov_rad = 0.6};
    const std::vector<Image> tiles{
        tile(camera, {"hatch.coordinates=solid"}),
        tile(camera, {"hatch.coordinates=form"}),
        tile(camera, {"hatch.coordinates=light"}),
        tile(camera,
             {"hatch.coordinates=form", "hatch.growth=0.8", "hatch.overrun_mm=1.2", "hatch.wobble_mm=0.3"}),
        tile(camera, {"hatch.strokes=map"}),
        tile(camera, {"hatch.strokes=map", "tam.tool=charcoal", "tam.width_px=5", "hatch.map_tone=blend",
                      "hatch.map_contrast=1.4"}),
        tile(camera, {"hatch.strokes=map", "tam.tool=burin", "tam.second_from=9", "tam.third_from=9"}),
        tile(camera, {"hatch.strokes=map", "hatch.map_tone=step", "hatch.black_above=0.7"})};
    test::expect_matches_golden(test::sheet_of(tiles, 4), "hatch-styles");
}

/// A map whose finest level alone was drawn; the others are filtered from it, as textures usually are.
std::filesystem::path filtered_map(const test::Folder& folder)
{
    tam::TonalArtMap map = tam::make_map({});
    for (auto& levels : map.level_of_tone) {
        for (size_t level = 1; level < levels.size(); ++level) {
            levels[level] = tam::half_size(levels[level - 1], map.size_px >> (level - 1));
        }
    }
    map.threshold_of_level.clear();
    std::filesystem::path path = folder / "filtered-map.tam";
    tam::save_tam(map, path);
    return path;
}

TEST(HatchSheet, OneBallOverSixOctavesOfDistance)
{
    const test::Folder folder;
    const std::filesystem::path filtered = filtered_map(folder);
    test::shared_renderer().set_scene(test::scene_of(shapes::sphere(1.0F, 96, 48)));
    std::vector<Image> tiles;
    const std::vector<std::vector<std::string>> rows{
        {"hatch.coordinates=solid"},
        {"hatch.coordinates=solid", "hatch.strokes=map"},
        {"hatch.coordinates=solid", "hatch.strokes=map", fmt::format("hatch.map={}", filtered.string()),
         "hatch.map_tone=blend", "hatch.map_contrast=1", "hatch.map_texel_mm=0.02"}};
    for (std::vector<std::string> row : rows) {
        row.insert(row.end(),
                   {"picture.ground=false", "light.sun_azimuth_deg=78", "light.sun_elevation_deg=18"});
        for (int octave = 0; octave < 6; ++octave) {
            const double distance_m = 1.0 + 0.08 * std::exp2(octave); // from its middle
            const Camera camera{
                .eye = {0.0, 0.0, distance_m}, .target = {0.0, 0.0, 0.0}, .vertical_fov_rad = 0.9};
            tiles.push_back(tile(camera, row, {180, 150}));
        }
    }
    std::filesystem::remove(filtered);
    test::expect_matches_golden(test::sheet_of(tiles, 6), "hatch-distance");
}

} // namespace
} // namespace estampe
