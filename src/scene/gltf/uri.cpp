// SPDX-License-Identifier: MIT
#include "scene/gltf/uri.hpp"

#include <array>
#include <cstdint>

namespace estampe::gltf {
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

} // namespace estampe::gltf
