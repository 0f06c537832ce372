// SPDX-License-Identifier: MIT
#include "techniques/bake/spread.hpp"

#include <algorithm>
#include <cmath>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "core/luminance.hpp"

namespace estampe::bake {
namespace {

constexpr int filter_reach = 3;
constexpr uint32_t nobody = 0xffffffffU;

/// How much texel `b`, `step` texels away, says about texel `a`.
float agreement(const Estimate& a, const Estimate& b, const glm::ivec2& step)
{
    const float cosine = glm::dot(a.normal, b.normal);
    const glm::vec3 way = b.place - a.place;
    const float off_plane = glm::dot(way, a.normal);
    const float steps_2 = static_cast<float>(glm::dot(glm::vec2(step), glm::vec2(step)));
    if (!b.known || cosine < 0.9F || off_plane * off_plane > 0.02F * glm::dot(way, way)) {
        return 0.0F;
    }
    const float difference = luminance(a.light) - luminance(b.light);
    const float noise_2 = 4.0F * (a.variance + b.variance) + 1e-12F;
    return std::exp(-steps_2 / 6.0F - difference * difference / noise_2);
}

/// A picture whose texels are known one after the other.
class Canvas {
public:
    explicit Canvas(uint32_t side)
        : size(side), light(static_cast<size_t>(side) * side), known(light.size(), false)
    {
    }

    /// Calls `visit` for each of the eight neighbours of a texel.
    template <class Visit>
    void around(uint32_t place, const Visit& visit) const
    {
        const auto x = static_cast<int64_t>(place % size);
        const auto y = static_cast<int64_t>(place / size);
        for (int64_t v = std::max<int64_t>(y - 1, 0); v <= std::min<int64_t>(y + 1, size - 1); ++v) {
            for (int64_t u = std::max<int64_t>(x - 1, 0); u <= std::min<int64_t>(x + 1, size - 1); ++u) {
                const auto other = static_cast<uint32_t>(v * size + u);
                if (other != place) {
                    visit(other);
                }
            }
        }
    }

    uint32_t size;
    std::vector<glm::vec3> light;
    std::vector<bool> known;
};

/// Gives all texels of `wanted` beside known ones the mean of these; returns them.
std::vector<uint32_t> fill_beside(Canvas& canvas, const std::vector<uint32_t>& wanted)
{
    std::vector<uint32_t> filled;
    std::vector<glm::vec3> means;
    for (const uint32_t place : wanted) {
        glm::vec3 sum(0.0F);
        float count = 0.0F;
        canvas.around(place, [&](uint32_t other) {
            if (canvas.known[other]) {
                sum += canvas.light[other];
                count += 1.0F;
            }
        });
        if (count > 0.0F) {
            filled.push_back(place);
            means.push_back(sum / count);
        }
    }
    for (size_t i = 0; i < filled.size(); ++i) {
        canvas.light[filled[i]] = means[i];
        canvas.known[filled[i]] = true;
    }
    return filled;
}

/// Texels beside `texels` that are not known, each once.
std::vector<uint32_t> unknown_beside(const Canvas& canvas, const std::vector<uint32_t>& texels)
{
    std::vector<uint32_t> found;
    for (const uint32_t place : texels) {
        canvas.around(place, [&](uint32_t other) {
            if (!canvas.known[other]) {
                found.push_back(other);
            }
        });
    }
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
    return found;
}

} // namespace

std::vector<glm::vec3> smoothed(std::span<const charts::Texel> texels, std::span<const Estimate> estimates,
                                uint32_t size)
{
    std::vector<uint32_t> texel_at(static_cast<size_t>(size) * size, nobody);
    for (uint32_t i = 0; i < texels.size(); ++i) {
        texel_at[texels[i].place] = i;
    }
    std::vector<glm::vec3> result(texels.size());
    const auto smooth_one = [&](size_t i) {
        const auto x = static_cast<int>(texels[i].place % size);
        const auto y = static_cast<int>(texels[i].place / size);
        glm::vec3 sum = estimates[i].light;
        float weight_sum = 1.0F;
        for (int v = -filter_reach; v <= filter_reach; ++v) {
            for (int u = -filter_reach; u <= filter_reach; ++u) {
                const glm::ivec2 at(x + u, y + v);
                const bool inside = at.x >= 0 && at.y >= 0 && at.x < static_cast<int>(size) &&
                                    at.y < static_cast<int>(size) && (u != 0 || v != 0);
                const uint32_t other =
                    inside ? texel_at[static_cast<size_t>(at.y) * size + static_cast<size_t>(at.x)] : nobody;
                if (other != nobody) {
                    const float weight = agreement(estimates[i], estimates[other], {u, v});
                    sum += weight * estimates[other].light;
                    weight_sum += weight;
                }
            }
        }
        result[i] = sum / weight_sum;
    };
    tbb::parallel_for(tbb::blocked_range<size_t>(0, texels.size(), 1024),
                      [&](const tbb::blocked_range<size_t>& range) {
                          for (size_t i = range.begin(); i != range.end(); ++i) {
                              smooth_one(i);
                          }
                      });
    return result;
}

LightImage spread(std::span<const charts::Texel> texels, std::span<const Estimate> estimates,
                  std::span<const glm::vec3> light, uint32_t size)
{
    Canvas canvas(size);
    std::vector<uint32_t> open;
    for (size_t i = 0; i < texels.size(); ++i) {
        canvas.light[texels[i].place] = estimates[i].known ? light[i] : glm::vec3(0.0F);
        canvas.known[texels[i].place] = estimates[i].known;
        if (!estimates[i].known) {
            open.push_back(texels[i].place);
        }
    }
    for (std::vector<uint32_t> filled(1); !open.empty() && !filled.empty();) {
        filled = fill_beside(canvas, open);
        std::erase_if(open, [&](uint32_t place) { return canvas.known[place]; });
    }
    std::vector<uint32_t> edge;
    for (const charts::Texel& texel : texels) {
        edge.push_back(texel.place);
    }
    for (uint32_t ring = 0; ring < charts::gutter; ++ring) {
        edge = fill_beside(canvas, unknown_beside(canvas, edge));
    }
    return {.width = size, .height = size, .texels = std::move(canvas.light)};
}

} // namespace estampe::bake
