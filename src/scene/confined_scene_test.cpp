// SPDX-License-Identifier: MIT
// Scenes of strangers: what their references to further files may and may not open.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>

#include <gtest/gtest.h>

#include <fmt/format.h>

#include <estampe/error.hpp>
#include <estampe/lightmap.hpp>
#include <estampe/scene.hpp>

#include "core/file.hpp"
#include "core/image_codec.hpp"
#include "support/folder.hpp"

namespace estampe {
namespace {

namespace fs = std::filesystem;

void write_text(const fs::path& path, const std::string& text)
{
    std::ofstream(path) << text;
}

/// Writes a glTF of one triangle. `head` holds further members of the document.
void write_gltf(const fs::path& path, const std::string& buffer, const std::string& head)
{
    write_text(path, fmt::format(R"({{"asset": {{"version": "2.0"}}, {}
        "scenes": [{{"nodes": [0]}}], "nodes": [{{"mesh": 0}}],
        "meshes": [{{"primitives": [{{"attributes": {{"POSITION": 0}}, "material": 0}}]}}],
        "accessors": [{{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}}],
        "bufferViews": [{{"buffer": 0, "byteLength": 36}}],
        "buffers": [{{"byteLength": 36, "uri": "{}"}}]}})",
                                 head, buffer));
}

void write_gltf_with_buffer(const fs::path& folder, const std::string& name)
{
    write_gltf(folder / "scene.gltf", name, R"("materials": [{}],)");
}

void write_gltf_with_image(const fs::path& folder, const std::string& name)
{
    write_gltf(folder / "scene.gltf", "own.bin",
               fmt::format(R"("images": [{{"uri": "{}"}}], "textures": [{{"source": 0}}],
                   "materials": [{{"pbrMetallicRoughness": {{"baseColorTexture": {{"index": 0}}}}}}],)",
                           name));
}

void write_obj(const fs::path& folder, const std::string& library, const std::string& picture)
{
    write_text(folder / "scene.obj", fmt::format("mtllib {}\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\n"
                                                 "usemtl m\nf 1/1 2/1 3/1\n",
                                                 library));
    write_text(folder / "own.mtl", fmt::format("newmtl m\nmap_Kd {}\n", picture));
}

void write_ply(const fs::path& folder, const std::string& picture)
{
    write_text(folder / "scene.ply",
               fmt::format("ply\nformat ascii 1.0\ncomment TextureFile {}\nelement vertex 3\n"
                           "property float x\nproperty float y\nproperty float z\nproperty float s\n"
                           "property float t\nelement face 1\nproperty list uchar int vertex_indices\n"
                           "end_header\n0 0 0 0 0\n1 0 0 1 0\n0 1 0 0 1\n3 0 1 2\n",
                           picture));
}

void write_dae(const fs::path& folder, const std::string& picture)
{
    write_text(folder / "scene.dae", fmt::format(R"(<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><unit name="meter" meter="1"/><up_axis>Y_UP</up_axis></asset>
<library_images><image id="i"><init_from>{}</init_from></image></library_images>
<library_effects><effect id="e"><profile_COMMON>
<newparam sid="f"><surface type="2D"><init_from>i</init_from></surface></newparam>
<newparam sid="s"><sampler2D><source>f</source></sampler2D></newparam>
<technique sid="t"><lambert><diffuse><texture texture="s" texcoord="UV"/></diffuse></lambert></technique>
</profile_COMMON></effect></library_effects>
<library_materials><material id="m"><instance_effect url="#e"/></material></library_materials>
<library_geometries><geometry id="g"><mesh>
<source id="p"><float_array id="pa" count="9">0 0 0 1 0 0 0 1 0</float_array><technique_common>
<accessor source="#pa" count="3" stride="3"><param name="X" type="float"/><param name="Y" type="float"/>
<param name="Z" type="float"/></accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<triangles count="1" material="c"><input semantic="VERTEX" source="#v" offset="0"/><p>0 1 2</p></triangles>
</mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="vs"><node><instance_geometry url="#g"><bind_material><technique_common>
<instance_material symbol="c" target="#m"/></technique_common></bind_material></instance_geometry></node>
</visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#vs"/></scene></COLLADA>)",
                                                 picture));
}

/// A format of scenes, and how a scene of the format refers to a file.
struct Reference {
    const char* name;
    const char* scene;
    std::function<void(const fs::path& folder, const std::string& named)> write;
    /// A name that is found by its last part beside the scene, as paths of other computers are.
    bool finds_by_last_part = true;
};

