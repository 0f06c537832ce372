// SPDX-License-Identifier: MIT
// glTF files on disk with external buffers and images.

#include <filesystem>

#include <sys/stat.h>

#include <gtest/gtest.h>

#include <estampe/error.hpp>
#include <estampe/image.hpp>

#include "core/file.hpp"
#include "core/image_codec.hpp"
#include "scene/gltf/data.hpp"
#include "scene/gltf/test_file.hpp"
#include "support/folder.hpp"

namespace estampe::gltf {
namespace {

class GltfFiles : public testing::Test {
protected:
    GltfFiles()
    {
        std::filesystem::create_directory(folder_ / "a b");
        buffer_["byteLength"] = file_.binary.size();
    }

    /// Writes the .gltf, with its buffer stored as `buffer_` says.
    std::filesystem::path write()
    {
        file_.document["buffers"] = json::array({buffer_});
        const std::string text = file_.document.dump(2);
        write_file_atomically(folder_ / "scene.gltf", bytes_of(std::vector<char>(text.begin(), text.end())));
        return folder_ / "scene.gltf";
    }

    test::Folder folder_;
    TestFile file_ = triangle_file();
    json buffer_;
};

TEST_F(GltfFiles, external_buffer_with_escapes_in_its_name)
{
    write_file_atomically(folder_ / "a b" / "data#1.bin", file_.binary);
    buffer_["uri"] = "a%20b/data%231.bin";
    EXPECT_EQ(load_gltf(write()).meshes[0].primitives[0].positions.size(), 3U);
    buffer_["uri"] = "./a b/../a b/data#1.bin";
    EXPECT_EQ(load_gltf(write()).meshes[0].primitives[0].positions.size(), 3U);
}

TEST_F(GltfFiles, embedded_buffer)
{
    buffer_["uri"] = "data:application/octet-stream;base64," + base64(file_.binary);
    EXPECT_EQ(load_gltf(write()).meshes[0].primitives[0].positions[1], glm::vec3(1, 0, 0));
    EXPECT_TRUE(load_gltf(write()).warnings.empty());
    std::vector<std::byte> longer = file_.binary;
    longer.resize(longer.size() + 4);
    buffer_["uri"] = "data:application/octet-stream;base64," + base64(longer);
    const Scene scene = load_gltf(write());
    ASSERT_FALSE(scene.warnings.empty());
    EXPECT_NE(scene.warnings[0].find("#/buffers/0/byteLength"), std::string::npos) << scene.warnings[0];
}

TEST_F(GltfFiles, binary_file)
{
    write_file_atomically(folder_ / "scene.glb", file_.glb());
    EXPECT_EQ(load_gltf(folder_ / "scene.glb").meshes.size(), 1U);
    write_file_atomically(folder_ / "avatar.vrm", file_.glb());
    EXPECT_EQ(load_scene(folder_ / "avatar.vrm").meshes.size(), 1U);
}

TEST_F(GltfFiles, missing_buffer_names_the_file)
{
    buffer_["uri"] = "gone.bin";
    const std::filesystem::path path = write();
    try {
        (void)load_gltf(path);
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(error.where(), path.string() + "#/buffers/0/uri");
        EXPECT_NE(std::string(error.what()).find("gone.bin"), std::string::npos);
    }
}

TEST_F(GltfFiles, short_buffer_and_strange_buffers)
{
    write_file_atomically(folder_ / "short.bin", std::span(file_.binary).first(20));
    for (const char* uri : {"short.bin", "a b", "../../../../../../../../dev/zero", "%00", ""}) {
        buffer_["uri"] = uri;
        EXPECT_THROW((void)load_gltf(write()), Error) << uri;
    }
}

TEST_F(GltfFiles, pipes_devices_and_folders_are_not_waited_for)
{
    ASSERT_EQ(mkfifo((folder_ / "pipe").c_str(), 0600), 0);
    std::filesystem::create_symlink("/dev/zero", folder_ / "endless");
    const std::pair<const char*, const char*> strange[] = {
        {"pipe", "pipe: is not a regular file"},
        {"endless", "endless: is not a regular file"},
        {"a%20b", "a b: is not a regular file"},
        {"../../../../../../../../dev/zero", "dev/zero: is not a regular file"},
        {"../../../../../../../../proc/kmsg", "bytes, there are 0"},
        {"/dev/zero", "is not a relative path"},
        {"file:///dev/zero", "is not a relative path"},
    };
    for (const auto& [uri, what] : strange) {
        buffer_["uri"] = uri;
        try {
            static_cast<void>(load_gltf(write()));
            ADD_FAILURE() << uri;
        } catch (const Error& error) {
            EXPECT_NE(std::string(error.what()).find("scene.gltf#/buffers/0"), std::string::npos)
                << error.what();
            EXPECT_NE(std::string(error.what()).find(what), std::string::npos) << error.what();
        }
    }
}

TEST_F(GltfFiles, texture_beside_the_file)
{
    const Image image{.width = 1, .height = 2, .rgba = {1, 2, 3, 255, 4, 5, 6, 255}};
    save_png(image, folder_ / "a b" / "wood.png");
    write_file_atomically(folder_ / "scene.bin", file_.binary);
    buffer_["uri"] = "scene.bin";
    file_.document["images"] = json::array({{{"uri", "a%20b/wood.png"}}});
    file_.document["textures"] = json::array({{{"source", 0}}});
    file_.document["materials"] = json::array({{{"emissiveTexture", {{"index", 0}}}}});
    const Scene scene = load_gltf(write());
    EXPECT_EQ(scene.textures.at(0).image, image);
    EXPECT_EQ(scene.textures[0].name, "a b/wood.png");
    EXPECT_TRUE(scene.warnings.empty());
}

TEST_F(GltfFiles, a_buffer_is_read_as_far_as_it_is_declared)
{
    constexpr uint64_t tebibyte = uint64_t{1} << 40; // the sparse file occupies only a page on the disk
    write_file_atomically(folder_ / "big.bin", file_.binary);
    std::filesystem::resize_file(folder_ / "big.bin", tebibyte);
    buffer_["uri"] = "big.bin";
    EXPECT_EQ(load_gltf(write()).meshes[0].primitives[0].positions[1], glm::vec3(1, 0, 0));
    buffer_["byteLength"] = tebibyte;
    try {
        (void)load_gltf(write());
        ADD_FAILURE();
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("scene.gltf#/buffers/0/uri"), std::string::npos)
            << error.what();
        EXPECT_NE(std::string(error.what()).find("of memory"), std::string::npos) << error.what();
    }
}

TEST_F(GltfFiles, buffers_of_one_file_share_it)
{
    write_file_atomically(folder_ / "scene.bin", file_.binary);
    file_.document["buffers"] = json::array({{{"uri", "scene.bin"}, {"byteLength", 36}},
                                             {{"uri", "scene.bin"}, {"byteLength", file_.binary.size()}}});
    for (json& view : file_.document["bufferViews"]) {
        view["buffer"] = 1;
    }
    const std::string text = file_.document.dump();
    write_file_atomically(folder_ / "scene.gltf", bytes_of(std::vector<char>(text.begin(), text.end())));
    EXPECT_EQ(load_gltf(folder_ / "scene.gltf").meshes[0].primitives[0].indices.size(), 3U);
    file_.document["bufferViews"][2]["buffer"] = 0; // a buffer that only holds the positions
    const std::string shorter = file_.document.dump();
    write_file_atomically(folder_ / "scene.gltf",
                          bytes_of(std::vector<char>(shorter.begin(), shorter.end())));
    EXPECT_THROW((void)load_gltf(folder_ / "scene.gltf"), Error);
}

TEST_F(GltfFiles, large_files_of_something_else_are_refused_by_their_first_bytes)
{
    constexpr uint64_t tebibyte = uint64_t{1} << 40;
    const auto failure = [&](const char* name) {
        std::filesystem::resize_file(folder_ / name, tebibyte);
        try {
            (void)load_gltf(folder_ / name);
        } catch (const Error& error) {
            return std::string(error.what());
        }
        return std::string("loads");
    };
    write_file_atomically(folder_ / "zeros.glb", {});
    EXPECT_NE(failure("zeros.glb").find("zeros.glb:byte 0: is not a glTF file"), std::string::npos);
    write_file_atomically(folder_ / "old.glb", bytes_of<uint32_t>({0x46546C67, 1, 0xffffffff}));
    EXPECT_NE(failure("old.glb").find("old.glb:byte 4: glb version 1"), std::string::npos);
    write_file_atomically(folder_ / "text.gltf", bytes_of<char>({' ', '{'}));
    EXPECT_NE(failure("text.gltf").find("more than the limit"), std::string::npos);
    // Bytes after the end of a .glb are ignored.
    write_file_atomically(folder_ / "padded.glb", file_.glb());
    EXPECT_EQ(failure("padded.glb"), "loads");
}

TEST_F(GltfFiles, a_picture_that_many_images_name_is_one)
{
    const Image image{.width = 1, .height = 1, .rgba = {1, 2, 3, 255}};
    save_png(image, folder_ / "wood.png");
    write_file_atomically(folder_ / "scene.bin", file_.binary);
    buffer_["uri"] = "scene.bin";
    for (int i = 0; i < 64; ++i) {
        file_.document["images"].push_back({{"uri", "wood.png"}, {"name", std::to_string(i)}});
        file_.document["textures"].push_back({{"source", i}});
        file_.document["materials"].push_back({{"emissiveTexture", {{"index", i}}}});
    }
    file_.document["samplers"] = json::array({{{"wrapS", 33071}}});
    file_.document["textures"][63]["sampler"] = 0;
    const Scene scene = load_gltf(write());
    ASSERT_EQ(scene.textures.size(), 2U) << "one for each way to wrap it";
    EXPECT_EQ(scene.textures[0].image, image);
    EXPECT_EQ(scene.textures[1].image, image);
    EXPECT_EQ(scene.materials[62].emissive_texture.texture, 0U);
    EXPECT_EQ(scene.materials[63].emissive_texture.texture, 1U);
}

TEST_F(GltfFiles, missing_pictures_are_listed)
{
    write_file_atomically(folder_ / "scene.bin", file_.binary);
    write_file_atomically(folder_ / "broken.png", file_.binary);
    buffer_["uri"] = "scene.bin";
    file_.document["images"] = json::parse(R"([{"uri": "a%20b/oak.png"}, {"uri": "broken.png"}])");
    file_.document["textures"] = json::parse(R"([{"source": 0}, {"source": 1}])");
    file_.document["materials"] =
        json::parse(R"([{"emissiveTexture": {"index": 0}, "normalTexture": {"index": 1}}])");
    const Scene scene = load_gltf(write());
    EXPECT_EQ(scene.warnings.size(), 2U);
    EXPECT_EQ(scene.missing_files, std::vector<std::string>{"a b/oak.png"});
}

TEST_F(GltfFiles, files_that_were_read_are_listed)
{
    write_file_atomically(folder_ / "scene.bin", file_.binary);
    write_file_atomically(folder_ / "a b.png", encode_png({.width = 1, .height = 1, .rgba = {1, 2, 3, 255}}));
    buffer_["uri"] = "scene.bin";
    file_.document["images"] = json::parse(R"([{"uri": "a%20b.png"}, {"uri": "missing.png"}])");
    file_.document["textures"] = json::parse(R"([{"source": 0}, {"source": 1}])");
    file_.document["materials"] =
        json::parse(R"([{"emissiveTexture": {"index": 0}, "normalTexture": {"index": 1}}])");
    const std::filesystem::path path = write();
    EXPECT_EQ(load_scene(path).files,
              (std::vector<std::filesystem::path>{path, folder_ / "a b.png", folder_ / "scene.bin"}));
}

TEST_F(GltfFiles, other_files)
{
    EXPECT_THROW((void)load_gltf(folder_ / "none.gltf"), Error);
    EXPECT_THROW((void)load_gltf(folder_.path()), Error);
    try {
        (void)load_scene(folder_ / "film.mp4");
        FAIL();
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("give one of: .gltf .glb .vrm .obj"), std::string::npos)
            << error.what();
    }
    EXPECT_THROW((void)load_scene(folder_ / "none"), Error);
}

TEST(GltfUri, decoding)
{
    EXPECT_EQ(decode_relative_uri("a%20b.png"), "a b.png");
    EXPECT_EQ(decode_relative_uri("a\\b.png"), "a/b.png");
    EXPECT_EQ(decode_relative_uri("100%.png"), "100%.png");
    EXPECT_EQ(decode_relative_uri("%2Fetc/passwd"), std::nullopt);
    EXPECT_EQ(decode_relative_uri("file:///x"), std::nullopt);
    EXPECT_EQ(decode_relative_uri("a%00b"), std::nullopt);
    EXPECT_EQ(decode_data_uri("data:;base64,AQID")->size(), 3U);
    EXPECT_EQ(decode_data_uri("data:;base64,AQ==")->at(0), std::byte{1});
    EXPECT_EQ(decode_data_uri("data:text/plain,AQID"), std::nullopt);
    EXPECT_EQ(decode_data_uri("data:;base64,A*ID"), std::nullopt);
}

} // namespace
} // namespace estampe::gltf
