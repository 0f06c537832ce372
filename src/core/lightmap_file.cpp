// SPDX-License-Identifier: MIT
#include "core/lightmap_file.hpp"

#include <cmath>

#include <estampe/error.hpp>

#include "core/exr.hpp"
#include "core/file.hpp"

namespace estampe {
namespace {

constexpr const char* geometry_key = "estampe:geometry";
constexpr const char* settings_key = "estampe:settings";
constexpr float most_kinds = baked_directional | baked_point | baked_spot;
constexpr const char* corners_key = "estampe:corners";
constexpr const char* numbers_key = "estampe:exposure and kinds of lights";

template <class Map>
typename Map::mapped_type taken(Map& attributes, const char* key, const std::filesystem::path& path)
{
    const auto found = attributes.find(key);
    if (found == attributes.end()) {
        throw Error("is an OpenEXR picture, but not a lightmap", path.string(),
                    "estampe bake makes one; a program that writes it anew must keep its header");
    }
    return std::move(found->second);
}

bool is_place(float x)
{
    return x >= 0.0F && x <= 1.0F;
}

} // namespace

void save_lightmap(const Lightmap& map, const std::filesystem::path& path)
{
    if (!map.pictures.empty()) {
        throw Error("is made of pictures that its scene names; only baked lightmaps are saved",
                    path.string());
    }
    ExrFile file{.image = map.light};
    file.texts[geometry_key] = map.geometry;
    file.texts[settings_key] = map.settings;
    file.numbers[numbers_key] = {map.exposure, static_cast<float>(map.baked_lights)};
    std::vector<float>& corners = file.numbers[corners_key];
    corners.reserve(2 * map.corners.size());
    for (const glm::vec2& corner : map.corners) {
        corners.push_back(corner.x);
        corners.push_back(corner.y);
    }
    write_file_atomically(path, encode_exr(file));
}

bool is_baked(const ExrFile& file)
{
    return file.texts.contains(geometry_key);
}

Lightmap baked_lightmap(ExrFile file, const std::filesystem::path& path)
{
    Lightmap map;
    map.geometry = taken(file.texts, geometry_key, path);
    map.settings = taken(file.texts, settings_key, path);
    const std::vector<float> numbers = taken(file.numbers, numbers_key, path);
    const std::vector<float> corners = taken(file.numbers, corners_key, path);
    map.light = std::move(file.image);
    if (numbers.size() != 2 || !std::isfinite(numbers[0]) || numbers[0] <= 0.0F || !(numbers[1] >= 0.0F) ||
        numbers[1] > most_kinds || corners.size() % 6 != 0) {
        throw Error("is a damaged lightmap", path.string(), "bake it again");
    }
    map.exposure = numbers[0];
    map.baked_lights = static_cast<uint32_t>(numbers[1]);
    for (size_t i = 0; i < corners.size(); i += 2) {
        if (!is_place(corners[i]) || !is_place(corners[i + 1])) {
            throw Error("is a damaged lightmap", path.string(), "bake it again");
        }
        map.corners.emplace_back(corners[i], corners[i + 1]);
    }
    return map;
}

Lightmap load_lightmap(const std::filesystem::path& path)
{
    constexpr uint64_t max_file_bytes = uint64_t{1} << 32;
    return baked_lightmap(decode_exr(read_file(path, max_file_bytes), path.string()), path);
}

} // namespace estampe
