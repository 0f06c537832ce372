// SPDX-License-Identifier: MIT
// load_scene() reads in a child process: what arrives is what a reader in this process would have made.
#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <estampe/error.hpp>

#include "core/child/child.hpp"
#include "core/child/exchange_test_support.hpp"
#include "core/file.hpp"
#include "core/image_codec.hpp"
#include "core/long_jobs.hpp"
#include "scene/gltf/test_file.hpp"
#include "scene/importers.hpp"
#include "scene/reader/crossing.hpp"
#include "support/folder.hpp"

namespace estampe::gltf {
namespace {

/// A triangle with a skin, two materials and variants, a texture beside the file, a lamp, a camera, an
/// animation, and extras of Estampe.
TestFile rich_file()
{
    TestFile file = triangle_file();
    const int joints = file.add<uint8_t>({0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}, "VEC4");
    const int weights = file.add<float>({1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, "VEC4");
    const int uvs = file.add<float>({0, 0, 1, 0, 0, 1}, "VEC2");
    const int matrices = file.add<float>({1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}, "MAT4");
    const int times = file.add<float>({0, 1}, "SCALAR");
    const int places = file.add<float>({0, 0, 0, 1, 2, 3}, "VEC3");
    file.attributes().update({{"JOINTS_0", joints}, {"WEIGHTS_0", weights}, {"TEXCOORD_0", uvs}});
    file.primitive()["material"] = 0;
    file.primitive()["extensions"]["KHR_materials_variants"] =
        json::parse(R"({"mappings": [{"material": 1, "variants": [0]}]})");
    file.document.update(json::parse(R"({
        "extensionsUsed": ["KHR_materials_variants", "KHR_lights_punctual", "KHR_unknown"],
        "extensions": {"KHR_materials_variants": {"variants": [{"name": "night"}]},
                       "KHR_lights_punctual": {"lights": [{"type": "spot", "name": "lamp", "spot": {}}]}},
        "images": [{"uri": "../pictures/red.png"}, {"uri": "absent.png"}],
        "textures": [{"source": 0}, {"source": 1}],
        "materials": [{"name": "cloth", "pbrMetallicRoughness": {"baseColorTexture": {"index": 0}},
                       "extras": {"estampe": {"cloth": {"drag": 2}}}},
                      {"name": "b", "pbrMetallicRoughness": {"baseColorTexture": {"index": 1}}}],
        "cameras": [{"type": "perspective", "perspective": {"yfov": 0.5, "znear": 0.1}}],
        "nodes": [{"mesh": 0, "skin": 0, "name": "body", "extras": {"estampe": {"casts": false}}},
                  {"name": "joint", "children": [2]},
                  {"camera": 0, "translation": [0, 0, 5],
                   "extensions": {"KHR_lights_punctual": {"light": 0}}}],
        "scenes": [{"nodes": [0, 1]}]})"));
    file.document["skins"] = {{{"joints", {1}}, {"inverseBindMatrices", matrices}}};
    file.document["animations"] = {
        {{"name", "walk"},
         {"channels", {{{"sampler", 0}, {"target", {{"node", 1}, {"path", "translation"}}}}}},
         {"samplers", {{{"input", times}, {"output", places}}}}}};
    return file;
}

class LoadScene : public testing::Test {
protected:
    LoadScene()
    {
        std::filesystem::create_directory(folder_ / "scenes");
        std::filesystem::create_directory(folder_ / "pictures");
        save_png({.width = 1, .height = 1, .rgba = {255, 0, 0, 255}}, folder_ / "pictures/red.png");
    }

    [[nodiscard]] std::filesystem::path write(const std::string& name, std::span<const std::byte> bytes) const
    {
        write_file_atomically(folder_ / "scenes" / name, bytes);
        return folder_ / "scenes" / name;
    }

    [[nodiscard]] std::filesystem::path write(const std::string& name, const std::string& text) const
    {
        return write(name, std::as_bytes(std::span(text)));
    }

    test::Folder folder_;
};

TEST_F(LoadScene, SceneOfAChildIsThatOfAReaderInThisProcess)
{
    const std::filesystem::path path = write("rich.glb", rich_file().glb());
    const Scene here = load_gltf(path);
    ASSERT_EQ(here.skins.size() + here.lights.size() + here.cameras.size() + here.animations.size(), 4U);
    ASSERT_TRUE(here.materials[0].cloth && here.variants.size() == 1 && !here.warnings.empty());
    EXPECT_EQ(test::sent(run_in_child([&path] { return load_gltf(path); }, {}, "")), test::sent(here));
}

TEST_F(LoadScene, PicturesBesideItAreReadAndMissingOnesAreListed)
{
    const std::filesystem::path path = write("rich.glb", rich_file().glb());
    const Scene scene = load_scene(path);
    EXPECT_EQ(scene.textures[0].image.rgba, (std::vector<uint8_t>{255, 0, 0, 255}));
    EXPECT_EQ(scene.missing_files, std::vector<std::string>{"absent.png"});
    EXPECT_EQ(scene.files[0], path);
    ASSERT_FALSE(scene.warnings.empty());
    EXPECT_TRUE(scene.warnings[0].starts_with(path.string())) << scene.warnings[0];
}

TEST_F(LoadScene, ErrorsAreThoseOfTheReader)
{
    TestFile broken = triangle_file();
    broken.document["nodes"][0]["mesh"] = 7;
    const std::filesystem::path gltf = write("broken.glb", broken.glb());
    const std::filesystem::path obj = write("empty.obj", "v 0 0 0 nan\n");
    const auto error_of = [](auto&& load) {
        try {
            load();
        } catch (const Error& error) {
            return std::vector<std::string>{error.what(), error.where(), error.remedy()};
        }
        return std::vector<std::string>{"no error"};
    };
    const auto here = error_of([&] { (void)load_gltf(gltf); });
    EXPECT_NE(here.front(), "no error");
    EXPECT_EQ(error_of([&] { (void)load_scene(gltf); }), here);
    for (const std::filesystem::path& absent : {folder_ / "absent.gltf", folder_ / "absent.stl"})
        EXPECT_NE(error_of([&] { (void)load_scene(absent); }).front().find(absent.string()),
                  std::string::npos);
    EXPECT_EQ(error_of([&] { (void)load_image(gltf); }), error_of([&] { (void)read_image(gltf); }));
}

TEST_F(LoadScene, ProgressArrivesAndCanCancel)
{
    const std::filesystem::path path = write("rich.glb", rich_file().glb());
    std::vector<double> shares;
    {
        const ProgressWatch watch([&shares](double share) {
            shares.push_back(share);
            return true;
        });
        (void)load_scene(path);
    }
    ASSERT_GT(shares.size(), 2U);
    EXPECT_TRUE(std::ranges::is_sorted(shares));
    EXPECT_EQ(shares.back(), 1.0);
    const ProgressWatch watch([](double) { return false; });
    EXPECT_THROW((void)load_scene(path), Error);
}

} // namespace
} // namespace estampe::gltf
