// SPDX-License-Identifier: MIT
#include <estampe/normal_map.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>

#include <fmt/format.h>
#include <glm/glm.hpp>

#include <estampe/error.hpp>

#include "core/child/child.hpp"
#include "core/file.hpp"
#include "core/image_codec.hpp"

namespace estampe {
namespace {

/// Reads heights as the luminance of an image with four channels per texel. The value `most` is white.
template <typename Channel>
HeightMap heights_of(uint32_t width, uint32_t height, std::span<const Channel> rgba, uint32_t most)
{
    HeightMap map{.width = width, .height = height, .heights = {}, .steps = most};
    map.heights.reserve(rgba.size() / 4);
    for (size_t i = 0; i + 3 < rgba.size(); i += 4) {
        const double sum = 0.2126 * rgba[i] + 0.7152 * rgba[i + 1] + 0.0722 * rgba[i + 2];
        map.heights.push_back(static_cast<float>(sum / most));
    }
    return map;
}

/// Reads heights, also beyond the picture's edges: from the opposite edge, or from the nearest texel.
class Heights {
public:
    Heights(const HeightMap& map, bool wraps) : map_(map), wraps_(wraps) {}

    [[nodiscard]] double at(int64_t x, int64_t y) const
    {
        return static_cast<double>(map_.heights[inside(y, map_.height) * map_.width + inside(x, map_.width)]);
    }

    /// Change of height per texel, to the right and downwards.
    [[nodiscard]] glm::dvec2 slope(int64_t x, int64_t y) const
    {
        // Scharr's weights for slopes; the weights on one side have the sum 1/2.
        constexpr double side = 3.0 / 32.0;
        constexpr double middle = 10.0 / 32.0;
        const auto across = [&](int64_t row) { return at(x + 1, row) - at(x - 1, row); };
        const auto down = [&](int64_t column) { return at(column, y + 1) - at(column, y - 1); };
        return {side * (across(y - 1) + across(y + 1)) + middle * across(y),
                side * (down(x - 1) + down(x + 1)) + middle * down(x)};
    }

private:
    [[nodiscard]] size_t inside(int64_t at, uint32_t size) const
    {
        const auto count = static_cast<int64_t>(size);
        return static_cast<size_t>(wraps_ ? (at + count) % count : std::clamp<int64_t>(at, 0, count - 1));
    }

    const HeightMap& map_;
    bool wraps_;
};

uint8_t byte_of(double component)
{
    return static_cast<uint8_t>(std::lround(127.5 * (component + 1.0)));
}

HeightMap decode_height_map(const std::filesystem::path& path, const ReadScope& scope)
{
    const std::vector<std::byte> bytes = read_file(path, any_length, scope);
    if (const std::optional<DeepImage> deep = decode_deep_image(bytes, path.string())) {
        return heights_of<uint16_t>(deep->width, deep->height, deep->rgba, 65535);
    }
    const Image image = decode_image(bytes, path.string());
    return heights_of<uint8_t>(image.width, image.height, image.rgba, 255);
}

} // namespace

template <Either<HeightMap> T>
auto members(T& map)
{
    auto& [width, height, heights, steps] = map;
    return std::tie(width, height, heights, steps);
}

HeightMap load_height_map(const std::filesystem::path& path, const ReadScope& scope)
{
    HeightMap map = run_in_child([&] { return decode_height_map(path, scope); }, limits_for_file(path, scope),
                                 path.string());
    if (map.heights.empty() || map.heights.size() != uint64_t{map.width} * map.height) {
        throw Error("what was read from it came back damaged", path.string());
    }
    return map;
}

Image make_normal_map(const HeightMap& map, const NormalMapSettings& settings)
{
    if (map.heights.empty() || map.heights.size() != size_t{map.width} * map.height) {
        throw Error("a height map needs one height per texel", {},
                    fmt::format("it has {} for {} x {}", map.heights.size(), map.width, map.height));
    }
    if (!(settings.relief >= 0.0 && settings.relief <= most_relief)) {
        throw Error(fmt::format("the relief {} is out of range", settings.relief), {},
                    fmt::format("allowed: 0 to {}", most_relief));
    }
    const Heights heights(map, settings.wraps);
    const double relief_texels = settings.relief * map.width;
    const double green = settings.is_green_down ? -1.0 : 1.0;
    Image normals{.width = map.width, .height = map.height, .rgba = {}};
    normals.rgba.reserve(4 * map.heights.size());
    for (uint32_t y = 0; y < map.height; ++y) {
        for (uint32_t x = 0; x < map.width; ++x) {
            const glm::dvec2 slope = relief_texels * heights.slope(x, y);
            // Image rows go down, but y of the normal goes up. So a surface that rises towards the bottom of
            // the image has a normal that leans upwards.
            const glm::dvec3 normal = glm::normalize(glm::dvec3(-slope.x, green * slope.y, 1.0));
            normals.rgba.insert(normals.rgba.end(),
                                {byte_of(normal.x), byte_of(normal.y), byte_of(normal.z), 255});
        }
    }
    return normals;
}

double height_step_texels(const HeightMap& map, const NormalMapSettings& settings)
{
    return settings.relief * map.width / std::max(map.steps, 1U);
}

} // namespace estampe
