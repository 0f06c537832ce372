// SPDX-License-Identifier: MIT
#include "scene/obj/obj_materials.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <unordered_map>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <estampe/error.hpp>
#include <estampe/scene.hpp>

#include "core/free_memory.hpp"
#include "core/image_codec.hpp"
#include "core/read_scope.hpp"
#include "scene/input/input.hpp"
#include "scene/pictures/picture_files.hpp"

namespace estampe::obj {
namespace {

/// Creates the textures of materials. Each picture is decoded once. A picture that cannot be found or read is
/// left out, with one warning that names it.
class Textures {
public:
    explicit Textures(Scene& scene) : scene_(scene) {}

    /// Returns whether the picture can be read.
    [[nodiscard]] bool has(const MtlMap& map, FileFinder& finder)
    {
        return picture(map.file, finder) != nullptr;
    }

    /// Returns a texture with the picture as it is. If the picture cannot be read, the texture is one white
    /// pixel, so that the colour of the material is visible.
    [[nodiscard]] TextureRef color(const MtlMap& map, FileFinder& finder);

    /// Returns a texture with the colours of one picture, and with the opacity of another picture in the
    /// alpha channel. The opacity is the alpha channel of `opacity_map` if it has one, else its brightness.
    /// If `color_map` names no file, the colour is white.
    [[nodiscard]] TextureRef color_with_opacity(const MtlMap& color_map, const MtlMap& opacity_map,
                                                FileFinder& finder);

    /// Returns a normal map; a height map is converted to a normal map. Returns nothing if the picture cannot
    /// be read.
    [[nodiscard]] TextureRef normals(const MtlMap& map, FileFinder& finder);

private:
    enum class Use : uint8_t { color, opacity, normals };

    using Key = std::tuple<std::string, std::string, Use, bool>;

    /// The decoded picture of a file. Pictures are large, so the picture is moved, not copied, into the first
    /// texture that uses it unchanged.
    struct Picture {
        std::optional<Image> image; ///< the picture; nothing if it cannot be read or was moved
        Index texture = no_index;   ///< the texture into which the picture was moved
    };

    [[nodiscard]] Picture& decoded(const std::string& name, FileFinder& finder);
    [[nodiscard]] const Image* picture(const std::string& name, FileFinder& finder);
    [[nodiscard]] std::string place_of(const std::string& name, FileFinder& finder);
    [[nodiscard]] std::optional<TextureRef> known(const Key& key, const MtlMap& map) const;
    [[nodiscard]] TextureRef add(const Key& key, const MtlMap& map, Image image);

