// SPDX-License-Identifier: MIT
#include "scene/obj/obj_materials.hpp"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "core/text.hpp"
#include "scene/input/input.hpp"

namespace estampe::obj {
namespace {

/// Parses a colour such as "1 0.5 0", or one number for all three channels. Returns nothing for spectral
/// curves and CIE colours, which are rare.
std::optional<glm::vec3> color_of(Scanner words)
{
    glm::dvec3 color(0.0);
    int count = 0;
    while (count < 3 && words.number(color[count]) && std::isfinite(color[count]))
        ++count;
    if (count == 0)
        return std::nullopt;
    for (; count < 3; ++count)
        color[count] = color[0];
    return glm::vec3(glm::clamp(color, 0.0, 1e6));
}

std::optional<double> share_of(Scanner words)
{
    double value = 0.0;
    while (!words.is_done()) {
        // Words that are not numbers, such as -halo in "d -halo 0.5", are skipped.
        if (words.number(value) && std::isfinite(value))
            return std::clamp(value, 0.0, 1.0);
    }
    return std::nullopt;
}

/// Reads up to three numbers after an option, and stops at the first word that is not a number.
int read_numbers(Scanner& words, glm::dvec3& values)
{
    int count = 0;
    while (count < 3) {
        Scanner ahead = words;
        double value = 0.0;
        if (!ahead.number(value) || !std::isfinite(value))
            break;
        if (ahead.is_done())
            break; // the last word is the file name, even if it looks like a number
        values[count++] = value;
        words = ahead;
    }
    return count;
}

/// Reads an option with its values. Returns false if the word is not an option, but a file name that begins
/// with a minus.
bool read_option(std::string_view option, Scanner& words, MtlMap& map)
{
    glm::dvec3 values(0.0);
    if (option == "-s" || option == "-o" || option == "-t") {
        const int count = read_numbers(words, values);
        glm::dvec2& target = option == "-s" ? map.scale : map.offset;
        for (int i = 0; option != "-t" && i < std::min(count, 2); ++i)
            target[i] = values[i];
    } else if (option == "-bm" || option == "-boost" || option == "-texres" || option == "-mm") {
        const int count = read_numbers(words, values);
        if (option == "-bm" && count > 0)
            map.bump = values[0];
    } else if (option == "-clamp") {
        map.clamps = lower_case(words.word()) == "on";
    } else if (option == "-blendu" || option == "-blendv" || option == "-cc" || option == "-imfchan" ||
               option == "-type" || option == "-colorspace") {
        (void)words.word();
    } else {
        return false;
    }
    return true;
}

MtlMap map_of(Scanner words)
{
    MtlMap map;
    while (true) {
        Scanner ahead = words;
        const std::string option = lower_case(ahead.word());
        if (!option.starts_with('-') || ahead.is_done() || !read_option(option, ahead, map))
            break;
        words = ahead;
    }
    map.file = words.rest();
    return map;
}

void read_statement(std::string_view keyword, const Scanner& words, MtlMaterial& material)
{
    if (keyword == "kd")
        material.diffuse = color_of(words);
    else if (keyword == "ke")
        material.emissive = color_of(words);
    else if (keyword == "d")
        material.dissolve = share_of(words);
    else if (keyword == "tr")
        material.transparency = share_of(words);
    else if (keyword == "pr")
        material.roughness = share_of(words);
    else if (keyword == "pm")
        material.metallic = share_of(words);
    else if (keyword == "map_kd")
        material.diffuse_map = map_of(words);
    else if (keyword == "map_ke" || keyword == "map_emissive")
        material.emissive_map = map_of(words);
    else if (keyword == "map_d" || keyword == "map_opacity")
        material.dissolve_map = map_of(words);
    else if (keyword == "bump" || keyword == "map_bump")
        material.bump_map = map_of(words);
    else if (keyword == "norm" || keyword == "map_norm" || keyword == "map_kn")
        material.normal_map = map_of(words);
}

} // namespace

std::vector<MtlMaterial> parse_mtl(Input& input)
{
    input.detect_encoding();
    std::vector<MtlMaterial> materials;
    std::unordered_map<std::string, size_t> known;
    std::string_view line;
    size_t current = 0;
    while (input.next_line(line)) {
        Scanner words(line);
        const std::string keyword = lower_case(words.word());
        if (keyword == "newmtl") {
            const auto [found, is_new] = known.try_emplace(std::string(words.rest()), materials.size());
            if (is_new)
                materials.emplace_back().name = found->first;
            current = found->second;
        } else if (current < materials.size()) {
            read_statement(keyword, words, materials[current]);
        }
    }
    return materials;
}

} // namespace estampe::obj
