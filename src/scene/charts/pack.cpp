// SPDX-License-Identifier: MIT
#include "scene/charts/charts.hpp"

#include <algorithm>
#include <cmath>

#include <estampe/error.hpp>
#include <fmt/format.h>

#if defined(__GNUC__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wsign-conversion"
#pragma GCC diagnostic ignored "-Wunused-function"
#endif
#define STB_RECT_PACK_IMPLEMENTATION
#define STBRP_STATIC
#include <stb/stb_rect_pack.h>
#if defined(__GNUC__)
#pragma GCC diagnostic pop
#endif

namespace estampe::charts {
namespace {

/// Packs one rectangle per chart at the scale `texels_per_m`. Returns nothing if not all rectangles fit.
std::vector<stbrp_rect> packed(std::span<const Chart> charts, uint32_t size, double texels_per_m)
{
    std::vector<stbrp_rect> rectangles(charts.size());
    for (size_t i = 0; i < charts.size(); ++i) {
        const glm::dvec2 texels = glm::ceil(glm::dvec2(charts[i].size_m) * texels_per_m) + 1.0 + 2.0 * gutter;
        if (std::max(texels.x, texels.y) > size) {
            return {};
        }
        rectangles[i].id = static_cast<int>(i);
        rectangles[i].w = static_cast<stbrp_coord>(texels.x);
        rectangles[i].h = static_cast<stbrp_coord>(texels.y);
    }
    stbrp_context context;
    std::vector<stbrp_node> nodes(size);
    const auto side = static_cast<int>(size);
    stbrp_init_target(&context, side, side, nodes.data(), side);
    // Skips the packing by the library stb if there are no rectangles, because stb would sort a null pointer.
    const bool all_fit = rectangles.empty() || stbrp_pack_rects(&context, rectangles.data(),
                                                                static_cast<int>(rectangles.size())) != 0;
    return all_fit ? rectangles : std::vector<stbrp_rect>();
}

/// Returns the barycentric weights of the second and third corner, for the point of the triangle nearest to
/// the origin.
glm::vec2 nearest_weights(const glm::vec2& a, const glm::vec2& b, const glm::vec2& c, float& distance_2)
{
    const glm::vec2 ab = b - a;
    const glm::vec2 ac = c - a;
    const float area = ab.x * ac.y - ab.y * ac.x;
    if (area != 0.0F) {
        const glm::vec2 inside((ac.x * a.y - ac.y * a.x) / area, (ab.y * a.x - ab.x * a.y) / area);
        if (inside.x >= 0.0F && inside.y >= 0.0F && inside.x + inside.y <= 1.0F) {
            distance_2 = 0.0F;
            return inside;
        }
    }
    glm::vec2 best(0.0F);
    distance_2 = INFINITY;
    const auto try_edge = [&](const glm::vec2& from, const glm::vec2& to, const glm::vec2& from_weights,
                              const glm::vec2& to_weights) {
        const glm::vec2 edge = to - from;
        const float length_2 = glm::dot(edge, edge);
        const float t = length_2 > 0.0F ? std::clamp(-glm::dot(from, edge) / length_2, 0.0F, 1.0F) : 0.0F;
        const glm::vec2 point = from + t * edge;
        if (glm::dot(point, point) < distance_2) {
            distance_2 = glm::dot(point, point);
            best = glm::mix(from_weights, to_weights, t);
        }
    };
    try_edge(a, b, {0, 0}, {1, 0});
    try_edge(b, c, {1, 0}, {0, 1});
    try_edge(c, a, {0, 1}, {0, 0});
    return best;
}

/// The triangle to which a texel is assigned so far, and its squared distance.
struct Claim {
    float distance_2 = INFINITY;
    uint32_t triangle = 0;
    glm::vec2 weights{0.0F};
};

void claim_texels(std::vector<Claim>& claims, const Atlas& atlas, uint32_t triangle)
{
    constexpr float reach = 1.0F; // largest distance in texels between a texel's centre and its triangle
    const glm::vec2* corner = &atlas.corners[3 * static_cast<size_t>(triangle)];
    const glm::vec2 low = glm::min(glm::min(corner[0], corner[1]), corner[2]) - reach;
    const glm::vec2 high = glm::max(glm::max(corner[0], corner[1]), corner[2]) + reach;
    const glm::ivec2 first = glm::max(glm::ivec2(glm::floor(low)), glm::ivec2(0));
    const glm::ivec2 last =
        glm::min(glm::ivec2(glm::floor(high)), glm::ivec2(static_cast<int>(atlas.size)) - 1);
    for (int y = first.y; y <= last.y; ++y) {
        for (int x = first.x; x <= last.x; ++x) {
            const glm::vec2 centre = glm::vec2(x, y) + 0.5F;
            float distance_2 = 0.0F;
            const glm::vec2 weights =
                nearest_weights(corner[0] - centre, corner[1] - centre, corner[2] - centre, distance_2);
            Claim& claim = claims[static_cast<size_t>(y) * atlas.size + static_cast<size_t>(x)];
            if (distance_2 <= reach * reach && distance_2 < claim.distance_2) {
                claim = {distance_2, triangle, weights};
            }
        }
    }
}

} // namespace

Atlas pack_charts(std::span<const Chart> charts, size_t triangle_count, uint32_t size)
{
    double area_m2 = 0.0;
    for (const Chart& chart : charts) {
        area_m2 += static_cast<double>(chart.size_m.x) * chart.size_m.y;
    }
    double too_fine = size / std::sqrt(std::max(area_m2, 1e-30));
    double coarse = too_fine;
    std::vector<stbrp_rect> best = packed(charts, size, coarse);
    constexpr int most_halvings = 30;
    for (int i = 0; best.empty() && i < most_halvings; ++i) {
        too_fine = coarse;
        coarse *= 0.5;
        best = packed(charts, size, coarse);
    }
    if (best.empty()) {
        throw Error(fmt::format("{} charts do not fit into {} x {} texels", charts.size(), size, size),
                    "--size", "take a larger one");
    }
    constexpr int bisections = 6;
    for (int i = 0; i < bisections && too_fine > coarse; ++i) {
        const double middle = std::sqrt(coarse * too_fine);
        std::vector<stbrp_rect> attempt = packed(charts, size, middle);
        (attempt.empty() ? too_fine : coarse) = middle;
        if (!attempt.empty()) {
            best = std::move(attempt);
        }
    }
    Atlas atlas{.size = size,
                .corners = std::vector<glm::vec2>(3 * triangle_count, glm::vec2(0.5F)),
                .texels_per_m = static_cast<float>(coarse)};
    for (const stbrp_rect& rectangle : best) {
        const Chart& chart = charts[static_cast<size_t>(rectangle.id)];
        const glm::vec2 origin = glm::vec2(rectangle.x, rectangle.y) + static_cast<float>(gutter) + 0.5F;
        for (size_t i = 0; i < chart.corners_m.size(); ++i) {
            atlas.corners[3 * static_cast<size_t>(chart.triangles[i / 3]) + i % 3] =
                origin + chart.corners_m[i] * atlas.texels_per_m;
        }
        atlas.triangles.insert(atlas.triangles.end(), chart.triangles.begin(), chart.triangles.end());
    }
    return atlas;
}

std::vector<Texel> covered_texels(const Atlas& atlas)
{
    std::vector<Claim> claims(static_cast<size_t>(atlas.size) * atlas.size);
    for (const uint32_t triangle : atlas.triangles) {
        claim_texels(claims, atlas, triangle);
    }
    std::vector<Texel> texels;
    for (uint32_t place = 0; place < claims.size(); ++place) {
        if (claims[place].distance_2 < INFINITY) {
            texels.push_back({place, claims[place].triangle, claims[place].weights});
        }
    }
    return texels;
}

} // namespace estampe::charts