    Scene& scene_;
    std::map<std::string, Picture> pictures_; ///< pictures by path, or by name if the file was not found
    std::map<Key, Index> textures_;
};

/// Slope of the surface at a place where the height map changes from black to white between adjacent texels.
constexpr float slope_of_height = 2.0F;

float brightness(const uint8_t* pixel)
{
    return (0.2126F * static_cast<float>(pixel[0]) + 0.7152F * static_cast<float>(pixel[1]) +
            0.0722F * static_cast<float>(pixel[2])) /
           255.0F;
}

/// Returns whether a picture is a normal map. In a normal map most texels are bluish, because most normals
/// point away from the surface.
bool holds_normals(const Image& image)
{
    const size_t pixels = image.rgba.size() / 4;
    const size_t step = std::max<size_t>(pixels / 4096, 1);
    double red = 0.0;
    double green = 0.0;
    double blue = 0.0;
    for (size_t i = 0; i < pixels; i += step) {
        red += image.rgba[4 * i];
        green += image.rgba[4 * i + 1];
        blue += image.rgba[4 * i + 2];
    }
    const double count = std::ceil(static_cast<double>(pixels) / static_cast<double>(step));
    return blue / count > std::max(red, green) / count + 24.0;
}

/// Converts a height map, whose brightness is the height, to a normal map. The green channel points up in the
/// picture, as in glTF.
Image normals_of_heights(const Image& heights, bool repeats)
{
    Image normals{.width = heights.width, .height = heights.height, .rgba = heights.rgba};
    const auto neighbour = [repeats](uint32_t at, int step, uint32_t size) {
        const int64_t place = int64_t{at} + step;
        const int64_t last = int64_t{size} - 1;
        return static_cast<uint32_t>(repeats ? (place + size) % size : std::clamp<int64_t>(place, 0, last));
    };
    const auto height = [&heights](uint32_t x, uint32_t y) {
        return brightness(&heights.rgba[4 * (size_t{y} * heights.width + x)]);
    };
    for (uint32_t y = 0; y < heights.height; ++y) {
        for (uint32_t x = 0; x < heights.width; ++x) {
            const float right = 0.5F * (height(neighbour(x, 1, heights.width), y) -
                                        height(neighbour(x, -1, heights.width), y));
            const float up = 0.5F * (height(x, neighbour(y, -1, heights.height)) -
                                     height(x, neighbour(y, 1, heights.height)));
            const glm::vec3 normal =
                glm::normalize(glm::vec3(-slope_of_height * right, -slope_of_height * up, 1.0F));
            uint8_t* const pixel = &normals.rgba[4 * (size_t{y} * heights.width + x)];
            for (int i = 0; i < 3; ++i)
                pixel[i] = static_cast<uint8_t>(std::lround(127.5F + 127.5F * normal[i]));
            pixel[3] = 255;
        }
    }
    return normals;
}

/// Combines the colours of one picture with the opacity of another picture, at the resolution of the larger
/// picture.
Image combined(const Image& colors, const Image& opacity, const std::string& name)
{
    Image image{.width = std::max(colors.width, opacity.width),
                .height = std::max(colors.height, opacity.height),
                .rgba = {}};
    require_memory(uint64_t{4} * image.width * image.height, "joining its opacity to its colours", name);
    image.rgba.resize(size_t{4} * image.width * image.height);
    bool has_alpha = false;
    for (size_t i = 3; i < opacity.rgba.size() && !has_alpha; i += 4)
        has_alpha = opacity.rgba[i] != 255;
    for (uint32_t y = 0; y < image.height; ++y) {
        for (uint32_t x = 0; x < image.width; ++x) {
            const auto texel = [&](const Image& from) {
                const size_t row = uint64_t{y} * from.height / image.height;
                const size_t column = uint64_t{x} * from.width / image.width;
                return &from.rgba[4 * (row * from.width + column)];
            };
            const uint8_t* const color = texel(colors);
            const uint8_t* const alpha = texel(opacity);
            uint8_t* const pixel = &image.rgba[4 * (size_t{y} * image.width + x)];
            std::copy_n(color, 3, pixel);
            pixel[3] = has_alpha ? alpha[3] : static_cast<uint8_t>(std::lround(255.0F * brightness(alpha)));
        }
    }
    return image;
}

/// Returns the matrix of uv' = scale * uv + offset in OBJ coordinates. In OBJ files v points up; in textures
/// it points down.
glm::mat3 uv_transform_of(const MtlMap& map)
{
    glm::mat3 transform(1.0F);
    transform[0][0] = static_cast<float>(map.scale.x);
    transform[1][1] = static_cast<float>(map.scale.y);
    transform[2][0] = static_cast<float>(map.offset.x);
    transform[2][1] = static_cast<float>(1.0 - map.scale.y - map.offset.y);
    return transform;
}

const Image white{.width = 1, .height = 1, .rgba = {255, 255, 255, 255}};

std::string Textures::place_of(const std::string& name, FileFinder& finder)
{
    const std::optional<std::filesystem::path> file = finder.find(name);
    return file ? file->string() : std::string();
}

Textures::Picture& Textures::decoded(const std::string& name, FileFinder& finder)
{
    const std::string place = place_of(name, finder);
    const auto [known, is_new] = pictures_.try_emplace(place.empty() ? name : place);
    if (is_new) {
        try {
            if (place.empty())
                throw Error("no such file", name, "put the picture beside the scene's file");
            scene_.files.emplace_back(place);
            known->second.image = read_image(place, finder.scope());
        } catch (const OutsideScope&) {
            throw;
        } catch (const Error& error) {
            scene_.warnings.push_back(fmt::format("texture left white: {}", error.what()));
        }
    }
    return known->second;
}

const Image* Textures::picture(const std::string& name, FileFinder& finder)
{
    const Picture& picture = decoded(name, finder);
    if (picture.texture != no_index)
        return &scene_.textures[picture.texture].image;
    return picture.image ? &*picture.image : nullptr;
}

std::optional<TextureRef> Textures::known(const Key& key, const MtlMap& map) const
{
    const auto found = textures_.find(key);
    if (found == textures_.end())
        return std::nullopt;
    return TextureRef{.texture = found->second, .uv_set = 0, .uv_transform = uv_transform_of(map)};
}

TextureRef Textures::add(const Key& key, const MtlMap& map, Image image)
{
    const Wrap wrap = map.clamps ? Wrap::clamp : Wrap::repeat;
    textures_.emplace(key, static_cast<Index>(scene_.textures.size()));
    scene_.textures.push_back({.name = map.file, .image = std::move(image), .wrap_u = wrap, .wrap_v = wrap});
    return *known(key, map);
}

TextureRef Textures::color(const MtlMap& map, FileFinder& finder)
{
    const std::string place = place_of(map.file, finder);
    const Key key{place.empty() ? map.file : place, "", Use::color, map.clamps};
    if (const std::optional<TextureRef> same = known(key, map))
        return *same;
    Picture& picture = decoded(map.file, finder);
    if (picture.texture != no_index) // a texture with other wrap modes already uses this picture
        return add(key, map, scene_.textures[picture.texture].image);
    if (!picture.image)
        return add(key, map, white);
    picture.texture = static_cast<Index>(scene_.textures.size());
    const TextureRef texture = add(key, map, *std::move(picture.image));
    picture.image.reset();
    return texture;
}

TextureRef Textures::color_with_opacity(const MtlMap& color_map, const MtlMap& opacity_map,
                                        FileFinder& finder)
{
    const bool has_colors = !color_map.file.empty();
    if (picture(opacity_map.file, finder) == nullptr)
        return has_colors ? color(color_map, finder) : TextureRef{};
    const MtlMap& placed = has_colors ? color_map : opacity_map;
    const Key key{has_colors ? place_of(color_map.file, finder) : std::string(),
                  place_of(opacity_map.file, finder), Use::opacity, placed.clamps};
    if (const std::optional<TextureRef> same = known(key, placed))
        return *same;
    const Image* const colors = has_colors ? picture(color_map.file, finder) : &white;
    const Image* const opacity = picture(opacity_map.file, finder);
    return add(key, placed, combined(colors != nullptr ? *colors : white, *opacity, opacity_map.file));
}

TextureRef Textures::normals(const MtlMap& map, FileFinder& finder)
{
    const Image* const image = picture(map.file, finder);
    if (image == nullptr)
        return {};
    const Key key{place_of(map.file, finder), "", Use::normals, map.clamps};
    if (const std::optional<TextureRef> same = known(key, map))
        return *same;
    return add(key, map, holds_normals(*image) ? *image : normals_of_heights(*image, !map.clamps));
}

constexpr uint64_t most_library_bytes = uint64_t{1} << 28;
constexpr size_t most_libraries = 1000;
constexpr size_t most_named = 8; ///< largest number of names in one warning

/// Splits a line into words at blanks. Blanks inside quotes do not split.
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

/// Finds the material libraries that an OBJ file names.
class Libraries {
public:
    Libraries(const std::filesystem::path& file, const ReadScope& scope, Scene& scene)
        : file_(file), scene_(scene), finder_({file.parent_path()}, scope)
    {
    }

