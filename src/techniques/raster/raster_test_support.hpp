// SPDX-License-Identifier: MIT
#pragma once

// Shared by the rasteriser's tests: random triangles, drawing them, and checking the page.

#include <algorithm>
#include <bit>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "gpu/resources.hpp"
#include "shaders/scene.glsl.h"
#include "support/gpu_device.hpp"
#include "support/page_raster.hpp"
#include "techniques/raster/raster.hpp"

namespace estampe::raster {

using test::ClipTriangle;
using test::PageHit;

inline constexpr float near_z = 0.1F;

/// clip = (x, y, near, z): no rounding between a vertex and its clip-space position.
inline const glm::mat4 plain_perspective(glm::vec4(1, 0, 0, 0), glm::vec4(0, 1, 0, 0), glm::vec4(0, 0, 0, 1),
                                         glm::vec4(0, 0, near_z, 0));

/// A way to draw, and the tolerance of its edges in 1/256 pixel.
struct Way {
    RasterPath path = RasterPath::compute;
    int64_t slack = 0;
    Tuning tuning = {};
};

inline std::string path_name(const testing::TestParamInfo<RasterPath>& info)
{
    return name_of(info.param);
}

/// Buffers of vertices and triangles on the device.
struct SoupBuffers {
    gpu::Buffer vertices;
    gpu::Buffer triangles;

    [[nodiscard]] RasterInputs inputs(gpu::Graph& graph)
    {
        return unmasked_inputs(graph, gpu::import_whole(graph, "triangles", triangles),
                               gpu::import_whole(graph, "vertices", vertices));
    }
};

inline SoupBuffers upload_soup(const std::vector<ClipTriangle>& soup)
{
    std::vector<shared::PosedVertex> vertices;
    std::vector<glm::uvec4> triangles;
    for (const ClipTriangle& triangle : soup) {
        const auto first = static_cast<uint32_t>(vertices.size());
        for (const glm::vec4& corner : triangle.corner) {
            vertices.push_back({.position = {corner.x, corner.y, corner.w}});
        }
        triangles.emplace_back(first, first + 1, first + 2,
                               (triangle.two_sided ? shared::triangle_two_sided : 0U) |
                                   (triangle.mirrored ? shared::triangle_mirrored : 0U));
    }
    return {.vertices = gpu::upload_buffer(test::shared_device(), "vertices", vertices),
            .triangles = gpu::upload_buffer(test::shared_device(), "triangles", triangles)};
}

/// Includes the clusters' boxes if the tuning culls batches this small by clusters.
inline std::vector<uint64_t> draw(const std::vector<ClipTriangle>& soup, glm::uvec2 size_px, const Way& way,
                                  Batch batch)
{
    SoupBuffers buffers = upload_soup(soup);
    ClusterBoxes boxes;
    gpu::Graph graph;
    const RasterInputs in = buffers.inputs(graph);
    View view{
        .clip_from_anchor = plain_perspective, .size_px = size_px, .path = way.path, .tuning = way.tuning};
    if (way.tuning.clusters_from <= soup.size()) {
        view.cluster_bounds = boxes.add(graph, test::shared_device(), in, static_cast<uint32_t>(soup.size()));
    }
    auto page =
        test::run_and_read_as<uint64_t>(graph, add_visibility(graph, "visibility", in, {&batch, 1}, view));
    page.resize(size_t{size_px.x} * size_px.y);
    return page;
}

inline std::vector<uint64_t> draw_all(const std::vector<ClipTriangle>& soup, glm::uvec2 size_px,
                                      const Way& way = {})
{
    return draw(soup, size_px, way, {.triangle_count = static_cast<uint32_t>(soup.size())});
}

inline float depth_of(uint64_t word)
{
    return std::bit_cast<float>(static_cast<uint32_t>(word >> 32U));
}

/// Whether a pixel shows the right triangle: the nearest, or one as near within rounding and tolerance.
inline bool agrees(uint64_t word, const std::vector<PageHit>& hits)
{
    const auto nearest_sure = std::ranges::find(hits, true, &PageHit::sure);
    if (word == 0) {
        return nearest_sure == hits.end();
    }
    const auto seen = static_cast<uint32_t>(word);
    return std::ranges::any_of(hits, [&](const PageHit& hit) {
        const bool hidden =
            nearest_sure != hits.end() &&
            nearest_sure->depth - hit.depth > std::max(hit.tolerance, nearest_sure->tolerance);
        const bool near_enough = std::abs(hit.depth - static_cast<double>(depth_of(word))) <=
                                 std::max(hit.tolerance, hits.front().tolerance);
        return hit.triangle == seen && !hidden && near_enough;
    });
}

inline void expect_page(const std::vector<uint64_t>& page, const std::vector<std::vector<PageHit>>& expected,
                        const std::string& what)
{
    size_t wrong = 0;
    size_t covered = 0;
    for (size_t i = 0; i < page.size(); ++i) {
        wrong += agrees(page[i], expected[i]) ? 0U : 1U;
        covered += expected[i].empty() ? 0U : 1U;
    }
    EXPECT_EQ(wrong, 0U) << what << ": of " << page.size() << " pixels, " << covered << " covered";
    EXPECT_GT(covered, 0U) << what << " shows nothing at all";
}

class Soup {
public:
    explicit Soup(uint32_t seed) : random_(seed) {}

