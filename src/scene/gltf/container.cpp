// SPDX-License-Identifier: MIT
#include "scene/gltf/container.hpp"

#include <algorithm>
#include <cstdint>
#include <cstring>

#include <fmt/format.h>

#include <estampe/error.hpp>

#include "core/file.hpp"

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

/// The chunk at `offset`, and the offset after it.
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

/// The length that the header of a .glb promises.
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

/// Throws unless the first byte that is not blank begins a JSON object.
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

std::string place_in_json(const Container& container, const std::string& file, size_t json_byte)
{
    if (container.is_binary) {
        return fmt::format("{}:byte {}", file, container.json_offset + json_byte);
    }
    const std::string_view before = container.json.substr(0, std::min(json_byte, container.json.size()));
    const auto line = std::count(before.begin(), before.end(), '\n') + 1;
    const size_t line_start = before.rfind('\n') + 1; // npos + 1 is 0
    return fmt::format("{}:{}:{}", file, line, before.size() - line_start + 1);
}

std::vector<std::byte> read_gltf_bytes(const std::filesystem::path& path)
{
    constexpr uint64_t start_bytes = 4096;
    constexpr uint64_t max_text_bytes = uint64_t{1} << 32;
    std::vector<std::byte> start = read_file_start(path, start_bytes);
    if (start.size() < start_bytes) {
        return start;
    }
    if (is_binary(start)) {
        return read_file_start(path, std::max<uint64_t>(promised_length(start, path.string()), start_bytes));
    }
    check_is_text(start, path.string());
    return read_file(path, max_text_bytes);
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

} // namespace estampe::gltf
