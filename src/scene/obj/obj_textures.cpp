// SPDX-License-Identifier: MIT
#include "scene/obj/obj_textures.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include <estampe/error.hpp>

#include "core/free_memory.hpp"

namespace estampe::obj {
namespace {

/// How far a step of height from black to white between neighbouring texels tilts the surface.
constexpr float slope_of_height = 2.0F;

float brightness(const uint8_t* pixel)
{
    return (0.2126F * static_cast<float>(pixel[0]) + 0.7152F * static_cast<float>(pixel[1]) +
            0.0722F * static_cast<float>(pixel[2])) /
           255.0F;
}

/// Whether the picture holds normals: these point out of the surface for the most part, which is blue.
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

/// Normals of a surface whose height is the picture's brightness; green points up in the picture, as glTF
/// has it.
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

/// `colors` with the opacity of `opacity`, at the size of the larger one.
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

/// uv' = scale * uv + offset in the file's coordinates, whose v runs up where a texture's runs down.
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

} // namespace

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
            known->second.image = load_image(place);
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
    if (picture.texture != no_index) // shown already, with other edges
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

} // namespace estampe::obj