    std::vector<std::filesystem::path> find(const std::vector<std::string>& lines)
    {
        for (size_t i = 0; i < std::min(lines.size(), most_libraries); ++i)
            find_line(lines[i]);
        scene_.files.insert(scene_.files.end(), found_.begin(), found_.end());
        return std::move(found_);
    }

private:
    /// Finds the libraries of an `mtllib` line. The line may contain one name with blanks, or several names
    /// that may also contain blanks.
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
    // The statement `d` is used before the statement `Tr`, because programs disagree on whether Tr 1 means
    // clear or opaque.
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
    // Exporters often write black, or no colour, if a texture defines the colour.
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

std::vector<MtlMaterial> parsed(const std::filesystem::path& library, const ReadScope& scope,
                                std::vector<std::string>& warnings)
{
    try {
        Input input(library, scope);
        if (input.size() > most_library_bytes)
            throw Error("is too long for a material library", library.string());
        return parse_mtl(input);
    } catch (const OutsideScope&) {
        throw;
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
                    const std::vector<std::string>& used, const glm::vec3& default_color,
                    const ReadScope& scope, Scene& scene)
{
    const size_t warned = scene.warnings.size();
    const std::vector<std::filesystem::path> found = Libraries(file, scope, scene).find(libraries);
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
        FileFinder finder({library.parent_path(), file.parent_path()}, scope);
        for (const MtlMaterial& source : parsed(library, scope, scene.warnings)) {
            const auto [place, is_new] = place_of_name.try_emplace(source.name, scene.materials.size());
            // If several libraries define a material with the same name, the first definition is used.
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
