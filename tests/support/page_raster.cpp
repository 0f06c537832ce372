// SPDX-License-Identifier: MIT
#include "support/page_raster.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <optional>
#include <utility>

namespace estampe::test {
namespace {

__extension__ using Wide = __int128;

/// Far beyond any page. Within this limit, 64-bit integers suffice for the renderer.
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

/// The polygon in front of the near plane: three or four corners, or none.
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

/// A triangle on the page, in an order that makes its area positive.
struct Placed {
    std::array<Corner, 3> p;
    double area = 0.0;
    double slope = 0.0; ///< change of depth over one pixel, to the right and down together
};

Placed place(std::array<Corner, 3> p, Wide signed_area)
{
    if (signed_area < 0) {
        std::swap(p[1], p[2]);
    }
    const double area = static_cast<double>(signed_area < 0 ? -signed_area : signed_area);
    double right = 0.0;
    double down = 0.0;
    for (size_t i = 0; i < 3; ++i) {
        const Corner& from = p[(i + 1) % 3];
        const Corner& to = p[(i + 2) % 3];
        right -= 256.0 * static_cast<double>(to.y - from.y) / area * p[i].depth;
        down += 256.0 * static_cast<double>(to.x - from.x) / area * p[i].depth;
    }
    return {p, area, std::abs(right) + std::abs(down)};
}

/// The hit of a triangle at a pixel's centre; none if there is no hit even with slack.
std::optional<PageHit> meet(const Placed& t, int64_t x, int64_t y, int64_t slack)
{
    PageHit hit;
    for (size_t i = 0; i < 3; ++i) {
        const Corner& from = t.p[(i + 1) % 3];
        const Corner& to = t.p[(i + 2) % 3];
        const Wide value = edge(from, to, x, y);
        const Wide leeway = static_cast<Wide>(slack) * (std::abs(to.x - from.x) + std::abs(to.y - from.y));
        const bool covered =
            slack > 0 ? value >= -leeway : value > 0 || (value == 0 && is_top_or_left(from, to));
        if (!covered) {
            return std::nullopt;
        }
        hit.sure = hit.sure && value >= leeway;
        hit.depth += static_cast<double>(value) / t.area * t.p[i].depth;
    }
    hit.depth = std::clamp(hit.depth, 1e-30, 1.0);
    return hit;
}

void fill(const std::array<Corner, 3>& p, uint32_t number, const ClipTriangle& triangle, glm::uvec2 size_px,
          int64_t slack, std::vector<std::vector<PageHit>>& page)
{
    const Wide signed_area = edge(p[0], p[1], p[2].x, p[2].y);
    const bool is_front = (signed_area < 0) != triangle.mirrored;
    if (signed_area == 0 || (!is_front && !triangle.two_sided)) {
        return;
    }
    const Placed placed = place(p, signed_area);
    const double tolerance = 1e-6 * std::max({p[0].depth, p[1].depth, p[2].depth}) +
                             placed.slope * static_cast<double>(slack) / 256.0;
    for (uint32_t row = 0; row < size_px.y; ++row) {
        for (uint32_t column = 0; column < size_px.x; ++column) {
            auto hit = meet(placed, int64_t{column} * 256 + 128, int64_t{row} * 256 + 128, slack);
            if (hit) {
                hit->triangle = number;
                hit->tolerance = tolerance;
                page[size_t{row} * size_px.x + column].push_back(*hit);
            }
        }
    }
}

} // namespace

std::vector<std::vector<PageHit>> raster_page(const std::vector<ClipTriangle>& triangles, glm::uvec2 size_px,
                                              int64_t slack)
{
    std::vector<std::vector<PageHit>> page(size_t{size_px.x} * size_px.y);
    for (uint32_t number = 0; number < triangles.size(); ++number) {
        const std::vector<glm::vec4> corners = before_near(triangles[number]);
        for (size_t last = 2; last < corners.size(); ++last) {
            fill({snap(corners[0], size_px), snap(corners[last - 1], size_px), snap(corners[last], size_px)},
                 number, triangles[number], size_px, slack, page);
        }
    }
    for (auto& hits : page) {
        std::ranges::stable_sort(hits, std::greater{}, &PageHit::depth);
    }
    return page;
}

} // namespace estampe::test