const std::vector<Reference>& pictures()
{
    static const std::vector<Reference> all{
        {"glTF image", "scene.gltf", write_gltf_with_image, false},
        {"MTL picture", "scene.obj",
         [](const fs::path& folder, const std::string& named) { write_obj(folder, "own.mtl", named); }},
        {"PLY picture", "scene.ply", write_ply},
        {"DAE picture", "scene.dae", write_dae}};
    return all;
}

/// A folder `in` of a stranger with a scene and a picture of its own, and a picture beside the folder.
class ConfinedScene : public testing::Test {
protected:
    ConfinedScene()
    {
        fs::create_directories(in_ / "sub");
        fs::create_directories(folder_ / "out");
        const Image picture{.width = 2, .height = 2, .rgba = std::vector<uint8_t>(16, 9)};
        for (const char* name : {"in/own.png", "in/sub/own.png", "secret.png", "out/secret.png"}) {
            write_file_atomically(folder_ / name, encode_png(picture));
        }
        for (const char* name : {"in/own.bin", "secret.bin"}) {
            write_text(folder_ / name, std::string(36, '?'));
        }
        write_text(folder_ / "secret.mtl", "newmtl m\nKd 1 0 0\n");
        fs::create_symlink("../secret.png", in_ / "link.png");
        fs::create_symlink("../out", in_ / "linked");
        fs::create_symlink("../secret.bin", in_ / "link.bin");
        fs::create_symlink("../secret.mtl", in_ / "link.mtl");
    }

    /// Returns "read", "left out", or the error's message.
    [[nodiscard]] std::string outcome(const std::string& scene, bool is_confined) const
    {
        LoadOptions options;
        if (is_confined) {
            options.scope = ReadScope::beside(in_ / scene);
        }
        try {
            const Scene loaded = load_scene(in_ / scene, options);
            const bool has_picture = std::ranges::any_of(
                loaded.textures, [](const Texture& texture) { return texture.image.width == 2; });
            return has_picture ? "read" : "left out";
        } catch (const Error& problem) {
            return problem.what();
        }
    }

    static bool is_refusal(const std::string& outcome)
    {
        return outcome.find("outside the folder") != std::string::npos &&
               outcome.find("--confine") != std::string::npos;
    }

    test::Folder folder_;
    fs::path in_ = folder_ / "in";
};

TEST_F(ConfinedScene, own_pictures_are_read_and_missing_ones_left_out)
{
    for (const Reference& each : pictures()) {
        for (const char* name : {"own.png", "./own.png", "sub/own.png", "sub\\\\own.png"}) {
            each.write(in_, name);
            EXPECT_EQ(outcome(each.scene, true), "read") << each.name << ", " << name;
            EXPECT_EQ(outcome(each.scene, false), "read") << each.name << ", " << name;
        }
        each.write(in_, "none.png");
        EXPECT_EQ(outcome(each.scene, true), "left out") << each.name;
        EXPECT_EQ(outcome(each.scene, false), "left out") << each.name;
    }
}

TEST_F(ConfinedScene, pictures_elsewhere_are_refused)
{
    for (const Reference& each : pictures()) {
        for (const char* name :
             {"../secret.png", "%2e%2e/secret.png", "sub/../../secret.png", "sub%2f..%2f../secret.png",
              "..\\\\secret.png", "%2E%2E%5Csecret.png", "../none.png", "sub/../own.png", "link.png",
              "linked/secret.png", "./linked/./secret.png", "linked/SECRET.png"}) {
            each.write(in_, name);
            const std::string found = outcome(each.scene, true);
            EXPECT_TRUE(is_refusal(found)) << each.name << ", " << name << ": " << found;
        }
        for (const char* name : {"LINK.png", "LINKED/none.png"}) {
            each.write(in_, name);
            const std::string found = outcome(each.scene, true);
            EXPECT_EQ(is_refusal(found), each.finds_by_last_part)
                << each.name << ", " << name << ": " << found;
            EXPECT_NE(found, "read") << each.name << ", " << name;
        }
    }
}

