// SPDX-License-Identifier: MIT
#include "scene/obj/obj_materials.hpp"

#include <algorithm>
#include <unordered_map>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <estampe/error.hpp>

#include "scene/input/scanner.hpp"
#include "scene/obj/mtl.hpp"
#include "scene/obj/obj_textures.hpp"

namespace estampe::obj {
namespace {

constexpr uint64_t most_library_bytes = uint64_t{1} << 28;
constexpr size_t most_libraries = 1000;
constexpr size_t most_named = 8; ///< names in one warning

/// Words of a line, where quotes hold words together.
std::vector<std::string> words_of(std::string_view line)
{
    std::vector<std::string> words;
    bool is_quoted = false;
    std::string word;
    const auto end_word = [&] {
        if (!word.empty())
            words.push_back(std::move(word));
        word.clear();
    };
    for (const char letter : line) {
        if (letter == '"')
            is_quoted = !is_quoted;
        else if (Scanner::is_blank(letter) && !is_quoted)
            end_word();
        else
            word += letter;
    }
    end_word();
    return words;
}

/// Finds material libraries.
class Libraries {
public:
    Libraries(const std::filesystem::path& file, Scene& scene)
        : file_(file), scene_(scene), finder_({file.parent_path()})
    {
    }

    std::vector<std::filesystem::path> find(const std::vector<std::string>& lines)
    {
        for (size_t i = 0; i < std::min(lines.size(), most_libraries); ++i)
            find_line(lines[i]);
        return std::move(found_);
    }

private:
    /// A line may be one name with blanks in it, or several names, each perhaps with blanks.
    void find_line(const std::string& line)
    {
        if (line.empty() || found(line))
            return;
        constexpr size_t most_words = 32;
        std::vector<std::string> words = words_of(line);
        words.resize(std::min(words.size(), most_words));
        std::vector<std::string> missing;
        for (size_t i = 0; i < words.size();) {
            size_t used = 0;
            for (size_t count = words.size() - i; count > 0 && used == 0; --count) {
                const auto first = words.begin() + static_cast<std::ptrdiff_t>(i);
                if (found(
                        fmt::format("{}", fmt::join(first, first + static_cast<std::ptrdiff_t>(count), " "))))
                    used = count;
            }
            if (used == 0)
                missing.push_back(words[i]);
            i += std::max<size_t>(used, 1);
        }
        const std::string own_name = file_.stem().string() + ".mtl";
        if (!missing.empty() && !found(own_name)) {
            scene_.missing_files.insert(scene_.missing_files.end(), missing.begin(), missing.end());
            scene_.warnings.push_back(fmt::format(
                "material library \"{}\" is not there: its materials are drawn grey",
                missing.size() == words.size() ? line : fmt::format("{}", fmt::join(missing, " "))));
        }
    }

    bool found(const std::string& name)
    {
        std::optional<std::filesystem::path> library = finder_.find(name);
        if (!library)
            return false;
        if (std::find(found_.begin(), found_.end(), *library) == found_.end())
            found_.push_back(*std::move(library));
        return true;
    }

