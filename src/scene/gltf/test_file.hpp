// SPDX-License-Identifier: MIT
#pragma once

// Builds glTF files in memory for tests.

#include <cstring>
#include <span>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include <estampe/scene.hpp>

#include "scene/importers.hpp"

namespace estampe::gltf {

using nlohmann::json;
using Bytes = std::vector<std::byte>;

template <typename Value>
Bytes bytes_of(const std::vector<Value>& values)
{
    Bytes bytes(values.size() * sizeof(Value));
    std::memcpy(bytes.data(), values.data(), bytes.size());
    return bytes;
}

template <typename Value>
constexpr int component_type_of()
{
    if constexpr (std::is_same_v<Value, int8_t>) {
        return 5120;
    } else if constexpr (std::is_same_v<Value, uint8_t>) {
        return 5121;
    } else if constexpr (std::is_same_v<Value, int16_t>) {
        return 5122;
    } else if constexpr (std::is_same_v<Value, uint16_t>) {
        return 5123;
    } else if constexpr (std::is_same_v<Value, uint32_t>) {
        return 5125;
    } else {
        return 5126;
    }
}

inline size_t width_of(const std::string& type)
{
    return type == "SCALAR" ? 1 : type == "MAT4" ? 16 : static_cast<size_t>(type.back() - '0');
}

/// A glTF document with one buffer, built in memory for tests.
struct TestFile {
    json document = {{"asset", {{"version", "2.0"}}}};
    Bytes binary;

    /// Appends a buffer view of these bytes and returns its index.
    int add_view(const Bytes& bytes, const json& more = json::object())
    {
        binary.resize((binary.size() + 3) / 4 * 4);
        json view = {{"buffer", 0}, {"byteOffset", binary.size()}, {"byteLength", bytes.size()}};
        view.update(more);
        document["bufferViews"].push_back(view);
        binary.insert(binary.end(), bytes.begin(), bytes.end());
        return static_cast<int>(document["bufferViews"].size()) - 1;
    }

    /// Appends an accessor with its own buffer view and returns its index.
    template <typename Value>
    int add(const std::vector<Value>& values, const std::string& type, const json& more = json::object())
    {
        json accessor = {{"bufferView", add_view(bytes_of(values))},
                         {"componentType", component_type_of<Value>()},
                         {"count", values.size() / width_of(type)},
                         {"type", type}};
        accessor.update(more);
        return add_accessor(accessor);
    }

    int add_accessor(const json& accessor)
    {
        document["accessors"].push_back(accessor);
        return static_cast<int>(document["accessors"].size()) - 1;
    }

    [[nodiscard]] json& primitive() { return document["meshes"][0]["primitives"][0]; }

    [[nodiscard]] json& attributes() { return primitive()["attributes"]; }

    [[nodiscard]] Bytes glb() const
    {
        json complete = document;
        Bytes padded = binary;
        padded.resize((padded.size() + 3) / 4 * 4);
        if (!padded.empty() && !complete.contains("buffers")) {
            complete["buffers"] = json::array({{{"byteLength", padded.size()}}});
        }
        std::string text = complete.dump();
        text.resize((text.size() + 3) / 4 * 4, ' ');
        Bytes file;
        const auto put_u32 = [&](size_t value) {
            const auto word = static_cast<uint32_t>(value);
            const auto* first = reinterpret_cast<const std::byte*>(&word);
            file.insert(file.end(), first, first + sizeof word);
        };
        put_u32(0x46546C67);
        put_u32(2);
        put_u32(12 + 8 + text.size() + (padded.empty() ? 0 : 8 + padded.size()));
        put_u32(text.size());
        put_u32(0x4E4F534A);
        const auto* text_bytes = reinterpret_cast<const std::byte*>(text.data());
        file.insert(file.end(), text_bytes, text_bytes + text.size());
        if (!padded.empty()) {
            put_u32(padded.size());
            put_u32(0x004E4942);
            file.insert(file.end(), padded.begin(), padded.end());
        }
        return file;
    }

    [[nodiscard]] Scene load() const { return load_gltf_bytes(glb(), "test.glb"); }
};

/// A glTF file with one triangle (0 0 0, 1 0 0, 0 1 0) with normals and indices, in one node. Accessors: 0
/// positions, 1 normals, 2 indices (uint16).
inline TestFile triangle_file()
{
    TestFile file;
    const int positions = file.add<float>({0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3");
    const int normals = file.add<float>({0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3");
    const int indices = file.add<uint16_t>({0, 1, 2}, "SCALAR");
    file.document["meshes"] = json::array(
        {{{"primitives", json::array({{{"attributes", {{"POSITION", positions}, {"NORMAL", normals}}},
                                       {"indices", indices}}})}}});
    file.document["nodes"] = json::array({{{"mesh", 0}}});
    file.document["scenes"] = json::array({{{"nodes", json::array({0})}}});
    file.document["scene"] = 0;
    return file;
}

/// Encodes bytes as standard base64.
inline std::string base64(std::span<const std::byte> bytes)
{
    constexpr const char* alphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (size_t i = 0; i < bytes.size(); i += 3) {
        uint32_t bits = 0;
        for (size_t k = 0; k < 3; ++k) {
            bits = bits << 8 | (i + k < bytes.size() ? std::to_integer<uint32_t>(bytes[i + k]) : 0U);
        }
        for (size_t k = 0; k < 4; ++k) {
            text += i + k > bytes.size() ? '=' : alphabet[bits >> (18 - 6 * k) & 63];
        }
    }
    return text;
}

} // namespace estampe::gltf