TEST_F(ConfinedScene, absolute_paths_are_never_opened)
{
    const std::string secret = fs::absolute(folder_ / "secret.png").string();
    const std::string climbing = "/sub/../../secret.png";
    for (const Reference& each : pictures()) {
        for (const std::string& name :
             {secret, "file://" + secret, "file:" + secret, climbing, "/dev/../" + secret,
              std::string("/dev/zero"), std::string("/proc/self/environ"), std::string("C:/secret.png"),
              "%2f" + secret.substr(1)}) {
            each.write(in_, name);
            const std::string free = outcome(each.scene, false);
            EXPECT_EQ(free, "left out") << each.name << ", " << name;
            const std::string confined = outcome(each.scene, true);
            EXPECT_TRUE(confined == "left out" || is_refusal(confined)) << each.name << ": " << confined;
        }
        if (each.finds_by_last_part) {
            each.write(in_, "C:\\\\textures\\\\own.png");
            EXPECT_EQ(outcome(each.scene, true), "read") << each.name;
            each.write(in_, "/home/me/own.png");
            EXPECT_EQ(outcome(each.scene, true), "read") << each.name;
        }
    }
}

TEST_F(ConfinedScene, buffers_elsewhere_are_refused)
{
    write_gltf_with_buffer(in_, "own.bin");
    EXPECT_EQ(outcome("scene.gltf", true), "left out");
    for (const char* name : {"../secret.bin", "%2e%2e/secret.bin", "..\\\\secret.bin", "link.bin",
                             "linked/../../secret.bin", "/etc/passwd", "file:///etc/passwd"}) {
        write_gltf_with_buffer(in_, name);
        EXPECT_TRUE(is_refusal(outcome("scene.gltf", true))) << name << ": " << outcome("scene.gltf", true);
    }
    write_gltf_with_buffer(in_, "/etc/passwd");
    EXPECT_NE(outcome("scene.gltf", false).find("is not a relative path"), std::string::npos);
}

TEST_F(ConfinedScene, libraries_elsewhere_are_refused)
{
    for (const char* name :
         {"../secret.mtl", "..\\secret.mtl", "%2e%2e/secret.mtl", "link.mtl", "own.mtl ../secret.mtl"}) {
        write_obj(in_, name, "own.png");
        EXPECT_TRUE(is_refusal(outcome("scene.obj", true))) << name << ": " << outcome("scene.obj", true);
    }
    write_obj(in_, fs::absolute(folder_ / "secret.mtl").string() + "\nmtllib none.mtl", "none.png");
    EXPECT_EQ(outcome("scene.obj", true), "left out");
}

TEST_F(ConfinedScene, lightmaps_elsewhere_are_refused)
{
    const auto named = [&](const std::string& name, bool is_confined) -> std::string {
        write_gltf(in_ / "scene.gltf", "own.bin",
                   fmt::format(R"("extras": {{}}, "materials": [{{"extras": {{"estampe": {{"lightmap":
                       {{"uri": "{}", "texCoord": 0}}}}}}}}],)",
                               name));
        try {
            const auto map = named_lightmap(in_ / "scene.gltf", is_confined ? ReadScope{{in_}} : ReadScope{});
            return map ? "read" : "none";
        } catch (const Error& problem) {
            return problem.what();
        }
    };
    EXPECT_EQ(named("own.png", true), "read");
    EXPECT_EQ(named("../secret.png", false), "read");
    for (const char* name : {"../secret.png", "%2e%2e/secret.png", "link.png", "linked/secret.png"}) {
        EXPECT_TRUE(is_refusal(named(name, true))) << name << ": " << named(name, true);
    }
    EXPECT_THROW(static_cast<void>(load_lightmap(in_ / "link.png", {{in_}})), Error);
}

TEST_F(ConfinedScene, the_scene_itself_may_be_no_link)
{
    for (const Reference& each : pictures()) {
        each.write(folder_ / "out", "none.png");
        fs::copy_file(in_ / "own.bin", folder_ / "out/own.bin", fs::copy_options::overwrite_existing);
        fs::create_symlink(folder_ / "out" / each.scene, in_ / each.scene);
        EXPECT_TRUE(is_refusal(outcome(each.scene, true))) << each.name;
        EXPECT_EQ(outcome(each.scene, false), "left out") << each.name;
    }
    write_text(folder_ / "out/scene.stl", "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\n"
                                          "vertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid a\n");
    fs::create_symlink("../out/scene.stl", in_ / "scene.stl");
    EXPECT_TRUE(is_refusal(outcome("scene.stl", true)));
    EXPECT_EQ(outcome("scene.stl", false), "left out");
}

} // namespace
} // namespace estampe
