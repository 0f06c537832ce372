// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <estampe/error.hpp>

#include "core/file.hpp"
#include "scene/gltf/convert.hpp"
#include "scene/gltf/data.hpp"

namespace estampe::gltf {
namespace {

constexpr size_t header_bytes = 12;
constexpr size_t chunk_header_bytes = 8;
constexpr uint32_t chunk_json = 0x4E4F534A;
constexpr uint32_t chunk_binary = 0x004E4942;
constexpr int max_nesting = 256;

uint32_t read_u32(std::span<const std::byte> bytes, size_t offset)
{
    uint32_t value = 0;
    std::memcpy(&value, bytes.data() + offset, sizeof value);
    return value;
}

[[noreturn]] void fail_at(const std::string& what, const std::string& file, size_t byte,
                          const std::string& remedy = {})
{
    throw Error(what, fmt::format("{}:byte {}", file, byte), remedy);
}

/// Returns the chunk at `offset`, and advances `offset` to the end of the chunk.
std::span<const std::byte> take_chunk(std::span<const std::byte> bytes, size_t& offset, uint32_t& type,
                                      const std::string& file)
{
    if (bytes.size() - offset < chunk_header_bytes) {
        fail_at("the file ends inside a chunk header", file, offset,
                "it is truncated: fetch or export it again");
    }
    const uint64_t length = read_u32(bytes, offset);
    type = read_u32(bytes, offset + 4);
    const size_t start = offset + chunk_header_bytes;
    if (length > bytes.size() - start) {
        fail_at(fmt::format("chunk of {} bytes, but only {} are left", length, bytes.size() - start), file,
                offset, "the file is truncated: fetch or export it again");
    }
    offset = start + length;
    return bytes.subspan(start, length);
}

bool is_binary(std::span<const std::byte> bytes)
{
    constexpr std::string_view magic = "glTF";
    return std::memcmp(bytes.data(), magic.data(), std::min(bytes.size(), magic.size())) == 0;
}

/// Returns the length of the whole file, as declared in the header of a .glb file.
uint32_t promised_length(std::span<const std::byte> bytes, const std::string& file)
{
    if (bytes.size() < header_bytes) {
        fail_at("the file ends inside the glb header", file, bytes.size(),
                "it is truncated: fetch or export it again");
    }
    if (const uint32_t version = read_u32(bytes, 4); version != 2) {
        fail_at(fmt::format("glb version {}; only version 2 is read", version), file, 4,
                "convert it to glTF 2.0");
    }
    return read_u32(bytes, 8);
}

/// Throws Error unless the first non-blank byte begins a JSON object.
void check_is_text(std::span<const std::byte> bytes, const std::string& file)
{
    constexpr std::string_view blank_or_mark = " \t\r\n\xEF\xBB\xBF";
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    const size_t first = text.find_first_not_of(blank_or_mark);
    if (first == std::string_view::npos || text[first] != '{') {
        fail_at("is not a glTF file: neither a glb header nor a JSON object", file,
                first == std::string_view::npos ? 0 : first);
    }
}

Container open_binary(std::span<const std::byte> bytes, const std::string& file)
{
    const uint32_t length = promised_length(bytes, file);
    if (length > bytes.size()) {
        fail_at(fmt::format("the header promises {} bytes, the file has {}", length, bytes.size()), file, 8,
                "it is truncated: fetch or export it again");
    }
    if (length < header_bytes + chunk_header_bytes) {
        fail_at(fmt::format("the header promises only {} bytes", length), file, 8);
    }
    bytes = bytes.first(length);
    size_t offset = header_bytes;
    uint32_t type = 0;
    const auto text = take_chunk(bytes, offset, type, file);
    if (type != chunk_json) {
        fail_at("the first chunk is not JSON", file, header_bytes + 4);
    }
    Container container;
    container.json = {reinterpret_cast<const char*>(text.data()), text.size()};
    container.is_binary = true;
    container.json_offset = header_bytes + chunk_header_bytes;
    while (offset < bytes.size()) {
        const auto chunk = take_chunk(bytes, offset, type, file);
        if (type == chunk_binary && !container.binary) {
            container.binary = chunk;
        }
    }
    return container;
}

/// Converts a byte offset in the JSON text to a place for messages: "file:line:column" in a text file,
/// "file:byte N" in a binary file.
std::string place_in_json(const Container& container, const std::string& file, size_t json_byte)
{
    if (container.is_binary) {
        return fmt::format("{}:byte {}", file, container.json_offset + json_byte);
    }
    const std::string_view before = container.json.substr(0, std::min(json_byte, container.json.size()));
    const auto line = std::count(before.begin(), before.end(), '\n') + 1;
    // If there is no line end, npos + 1 is 0, the start of the first line.
    const size_t line_start = before.rfind('\n') + 1;
    return fmt::format("{}:{}:{}", file, line, before.size() - line_start + 1);
}

void check_nesting(const Container& container, const std::string& file)
{
    int depth = 0;
    bool in_string = false;
    for (size_t i = 0; i < container.json.size(); ++i) {
        const char character = container.json[i];
        if (in_string) {
            i += character == '\\' ? 1 : 0;
            in_string = character != '"';
        } else if (character == '"') {
            in_string = true;
        } else if (character == '{' || character == '[') {
            if (++depth > max_nesting) {
                throw Error(fmt::format("JSON nested deeper than {} levels", max_nesting),
                            place_in_json(container, file, i));
            }
        } else if (character == '}' || character == ']') {
            --depth;
        }
    }
}

} // namespace

std::vector<std::byte> read_gltf_bytes(const std::filesystem::path& path, const ReadScope& scope)
{
    constexpr uint64_t start_bytes = 4096;
    constexpr uint64_t max_text_bytes = uint64_t{1} << 32;
    std::vector<std::byte> start = read_file_start(path, start_bytes, scope);
    if (start.size() < start_bytes) {
        return start;
    }
    if (is_binary(start)) {
        return read_file_start(path, std::max<uint64_t>(promised_length(start, path.string()), start_bytes),
                               scope);
    }
    check_is_text(start, path.string());
    return read_file(path, max_text_bytes, scope);
}

Container open_container(std::span<const std::byte> bytes, const std::string& file)
{
    if (bytes.empty()) {
        fail_at("the file is empty", file, 0);
    }
    Container container;
    if (is_binary(bytes)) {
        container = open_binary(bytes, file);
    } else {
        check_is_text(bytes, file);
        container.json = {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
    }
    check_nesting(container, file);
    return container;
}

namespace {

constexpr uint8_t not_base64 = 0xFF;

constexpr std::array<uint8_t, 256> make_base64_table()
{
    constexpr std::string_view alphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::array<uint8_t, 256> table{};
    table.fill(not_base64);
    for (size_t i = 0; i < alphabet.size(); ++i) {
        table[static_cast<uint8_t>(alphabet[i])] = static_cast<uint8_t>(i);
    }
    return table;
}

constexpr std::array<uint8_t, 256> base64_table = make_base64_table();

std::optional<std::vector<std::byte>> decode_base64(std::string_view text)
{
    for (int padding = 0; padding < 2 && text.ends_with('='); ++padding) {
        text.remove_suffix(1);
    }
    if (text.size() % 4 == 1) {
        return std::nullopt;
    }
    std::vector<std::byte> bytes;
    bytes.reserve(text.size() / 4 * 3 + 2);
    uint32_t bits = 0;
    int bit_count = 0;
    for (const char character : text) {
        const uint8_t value = base64_table[static_cast<uint8_t>(character)];
        if (value == not_base64) {
            return std::nullopt;
        }
        bits = bits << 6 | value;
        bit_count += 6;
        if (bit_count >= 8) {
            bit_count -= 8;
            bytes.push_back(static_cast<std::byte>(bits >> bit_count & 0xFF));
        }
    }
    return bytes;
}

int hex_digit(char character)
{
    if (character >= '0' && character <= '9') {
        return character - '0';
    }
    const char lower = static_cast<char>(character | 0x20);
    return lower >= 'a' && lower <= 'f' ? lower - 'a' + 10 : -1;
}

} // namespace

bool is_data_uri(std::string_view uri)
{
    return uri.starts_with("data:");
}

std::optional<std::vector<std::byte>> decode_data_uri(std::string_view uri)
{
    const size_t comma = uri.find(',');
    if (comma == std::string_view::npos || !uri.substr(0, comma).ends_with(";base64")) {
        return std::nullopt;
    }
    return decode_base64(uri.substr(comma + 1));
}

std::optional<std::string> decode_relative_uri(std::string_view uri)
{
    std::string path;
    for (size_t i = 0; i < uri.size(); ++i) {
        if (uri[i] == '%' && i + 2 < uri.size() && hex_digit(uri[i + 1]) >= 0 && hex_digit(uri[i + 2]) >= 0) {
            path += static_cast<char>(hex_digit(uri[i + 1]) * 16 + hex_digit(uri[i + 2]));
            i += 2;
        } else {
            path += uri[i] == '\\' ? '/' : uri[i];
        }
    }
    const bool has_scheme = uri.substr(0, uri.find('/')).find(':') != std::string_view::npos;
    if (path.empty() || path.front() == '/' || has_scheme || path.find('\0') != std::string::npos) {
        return std::nullopt;
    }
    return path;
}

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
        throw Error("a number is too large", place_in_json(container, file, byte));
    }
}

void check_version(const json& document, const std::string& file)
{
    const auto& version = document["asset"]["version"].get_ref<const std::string&>();
    if (!version.starts_with("2.")) {
        throw Error("is another version of glTF than 2", file + "#/asset/version", "convert it to glTF 2.0");
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

/// Adds a target node to animation channels that have no target node. glTF allows such channels, but tinygltf
/// rejects them.
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
