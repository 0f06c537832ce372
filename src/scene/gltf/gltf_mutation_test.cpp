// SPDX-License-Identifier: MIT
// Changes random bytes of a valid file: it must load or throw Error, and never anything else.

#include <random>

#include <gtest/gtest.h>

#include <estampe/error.hpp>

#include "core/image_codec.hpp"
#include "scene/gltf/test_file.hpp"

namespace estampe::gltf {
namespace {

TestFile everything()
{
    TestFile file = triangle_file();
    file.attributes()["TEXCOORD_0"] = file.add<float>({0, 0, 1, 0, 0, 1}, "VEC2");
    file.attributes()["JOINTS_0"] = file.add<uint8_t>({0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}, "VEC4");
    file.attributes()["WEIGHTS_0"] = file.add<float>({1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, "VEC4");
    file.primitive()["targets"] = json::array({{{"POSITION", 0}}});
    file.primitive()["material"] = 0;
    const int times = file.add<float>({0, 1}, "SCALAR");
    const int moves = file.add<float>({0, 0, 0, 1, 1, 1}, "VEC3");
    file.document["nodes"] =
        json::parse(R"([{"mesh": 0, "skin": 0}, {"children": [2], "scale": [1, 2, 3]}, {}])");
    file.document["skins"] = json::array({{{"joints", {1, 2}}}});
    file.document["animations"] = json::array(
        {{{"channels", json::array({{{"sampler", 0}, {"target", {{"node", 1}, {"path", "translation"}}}}})},
          {"samplers", json::array({{{"input", times}, {"output", moves}}})}}});
    const Image image{.width = 2, .height = 2, .rgba = std::vector<uint8_t>(16, 100)};
    file.document["images"] = json::array({{{"bufferView", file.add_view(encode_png(image))}}});
    file.document["textures"] = json::parse(R"([{"source": 0}])");
    file.document["materials"] = json::parse(R"([{"normalTexture": {"index": 0}}])");
    return file;
}

TEST(GltfMutation, random_bytes)
{
    const Bytes good = everything().glb();
    std::mt19937 random(20211011);
    int loaded = 0;
    constexpr int rounds = 4000;
    for (int round = 0; round < rounds; ++round) {
        Bytes bytes = good;
        for (uint32_t flips = random() % 4 + 1; flips > 0; --flips) {
            bytes[random() % bytes.size()] = static_cast<std::byte>(random() & 0xFF);
        }
        if (random() % 8 == 0) {
            bytes.resize(random() % bytes.size());
        }
        try {
            loaded += load_gltf_bytes(bytes, "mutated.glb").meshes.empty() ? 0 : 1;
        } catch (const Error& error) {
            EXPECT_EQ(error.where().find("mutated.glb"), 0U) << error.what();
        }
    }
    EXPECT_GT(loaded, 0);
    EXPECT_LT(loaded, rounds);
}

} // namespace
} // namespace estampe::gltf
