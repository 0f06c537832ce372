// SPDX-License-Identifier: MIT
#include "support/page_raster.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <utility>

namespace estampe::test {
namespace {

__extension__ using Wide = __int128;

/// Far beyond any page, so that whole numbers of 64 bits suffice for the renderer.
constexpr float guard_px = 2097152.0F;

struct Corner {
    int64_t x = 0;
    int64_t y = 0;
    double depth = 0.0;
};

Corner snap(const glm::vec4& clip, glm::uvec2 size_px)
{
    const auto along = [](float position, float w, uint32_t size) {
        const float px = (0.5F * position / w + 0.5F) * static_cast<float>(size);
        return static_cast<int64_t>(std::nearbyint(std::clamp(px, -guard_px, guard_px) * 256.0F));
    };
    return {along(clip.x, clip.w, size_px.x), along(clip.y, clip.w, size_px.y),
            static_cast<double>(clip.z) / static_cast<double>(clip.w)};
}

/// The part before the near plane: three or four corners, or none.
std::vector<glm::vec4> before_near(const ClipTriangle& triangle)
{
    std::vector<glm::vec4> result;
    for (int i = 0; i < 3; ++i) {
        glm::vec4 in = triangle.corner[i];
        glm::vec4 out = triangle.corner[(i + 1) % 3];
        if (in.w >= in.z) {
            result.push_back(in);
        }
        if ((in.w >= in.z) != (out.w >= out.z)) {
            if (in.w < in.z) {
                std::swap(in, out);
            }
            const float inside = in.w - in.z;
            const float t = inside / (inside - (out.w - out.z));
            result.push_back(in + t * (out - in));
        }
    }
    return result;
}

Wide edge(const Corner& from, const Corner& to, int64_t x, int64_t y)
{
    return static_cast<Wide>(to.x - from.x) * (y - from.y) - static_cast<Wide>(to.y - from.y) * (x - from.x);
}

/// Whether a pixel centre on the edge belongs to the triangle on its inner side.
bool is_top_or_left(const Corner& from, const Corner& to)
{
    const bool is_top = from.y == to.y && to.x > from.x;
    const bool is_left = to.y < from.y;
    return is_top || is_left;
}

void fill(std::array<Corner, 3> p, uint32_t number, const ClipTriangle& triangle, glm::uvec2 size_px,
          std::vector<std::vector<PageHit>>& page)
{
    const Wide signed_area = edge(p[0], p[1], p[2].x, p[2].y);
    const bool is_front = (signed_area < 0) != triangle.mirrored;
    if (signed_area == 0 || (!is_front && !triangle.two_sided)) {
        return;
    }
    if (signed_area < 0) {
        std::swap(p[1], p[2]);
    }
    const double area = static_cast<double>(signed_area < 0 ? -signed_area : signed_area);
    const double largest = std::max({p[0].depth, p[1].depth, p[2].depth});
    for (uint32_t row = 0; row < size_px.y; ++row) {
        for (uint32_t column = 0; column < size_px.x; ++column) {
            double depth = 0.0;
            bool covered = true;
            for (size_t i = 0; i < 3 && covered; ++i) {
                const Corner& from = p[(i + 1) % 3];
                const Corner& to = p[(i + 2) % 3];
                const Wide value = edge(from, to, int64_t{column} * 256 + 128, int64_t{row} * 256 + 128);
                covered = value > 0 || (value == 0 && is_top_or_left(from, to));
                depth += static_cast<double>(value) / area * p[i].depth;
            }
            if (covered) {
                page[size_t{row} * size_px.x + column].push_back(
                    {number, std::clamp(depth, 1e-30, 1.0), 1e-6 * largest});
            }
        }
    }
}

} // namespace

std::vector<std::vector<PageHit>> raster_page(const std::vector<ClipTriangle>& triangles, glm::uvec2 size_px)
{
    std::vector<std::vector<PageHit>> page(size_t{size_px.x} * size_px.y);
    for (uint32_t number = 0; number < triangles.size(); ++number) {
        const std::vector<glm::vec4> corners = before_near(triangles[number]);
        for (size_t last = 2; last < corners.size(); ++last) {
            fill({snap(corners[0], size_px), snap(corners[last - 1], size_px), snap(corners[last], size_px)},
                 number, triangles[number], size_px, page);
        }
    }
    for (auto& hits : page) {
        std::ranges::stable_sort(hits, std::greater{}, &PageHit::depth);
    }
    return page;
}

} // namespace estampe::test
