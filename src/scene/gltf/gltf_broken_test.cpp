// SPDX-License-Identifier: MIT
// A hundred files with one fault each: each must give an Error that names the place.

#include <limits>

#include <gtest/gtest.h>

#include <estampe/error.hpp>

#include "scene/gltf/test_file.hpp"

namespace estampe::gltf {
namespace {

void expect_error(const Bytes& bytes, const std::string& name, const std::string& where,
                  const std::string& label)
{
    try {
        (void)load_gltf_bytes(bytes, name);
        ADD_FAILURE() << label << ": no error";
    } catch (const Error& error) {
        EXPECT_EQ(error.where(), where) << label << ": " << error.what();
        EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << label;
        EXPECT_EQ(std::string(error.what()).find(name), 0U) << label;
    }
}

Bytes text_bytes(const std::string& text)
{
    return bytes_of(std::vector<char>(text.begin(), text.end()));
}

/// A file that uses most of glTF. Accessors: 0 positions, 1 normals, 2 indices, 3 texture coordinates, 4
/// joints, 5 weights, 6 inverse bind matrix, 7 key times, 8 key translations, 9 sparse offsets. Views have
/// the same numbers, 9 and 10 are the sparse indices and values.
TestFile rich_file()
{
    TestFile file = triangle_file();
    json& attributes = file.attributes();
    attributes["TEXCOORD_0"] = file.add<float>({0, 0, 1, 0, 0, 1}, "VEC2");
    attributes["JOINTS_0"] = file.add<uint8_t>({0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}, "VEC4");
    attributes["WEIGHTS_0"] = file.add<float>({1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, "VEC4");
    const int bind = file.add<float>({1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}, "MAT4");
    const int times = file.add<float>({0, 1}, "SCALAR");
    const int moves = file.add<float>({0, 0, 0, 1, 1, 1}, "VEC3");
    const int indices = file.add_view(bytes_of<uint16_t>({1}));
    const int values = file.add_view(bytes_of<float>({1, 2, 3}));
    const int sparse = file.add_accessor({{"componentType", 5126},
                                          {"count", 3},
                                          {"type", "VEC3"},
                                          {"sparse",
                                           {{"count", 1},
                                            {"indices", {{"bufferView", indices}, {"componentType", 5123}}},
                                            {"values", {{"bufferView", values}}}}}});
    file.primitive()["targets"] = json::array({{{"POSITION", sparse}}});
    file.primitive()["material"] = 0;
    json& document = file.document;
    document["nodes"] = json::parse(R"([
        {"mesh": 0, "skin": 0, "translation": [0,0,0], "rotation": [0,0,0,1], "scale": [1,1,1]},
        {"children": [2], "camera": 0},
        {"mesh": 0, "matrix": [1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1]}
    ])");
    document["nodes"][2]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["TRANSLATION"] = moves;
    document["nodes"][1]["extensions"]["KHR_lights_punctual"]["light"] = 0;
    document["skins"] = json::array({{{"joints", {1}}, {"inverseBindMatrices", bind}}});
    document["cameras"] = json::parse(R"([{"type": "perspective", "perspective": {"yfov": 1, "znear": 0.1}},
        {"type": "orthographic", "orthographic": {"xmag": 1, "ymag": 1, "znear": 0, "zfar": 2}}])");
    document["extensions"]["KHR_lights_punctual"]["lights"] =
        json::parse(R"([{"type": "spot", "spot": {}}])");
    document["animations"] = json::array(
        {{{"channels", json::array({{{"sampler", 0}, {"target", {{"node", 0}, {"path", "translation"}}}}})},
          {"samplers", json::array({{{"input", times}, {"output", moves}}})}}});
    document["images"] = json::parse(R"([{"uri": "data:image/png;base64,AAAA"}])");
    document["samplers"] = json::parse(R"([{"wrapS": 10497}])");
    document["textures"] = json::parse(R"([{"source": 0, "sampler": 0}])");
    document["materials"] = json::parse(
        R"([{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}, "normalTexture": {"index": 0}}])");
    return file;
}

TEST(GltfBroken, the_whole_file_loads)
{
    const Scene scene = rich_file().load();
    EXPECT_EQ(scene.nodes.size(), 3U);
    EXPECT_EQ(scene.warnings.size(), 1U) << "the picture is not one";
}

struct Change {
    const char* pointer; ///< the pointer that is changed in the rich file
    const char* value;   ///< the JSON that is set there; empty removes it
    const char* where;   ///< the pointer that the error names; null means the same pointer
};

const Change changes[] = {
    {"/asset", "", ""},
    {"/asset/version", "", "/asset"},
    {"/asset/version", "2", nullptr},
    {"/asset/version", "\"1.0\"", nullptr},
    {"/asset", "[]", nullptr},
    {"/extensionsRequired", "[\"KHR_mesh_primitive_restart\"]", "/extensionsRequired/0"},
    {"/extensionsRequired", "[\"KHR_materials_unlit\", \"X_y\\nz\"]", "/extensionsRequired/1"},
    {"/extensionsUsed", "[7]", "/extensionsUsed/0"},
    {"/scene", "1", nullptr},
    {"/scene", "-1", nullptr},
    {"/scenes/0/nodes/0", "3", nullptr},
    {"/scenes/0/nodes", "{}", nullptr},
    {"/scenes/0", "null", nullptr},
    {"/buffers/0/byteLength", "1000000000", nullptr},
    {"/buffers/0/byteLength", "0", nullptr},
    {"/buffers/0/byteLength", "-4", nullptr},
    {"/buffers/0/byteLength", "", "/buffers/0"},
    {"/buffers/0/byteLength", "20", "/bufferViews/0/byteLength"},
    {"/buffers/0/uri", "\"missing.bin\"", nullptr},
    {"/buffers/0/uri", "\"/etc/passwd\"", nullptr},
    {"/buffers/0/uri", "\"http://example.org/a.bin\"", nullptr},
    {"/buffers/0/uri", "\"data:application/octet-stream;base64,AAA\"", "/buffers/0/byteLength"},
    {"/buffers/0/uri", "\"data:application/octet-stream;base64,A\"", nullptr},
    {"/buffers/0/uri", "\"data:application/octet-stream,abc\"", nullptr},
    {"/buffers/0/uri", "5", nullptr},
    {"/bufferViews/0/buffer", "1", nullptr},
    {"/bufferViews/0/buffer", "", "/bufferViews/0"},
    {"/bufferViews/0/byteOffset", "100000", "/bufferViews/0/byteLength"},
    {"/bufferViews/0/byteOffset", "-1", nullptr},
    {"/bufferViews/0/byteLength", "1000000000000", nullptr},
    {"/bufferViews/0/byteLength", "1e300", nullptr},
    {"/bufferViews/0/byteLength", "18446744073709551615", nullptr},
    {"/bufferViews/0/byteLength", "35", "/accessors/0/count"},
    {"/bufferViews/0/byteStride", "4", nullptr},
    {"/bufferViews/0/byteStride", "16", "/accessors/0/count"},
    {"/bufferViews/0/byteStride", "100000", nullptr},
    {"/bufferViews/0/byteStride", "14", nullptr},
    {"/accessors/0/bufferView", "99", nullptr},
    {"/accessors/0/bufferView", "1.5", nullptr},
    {"/accessors/0/byteOffset", "4", "/accessors/0/count"},
    {"/accessors/0/byteOffset", "1099511627776", "/accessors/0/count"},
    {"/accessors/0/componentType", "5124", nullptr},
    {"/accessors/0/componentType", "\"float\"", nullptr},
    {"/accessors/0/componentType", "", "/accessors/0"},
    {"/accessors/0/count", "4", nullptr},
    {"/accessors/0/count", "0", nullptr},
    {"/accessors/0/count", "-3", nullptr},
    {"/accessors/0/count", "2147483648", nullptr},
    {"/accessors/0/count", "4294967295", nullptr},
    {"/accessors/0/count", "99999999999", nullptr},
    {"/accessors/0/count", "2", "/meshes/0/primitives/0/attributes/NORMAL"},
    {"/accessors/0/type", "\"VEC5\"", nullptr},
    {"/accessors/0/type", "\"VEC2\"", "/meshes/0/primitives/0/attributes/POSITION"},
    {"/accessors/0/type", "\"MAT4\"", "/accessors/0/count"},
    {"/accessors/0/normalized", "1", nullptr},
    {"/accessors/2/type", "\"VEC2\"", "/accessors/2/count"},
    {"/accessors/2/componentType", "5126", "/accessors/2/count"},
    {"/accessors/9/count", "2147483648", nullptr},
    {"/accessors/9/count", "4", "/meshes/0/primitives/0/targets/0/POSITION"},
    {"/accessors/9/sparse/count", "4", nullptr},
    {"/accessors/9/sparse/count", "2", "/accessors/9/sparse/indices"},
    {"/accessors/9/sparse/indices/bufferView", "77", nullptr},
    {"/accessors/9/sparse/indices/byteOffset", "2", "/accessors/9/sparse/indices"},
    {"/accessors/9/sparse/indices/componentType", "5126", nullptr},
    {"/accessors/9/sparse/values/byteOffset", "4", "/accessors/9/sparse/values"},
    {"/accessors/9/sparse/values", "", "/accessors/9/sparse"},
    {"/meshes/0/primitives", "", "/meshes/0"},
    {"/meshes/0/primitives/0/attributes", "", "/meshes/0/primitives/0"},
    {"/meshes/0/primitives/0/attributes/POSITION", "10", nullptr},
    {"/meshes/0/primitives/0/attributes/POSITION", "\"0\"", nullptr},
    {"/meshes/0/primitives/0/attributes/NORMAL", "7", nullptr},
    {"/meshes/0/primitives/0/attributes/TEXCOORD_0", "1", nullptr},
    {"/meshes/0/primitives/0/attributes/JOINTS_0", "5", "/accessors/5/componentType"},
    {"/meshes/0/primitives/0/attributes/WEIGHTS_0", "0", nullptr},
    {"/meshes/0/primitives/0/indices", "10", nullptr},
    {"/meshes/0/primitives/0/indices", "0", nullptr},
    {"/meshes/0/primitives/0/indices", "7", "/accessors/7/componentType"},
    {"/meshes/0/primitives/0/material", "1", nullptr},
    {"/meshes/0/primitives/0/mode", "7", nullptr},
    {"/meshes/0/primitives/0/targets/0/POSITION", "44", nullptr},
    {"/meshes/0/primitives/0/targets/0", "[]", nullptr},
    {"/meshes/0/weights", "[\"a\"]", "/meshes/0/weights/0"},
    {"/meshes/0/name", "3", nullptr},
    {"/nodes/0/mesh", "2", nullptr},
    {"/nodes/0/skin", "1", nullptr},
    {"/nodes/1/camera", "2", nullptr},
    {"/nodes/1/children/0", "17", nullptr},
    {"/nodes/1/children/0", "1", "/nodes/1/children"},
    {"/nodes/2/children", "[1]", "/nodes/1/children"},
    {"/nodes/0/children", "[2]", "/nodes/1/children/0"},
    {"/nodes/1/children", "[2, 2]", "/nodes/1/children/1"},
    {"/nodes/2/matrix", "[1, 2]", nullptr},
    {"/nodes/2/matrix/15", "2", "/nodes/2/matrix"},
    {"/nodes/0/rotation", "[1, 0, 0]", nullptr},
    {"/nodes/0/translation/0", "1e39", nullptr},
    {"/nodes/0/scale/0", "\"x\"", nullptr},
    {"/nodes/1/extensions/KHR_lights_punctual/light", "1", nullptr},
    {"/nodes/1/extensions", "3", nullptr},
    {"/nodes/2/extensions/EXT_mesh_gpu_instancing/attributes/TRANSLATION", "5", nullptr},
    {"/nodes/2/extensions/EXT_mesh_gpu_instancing/attributes/SCALE", "0",
     "/nodes/2/extensions/EXT_mesh_gpu_instancing/attributes/SCALE"},
    {"/skins/0/joints/0", "3", nullptr},
    {"/skins/0/joints", "[]", nullptr},
    {"/skins/0/joints", "[1, 2]", "/skins/0/inverseBindMatrices"},
    {"/skins/0/inverseBindMatrices", "0", nullptr},
    {"/cameras/0/type", "\"fisheye\"", nullptr},
    {"/cameras/0/perspective", "", "/cameras/0"},
    {"/cameras/0/perspective/yfov", "0", nullptr},
    {"/cameras/1/orthographic/ymag", "0", nullptr},
    {"/extensions/KHR_lights_punctual/lights/0/type", "\"neon\"", nullptr},
    {"/extensions/KHR_lights_punctual/lights/0/intensity", "-1", nullptr},
    {"/extensions/KHR_lights_punctual/lights/0/color", "[1, 1]", nullptr},
    {"/extensions/KHR_lights_punctual/lights/0/spot/outerConeAngle", "3", nullptr},
    {"/animations/0/channels/0/sampler", "1", nullptr},
    {"/animations/0/channels/0/target", "", "/animations/0/channels/0"},
    {"/animations/0/channels/0/target/node", "3", nullptr},
    {"/animations/0/channels/0/target/path", "\"rotation\"", "/animations/0/samplers/0/output"},
    {"/animations/0/samplers/0/input", "8", nullptr},
    {"/animations/0/samplers/0/output", "0", nullptr},
    {"/animations/0/samplers/0/output", "12", nullptr},
    {"/animations/0/samplers/0/interpolation", "\"SMOOTH\"", nullptr},
    {"/materials/0/pbrMetallicRoughness/baseColorTexture/index", "1", nullptr},
    {"/materials/0/normalTexture/index", "-1", nullptr},
    {"/materials/0/normalTexture", "4", nullptr},
    {"/materials/0/alphaMode", "\"GLASS\"", nullptr},
    {"/materials/0/pbrMetallicRoughness/baseColorFactor", "[1, 1, 1]", nullptr},
    {"/materials/0/pbrMetallicRoughness/metallicFactor", "\"shiny\"", nullptr},
    {"/materials/0/doubleSided", "\"yes\"", nullptr},
    {"/textures/0/source", "1", nullptr},
    {"/textures/0/sampler", "9", nullptr},
    {"/samplers/0/wrapS", "1", nullptr},
    {"/images/0/bufferView", "50", nullptr},
};

TEST(GltfBroken, one_wrong_property)
{
    for (const Change& change : changes) {
        TestFile file = rich_file();
        file.document["buffers"] = json::array({{{"byteLength", file.binary.size()}}});
        const std::string pointer = change.pointer;
        if (*change.value == '\0') {
            const size_t slash = pointer.rfind('/');
            file.document[json::json_pointer(pointer.substr(0, slash))].erase(pointer.substr(slash + 1));
        } else {
            file.document[json::json_pointer(pointer)] = json::parse(change.value);
        }
        const std::string where = change.where == nullptr ? change.pointer : change.where;
        expect_error(file.glb(), "broken.glb", "broken.glb#" + where, pointer + " = " + change.value);
    }
}

template <typename Value>
void expect_bad_data(size_t view, size_t element, Value value, const std::string& where,
                     const std::string& part)
{
    TestFile file = rich_file();
    const auto offset = file.document["bufferViews"][view]["byteOffset"].get<size_t>();
    std::memcpy(file.binary.data() + offset + element * sizeof(Value), &value, sizeof value);
    expect_error(file.glb(), "broken.glb", "broken.glb#" + where, where);
    try {
        (void)file.load();
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
    }
}

TEST(GltfBroken, wrong_data_in_the_buffers)
{
    constexpr float nan = std::numeric_limits<float>::quiet_NaN();
    constexpr float infinity = std::numeric_limits<float>::infinity();
    expect_bad_data(0, 4, nan, "/meshes/0/primitives/0/attributes/POSITION",
                    "vertex 1 has a position that is not finite");
    expect_bad_data(0, 8, -infinity, "/meshes/0/primitives/0/attributes/POSITION", "vertex 2");
    expect_bad_data(2, 1, uint16_t{3}, "/meshes/0/primitives/0/indices", "index 1 is 3, past the 3 vertices");
    expect_bad_data(2, 2, uint16_t{65535}, "/meshes/0/primitives/0/indices", "index 2 is 65535");
    expect_bad_data(4, 4, uint8_t{1}, "/nodes/0/skin", "mesh 0 names joint 1, but skin 0 has 1");
    expect_bad_data(6, 3, nan, "/skins/0/inverseBindMatrices", "matrix 0 is not finite");
    expect_bad_data(7, 1, nan, "/accessors/7", "animation value 1 is not finite");
    expect_bad_data(8, 5, infinity, "/nodes/2/extensions/EXT_mesh_gpu_instancing",
                    "instance 1 is not finite");
    expect_bad_data(9, 0, uint16_t{3}, "/accessors/9/sparse/indices",
                    "index 3 is past the accessor's 3 elements");
    expect_bad_data(10, 1, nan, "/meshes/0/primitives/0/targets/0/POSITION", "vertex 1 has an offset");
}

TEST(GltfBroken, nothing_to_draw)
{
    TestFile file = triangle_file();
    file.document["nodes"][0].erase("mesh");
    expect_error(file.glb(), "broken.glb", "broken.glb", "no mesh in the tree");
    file = triangle_file();
    file.document["scenes"][0]["nodes"] = json::array();
    expect_error(file.glb(), "broken.glb", "broken.glb", "empty scene");
    file = triangle_file();
    file.document["meshes"][0]["primitives"] = json::array();
    expect_error(file.glb(), "broken.glb", "broken.glb", "empty mesh");
    expect_error(text_bytes(R"({"asset": {"version": "2.0"}})"), "broken.gltf", "broken.gltf",
                 "empty document");
}

Bytes with_u32(Bytes bytes, size_t offset, uint32_t value)
{
    std::memcpy(bytes.data() + offset, &value, sizeof value);
    return bytes;
}

TEST(GltfBroken, wrong_container)
{
    const Bytes good = triangle_file().glb();
    const auto check = [](const Bytes& bytes, size_t byte, const std::string& label) {
        expect_error(bytes, "broken.glb", "broken.glb:byte " + std::to_string(byte), label);
    };
    uint32_t json_bytes = 0;
    std::memcpy(&json_bytes, good.data() + 12, sizeof json_bytes);
    check({}, 0, "empty");
    check(text_bytes("glT"), 3, "cut in the magic");
    check(Bytes(good.begin(), good.begin() + 8), 8, "cut in the header");
    check(Bytes(good.begin(), good.end() - 1), 8, "cut at the end");
    check(Bytes(good.begin(), good.begin() + 30), 8, "cut in the JSON");
    check(with_u32(good, 4, 1), 4, "version 1");
    check(with_u32(good, 8, 12), 8, "length without chunks");
    check(with_u32(good, 8, static_cast<uint32_t>(good.size() - 4)), 20 + json_bytes,
          "length shorter than the chunks");
    check(with_u32(good, 8, 20 + json_bytes + 4), 20 + json_bytes, "cut in the second chunk header");
    check(with_u32(good, 12, 0xFFFFFFFF), 12, "chunk of 4 GB");
    check(with_u32(good, 16, 0x004E4942), 16, "binary chunk first");
    check(with_u32(good, 20, 0x20202020), 24, "JSON does not begin");
    check(text_bytes("PK\3\4 a zip"), 0, "a zip file");
    check(text_bytes(" \n\t"), 0, "blank");
    check(text_bytes("  [1, 2]"), 2, "an array");
    check(text_bytes("solid cube"), 0, "another format");
}

TEST(GltfBroken, wrong_json)
{
    const auto check = [](const std::string& text, const std::string& place) {
        expect_error(text_bytes(text), "broken.gltf", "broken.gltf:" + place, text.substr(0, 40));
    };
    check("{", "1:2");
    check("{\n  \"asset\": {\"version\": \"2.0\",}\n}", "2:30");
    check("{\"asset\": nul}", "1:14");
    check("{\"asset\": \"\xFF\"}", "1:12");
    check("{\n\"a\": 1e400}", "2:6");
    check("{\"asset\": {}} trailing", "1:17");
    check("{\"a\": \"unended", "1:15");
    check("{\"a\":" + std::string(100000, '['), "1:261");
    std::string objects;
    for (int i = 0; i < 1000; ++i) {
        objects += "{\"a\":";
    }
    check(objects, "1:1281");
}

TEST(GltfBroken, small_file_with_a_large_count_does_not_allocate)
{
    for (const char* count : {"2147483648", "4294967295", "100000000"}) {
        const std::string text =
            std::string(R"({"asset":{"version":"2.0"},"accessors":[{"componentType":5126,"type":"VEC3",)") +
            R"("count":)" + count + R"(}],"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],)" +
            R"("nodes":[{"mesh":0}]})";
        expect_error(text_bytes(text), "broken.gltf", "broken.gltf#/accessors/0/count", count);
    }
}

TEST(GltfBroken, many_uses_of_one_accessor_do_not_multiply_it)
{
    TestFile file = triangle_file();
    const size_t vertices = 100000;
    file.attributes() = {{"POSITION", file.add(std::vector<float>(vertices * 3, 1.0F), "VEC3")}};
    json& primitives = file.document["meshes"][0]["primitives"];
    primitives[0].erase("indices");
    const json one = primitives[0];
    for (int i = 0; i < 2000; ++i) {
        primitives.push_back(one);
    }
    EXPECT_THROW((void)file.load(), Error);
}

} // namespace
} // namespace estampe::gltf