    float between(float low, float high) { return std::uniform_real_distribution<float>(low, high)(random_); }

    /// A vertex at the page position `ndc` (-1 to 1), with `w` as its clip-space w.
    static glm::vec4 at(glm::vec2 ndc, float w) { return {ndc.x * w, ndc.y * w, near_z, w}; }

    ClipTriangle around(float spread, float size)
    {
        const glm::vec2 centre(between(-spread, spread), between(-spread, spread));
        ClipTriangle triangle{};
        for (glm::vec4& corner : triangle.corner) {
            corner = at(centre + glm::vec2(between(-size, size), between(-size, size)), between(0.2F, 9.0F));
        }
        return with_sides(triangle);
    }

    ClipTriangle sliver()
    {
        const glm::vec2 from(between(-1.2F, 1.2F), between(-1.2F, 1.2F));
        const glm::vec2 to(between(-1.2F, 1.2F), between(-1.2F, 1.2F));
        return with_sides({{at(from, between(0.3F, 4.0F)), at(to, between(0.3F, 4.0F)),
                            at(to + glm::vec2(between(-0.01F, 0.01F)), between(0.3F, 4.0F))}});
    }

    /// A triangle with corners in front of the eye and behind it.
    ClipTriangle through_the_eye()
    {
        ClipTriangle triangle{};
        for (glm::vec4& corner : triangle.corner) {
            corner = {between(-2.0F, 2.0F), between(-2.0F, 2.0F), near_z, between(-2.0F, 2.0F)};
        }
        return with_sides(triangle);
    }

    /// A triangle that surrounds the page, with corners up to 10^`magnitude` page sizes away.
    ClipTriangle endless(float magnitude)
    {
        ClipTriangle triangle{};
        float angle = between(0.0F, 6.28F);
        for (glm::vec4& corner : triangle.corner) {
            const float reach = std::pow(10.0F, between(2.0F, magnitude));
            corner = {std::cos(angle) * reach, std::sin(angle) * reach, near_z, between(0.2F, 0.3F)};
            angle += between(1.7F, 2.4F);
        }
        triangle.two_sided = true;
        return triangle;
    }

private:
    ClipTriangle with_sides(ClipTriangle triangle)
    {
        triangle.two_sided = between(0.0F, 1.0F) < 0.5F;
        triangle.mirrored = between(0.0F, 1.0F) < 0.5F;
        return triangle;
    }

    std::mt19937 random_;
};

template <class Make>
std::vector<ClipTriangle> many(size_t count, Make make)
{
    std::vector<ClipTriangle> soup;
    std::generate_n(std::back_inserter(soup), count, make);
    return soup;
}

inline void expect_soup(const std::vector<ClipTriangle>& soup, glm::uvec2 size_px, const std::string& what,
                        const std::vector<Way>& ways)
{
    for (const Way& way : ways) {
        expect_page(draw_all(soup, size_px, way), test::raster_page(soup, size_px, way.slack),
                    what + " at small_area_px " + std::to_string(way.tuning.small_area_px));
    }
}

} // namespace estampe::raster