    const std::filesystem::path& file_;
    Scene& scene_;
    FileFinder finder_;
    std::vector<std::filesystem::path> found_;
};

void set_opacity(const MtlMaterial& source, Material& material, std::vector<std::string>& warnings)
{
    // Programs disagree on whether Tr 1 is clear or opaque; d is clear.
    const double opacity = source.dissolve.value_or(1.0 - source.transparency.value_or(0.0));
    if (!(opacity > 0.0)) {
        warnings.push_back(
            fmt::format("material \"{}\": opacity {} would hide it; drawn opaque", material.name, opacity));
    } else if (opacity < 0.999) {
        material.base_color.w = static_cast<float>(opacity);
        material.alpha_mode = AlphaMode::blend;
    }
}

Material material_of(const MtlMaterial& source, const glm::vec3& default_color, Textures& textures,
                     FileFinder& finder, std::vector<std::string>& warnings)
{
    Material material;
    material.name = source.name;
    material.double_sided = true;
    material.metallic = static_cast<float>(source.metallic.value_or(0.0));
    material.roughness = static_cast<float>(source.roughness.value_or(1.0));
    material.base_color = glm::vec4(source.diffuse.value_or(default_color), 1.0F);
    material.emissive = source.emissive.value_or(glm::vec3(0.0F));
    set_opacity(source, material, warnings);
    if (!source.dissolve_map.file.empty()) {
        material.base_color_texture =
            textures.color_with_opacity(source.diffuse_map, source.dissolve_map, finder);
        if (material.alpha_mode == AlphaMode::opaque && textures.has(source.dissolve_map, finder))
            material.alpha_mode = AlphaMode::mask;
    } else if (!source.diffuse_map.file.empty()) {
        material.base_color_texture = textures.color(source.diffuse_map, finder);
    }
    // Exporters leave a colour black, or out, where the texture says it all.
    const bool is_said_by_texture =
        !source.diffuse_map.file.empty() && source.diffuse.value_or(glm::vec3(0.0F)) == glm::vec3(0.0F);
    if (is_said_by_texture)
        material.base_color = glm::vec4(glm::vec3(1.0F), material.base_color.w);
    if (!source.emissive_map.file.empty() && textures.has(source.emissive_map, finder)) {
        material.emissive_texture = textures.color(source.emissive_map, finder);
        if (material.emissive == glm::vec3(0.0F))
            material.emissive = glm::vec3(1.0F);
    }
    const MtlMap& normals = source.normal_map.file.empty() ? source.bump_map : source.normal_map;
    if (!normals.file.empty()) {
        material.normal_texture = textures.normals(normals, finder);
        material.normal_scale = static_cast<float>(std::clamp(normals.bump, -16.0, 16.0));
    }
    return material;
}

std::vector<MtlMaterial> parsed(const std::filesystem::path& library, std::vector<std::string>& warnings)
{
    try {
        Input input(library);
        if (input.size() > most_library_bytes)
            throw Error("is too long for a material library", library.string());
        return parse_mtl(input);
    } catch (const Error& error) {
        warnings.push_back(fmt::format("materials are drawn grey: {}", error.what()));
        return {};
    }
}

void warn_of_missing(const std::vector<std::string>& missing, std::vector<std::string>& warnings)
{
    if (missing.empty())
        return;
    const size_t named = std::min(missing.size(), most_named);
    warnings.push_back(fmt::format(
        "material{} {}{} {} in no material library: drawn grey", missing.size() == 1 ? "" : "s",
        fmt::join(missing.begin(), missing.begin() + static_cast<std::ptrdiff_t>(named), ", "),
        missing.size() > named ? fmt::format(" and {} more", missing.size() - named) : std::string(),
        missing.size() == 1 ? "is" : "are"));
}

} // namespace

void read_materials(const std::filesystem::path& file, const std::vector<std::string>& libraries,
                    const std::vector<std::string>& used, const glm::vec3& default_color, Scene& scene)
{
    const size_t warned = scene.warnings.size();
    const std::vector<std::filesystem::path> found = Libraries(file, scene).find(libraries);
    const bool lacks_library = scene.warnings.size() > warned;
    std::unordered_map<std::string, size_t> place_of_name;
    for (const std::string& name : used) {
        place_of_name.emplace(name, scene.materials.size());
        scene.materials.push_back({.name = name,
                                   .base_color = glm::vec4(default_color, 1.0F),
                                   .metallic = 0.0F,
                                   .double_sided = true});
    }
    std::vector<bool> is_known(used.size(), false);
    Textures textures(scene);
    for (const std::filesystem::path& library : found) {
        FileFinder finder({library.parent_path(), file.parent_path()});
        for (const MtlMaterial& source : parsed(library, scene.warnings)) {
            const auto [place, is_new] = place_of_name.try_emplace(source.name, scene.materials.size());
            // The first library that has a name counts.
            if (!is_new && (place->second >= is_known.size() || is_known[place->second]))
                continue;
            if (is_new)
                scene.materials.emplace_back();
            else
                is_known[place->second] = true;
            scene.materials[place->second] =
                material_of(source, default_color, textures, finder, scene.warnings);
        }
    }
    std::vector<std::string> missing;
    for (size_t i = 0; i < used.size(); ++i)
        if (!is_known[i])
            missing.push_back(fmt::format("\"{}\"", used[i]));
    if (!lacks_library)
        warn_of_missing(missing, scene.warnings);
}

} // namespace estampe::obj
