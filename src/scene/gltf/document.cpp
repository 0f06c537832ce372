// SPDX-License-Identifier: MIT
#include "scene/gltf/document.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <estampe/error.hpp>

#include "scene/gltf/check.hpp"
#include "scene/gltf/extensions.hpp"

namespace estampe::gltf {
namespace {

using nlohmann::json;

json parse_json(const Container& container, const std::string& file)
{
    try {
        return json::parse(container.json);
    } catch (const json::parse_error& error) {
        const size_t byte = error.byte > 0 ? error.byte - 1 : 0;
        throw Error("JSON syntax error", place_in_json(container, file, byte),
                    "check the file in an editor, or export it again");
    } catch (const json::out_of_range& error) {
        const std::string text = error.what();
        const size_t open = text.find('\'');
        const std::string number =
            open == std::string::npos ? "" : text.substr(open + 1, text.rfind('\'') - open - 1);
        const size_t byte = number.empty() ? 0 : container.json.find(number);
        throw Error(fmt::format("number {} is too large", number.substr(0, 40)),
                    place_in_json(container, file, byte));
    }
}

void check_version(const json& document, const std::string& file)
{
    const auto& version = document["asset"]["version"].get_ref<const std::string&>();
    if (!version.starts_with("2.")) {
        throw Error(fmt::format("glTF version {}; only version 2 is read", version.substr(0, 20)),
                    file + "#/asset/version", "convert it to glTF 2.0");
    }
}

void check_required_extensions(const json& document, const std::string& file)
{
    const json& required = document.value("extensionsRequired", json::array());
    for (size_t i = 0; i < required.size(); ++i) {
        const auto name = required[i].get<std::string>();
        if (!knows_extension(name) && !can_do_without(name)) {
            throw Error(fmt::format("requires the extension {}, which is not supported and may change or "
                                    "compress the geometry",
                                    name),
                        fmt::format("{}#/extensionsRequired/{}", file, i), "export the file without it");
        }
    }
}

std::vector<BufferSource> take_buffers(json& document)
{
    std::vector<BufferSource> buffers;
    for (json& buffer : document["buffers"]) {
        BufferSource& source = buffers.emplace_back();
        source.byte_length = buffer["byteLength"].get<uint64_t>();
        if (buffer.contains("uri")) {
            source.uri = std::move(buffer["uri"].get_ref<std::string&>());
        }
    }
    document.erase("buffers");
    return buffers;
}

std::vector<ImageSource> take_images(json& document)
{
    std::vector<ImageSource> images;
    for (json& image : document["images"]) {
        ImageSource& source = images.emplace_back();
        source.name = image.value("name", std::string());
        source.view = image.value("bufferView", -1);
        if (image.contains("uri")) {
            source.uri = std::move(image["uri"].get_ref<std::string&>());
        }
    }
    document.erase("images");
    return images;
}

std::vector<std::vector<int>> take_indices(json& document)
{
    std::vector<std::vector<int>> indices;
    for (json& mesh : document["meshes"]) {
        std::vector<int>& of_mesh = indices.emplace_back();
        for (json& primitive : mesh["primitives"]) {
            of_mesh.push_back(primitive.value("indices", -1));
            primitive.erase("indices");
        }
    }
    return indices;
}

std::vector<std::string> variant_names(const json& document)
{
    const json::json_pointer pointer("/extensions/KHR_materials_variants/variants");
    std::vector<std::string> names;
    for (const json& variant : document.contains(pointer) ? document.at(pointer) : json::array()) {
        names.push_back(variant.value("name", fmt::format("variant {}", names.size())));
    }
    return names;
}

/// tinygltf refuses a channel without a node, which glTF allows.
void complete_channels(json& document)
{
    for (json& animation : document["animations"]) {
        for (json& channel : animation["channels"]) {
            if (!channel["target"].contains("node")) {
                channel["target"]["node"] = -1;
            }
        }
    }
}

tinygltf::Model parse_model(const json& document, const std::string& file)
{
    tinygltf::Model model;
    tinygltf::TinyGLTF parser;
    std::string failure;
    std::string warning;
    const std::string text = document.dump();
    if (!parser.LoadASCIIFromString(&model, &failure, &warning, text.c_str(),
                                    static_cast<unsigned>(text.size()), "")) {
        throw Error(fmt::format("is not valid glTF: {}", failure.substr(0, failure.find('\n'))), file);
    }
    return model;
}

} // namespace

Document read_document(const Container& container, const std::string& file)
{
    json parsed = parse_json(container, file);
    check_document(parsed, file);
    check_version(parsed, file);
    check_required_extensions(parsed, file);
    Document document;
    document.buffers = take_buffers(parsed);
    document.images = take_images(parsed);
    document.indices = take_indices(parsed);
    document.variants = variant_names(parsed);
    complete_channels(parsed);
    document.model = parse_model(parsed, file);
    return document;
}

} // namespace estampe::gltf
