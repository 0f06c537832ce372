// SPDX-License-Identifier: MIT
#include "sniffed_format.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstring>
#include <span>
#include <string>

#include "scene/input/input.hpp"
#include "scene/input/scanner.hpp"

namespace estampe::app {
namespace {

std::string lower_case(std::string_view text)
{
    std::string lower(text);
    std::ranges::transform(lower, lower.begin(),
                           [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
    return lower;
}

bool is_binary_stl(std::string_view beginning, uint64_t size_bytes)
{
    constexpr size_t head_bytes = 84;
    constexpr uint64_t triangle_bytes = 50;
    uint32_t triangles = 0;
    if (beginning.size() < head_bytes) {
        return false;
    }
    std::memcpy(&triangles, beginning.data() + head_bytes - sizeof(triangles), sizeof(triangles));
    return size_bytes == head_bytes + triangle_bytes * triangles;
}

/// Whether an OBJ file may begin with this statement. Words that other languages begin with need what follows
/// them in OBJ.
bool is_obj_statement(Scanner line)
{
    constexpr std::array<std::string_view, 6> with_numbers{"v", "vn", "vt", "vp", "f", "s"};
    constexpr std::array<std::string_view, 4> with_names{"mtllib", "usemtl", "o", "g"};
    const std::string_view word = line.word();
    if (std::ranges::find(with_names, word) != with_names.end()) {
        return true;
    }
    if (std::ranges::find(with_numbers, word) == with_numbers.end()) {
        return false;
    }
    const std::string_view first = line.word();
    const bool is_number = std::isfinite(number_of_word(first.substr(0, first.find('/'))));
    return is_number || (word == "s" && first == "off");
}

bool is_blank_or_comment(Scanner line)
{
    return line.is_done() || line.word().starts_with('#');
}

/// Whether this follows the first line of an STL file that is text, since many a binary one begins with
/// "solid" too.
bool is_rest_of_stl(const std::string& text)
{
    constexpr std::array<std::string_view, 3> words{"facet", "vertex", "endsolid"};
    return text.find('\0') == std::string::npos && std::ranges::any_of(words, [&](std::string_view word) {
               return text.find(word) != std::string::npos;
           });
}

/// The format of text that is read line by line.
std::string_view text_format(std::string_view beginning)
{
    Input input(std::as_bytes(std::span(beginning)), {});
    input.detect_encoding();
    std::string_view line;
    do {
        if (!input.next_line(line)) {
            return {};
        }
    } while (is_blank_or_comment(Scanner(line)));
    const std::string first = lower_case(Scanner(line).word());
    if (first == "ply") {
        return "ply";
    }
    if (first.starts_with("solid") || first.starts_with("facet")) {
        return is_rest_of_stl(lower_case(input.peek(sniffed_bytes))) ? "stl" : "";
    }
    return is_obj_statement(Scanner(line)) ? "obj" : "";
}

} // namespace

std::string_view sniffed_format(std::string_view beginning, uint64_t size_bytes)
{
    const auto holds = [&](std::string_view word) { return beginning.find(word) != std::string_view::npos; };
    if (beginning.starts_with("glTF")) {
        return "glb";
    }
    if (beginning.starts_with("Kaydara FBX Binary") || beginning.starts_with("; FBX")) {
        return "fbx";
    }
    if (is_binary_stl(beginning, size_bytes)) {
        return "stl";
    }
    const size_t first = beginning.find_first_not_of(" \t\r\n\xef\xbb\xbf");
    const std::string_view text = first == std::string_view::npos ? "" : beginning.substr(first);
    if (text.starts_with('{')) {
        return "gltf";
    }
    if (text.starts_with('<')) {
        return holds("<COLLADA") ? "dae" : "";
    }
    return text_format(beginning);
}

} // namespace estampe::app
