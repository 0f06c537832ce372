// SPDX-License-Identifier: MIT
// Occlusion between discs: the formula summed in double precision, the tree against it, and rays.
#include "techniques/occlusion/discs.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "gpu/imports.hpp"
#include "gpu/upload.hpp"
#include "scene/shapes.hpp"
#include "support/drawing.hpp"
#include "support/embree_scene.hpp"
#include "support/gpu_device.hpp"
#include "support/scenes.hpp"

namespace estampe::occlusion {
namespace {

constexpr float far_m = 1e6F;

/// A ball, a ring and a floor in cells.
Scene finely_cut(uint32_t cells)
{
    Scene scene = test::scene_of(shapes::plane(4.0F, 4.0F, cells));
    test::add_object(scene, shapes::sphere(0.5F, cells + 4, cells / 2 + 2), glm::vec3(1.0F),
                     {0.3, 0.55, 0.0});
    test::add_object(scene, shapes::torus(0.6F, 0.2F, cells + 6, 10), glm::vec3(1.0F), {-1.0, 0.22, 0.5});
    return scene;
}

class Discs {
public:
    explicit Discs(const Scene& scene)
        : drawing(scene, {.eye = {0.0, 2.0, 6.0}, .target = {0.0, 0.0, 0.0}}, {32, 32}),
          list(list_discs(drawing.layout.stroke_coordinates, static_cast<float>(drawing.layout.stroke_unit_m),
                          std::span(drawing.layout.triangles).first(drawing.layout.opaque.count))),
          posed(drawing.posed()),
          buffers(upload_discs(test::shared_device(), list, static_cast<uint32_t>(posed.size())))
    {
    }

    std::vector<float> open(float radius_m, float apart = usual_apart)
    {
        auto vertices = gpu::upload_buffer(test::shared_device(), "posed", posed);
        gpu::Graph graph;
        return test::run_and_read_as<float>(
            graph, add_discs(graph, buffers, gpu::import_whole(graph, "posed", vertices), radius_m, apart));
    }

    /// Each disc by itself.
    [[nodiscard]] double summed(uint32_t vertex, double radius_m) const
    {
        const glm::dvec3 place(posed[vertex].position);
        const glm::dvec3 normal(pose::unpack_normal(posed[vertex].normal));
        double hidden = 0.0;
        for (size_t i = 0; i < list.vertices.size(); ++i) {
            const shared::PosedVertex& emitter = posed[list.vertices[i]];
            const glm::dvec3 way = glm::dvec3(emitter.position) - place;
            const double r = glm::length(way);
            if (r < 1e-6) {
                continue;
            }
            const double cos_e = -glm::dot(glm::dvec3(pose::unpack_normal(emitter.normal)), way) / r;
            const double cos_r = glm::dot(normal, way) / r;
            const auto area = static_cast<double>(list.areas_m2[i]);
            hidden += std::max(1.0 - r * r / (radius_m * radius_m), 0.0) * area * std::max(cos_e, 0.0) *
                      std::max(cos_r, 0.0) / (std::numbers::pi * r * r + area);
        }
        return std::max(1.0 - hidden, 0.0);
    }

    /// Whether every disc that faces this one lies farther off than one and a half of its radius, for which
    /// the formula is meant.
    [[nodiscard]] bool touches_none(uint32_t vertex) const
    {
        const glm::vec3 normal = pose::unpack_normal(posed[vertex].normal);
        for (size_t i = 0; i < list.vertices.size(); ++i) {
            const shared::PosedVertex& emitter = posed[list.vertices[i]];
            const glm::vec3 way = emitter.position - posed[vertex].position;
            const bool is_facing =
                glm::dot(way, normal) > 0.0F && glm::dot(way, pose::unpack_normal(emitter.normal)) < 0.0F;
            const float radius_m = std::sqrt(list.areas_m2[i] / std::numbers::pi_v<float>);
            if (is_facing && glm::length(way) > 1e-6F && glm::length(way) < 1.5F * radius_m) {
                return false;
            }
        }
        return true;
    }

    test::Drawing drawing;
    DiscList list;
    std::vector<shared::PosedVertex> posed;
    DiscBuffers buffers;
};

/// Of the discs that count, or of all.
double rms_off(const std::vector<float>& open, const DiscList& list, const std::vector<double>& wanted,
               const std::vector<bool>& counts = {})
{
    double squares = 0.0;
    int count = 0;
    for (size_t i = 0; i < list.vertices.size(); ++i) {
        const double off = static_cast<double>(open[list.vertices[i]]) - wanted[i];
        if (counts.empty() || counts[i]) {
            squares += off * off;
            ++count;
        }
    }
    return std::sqrt(squares / count);
}

TEST(Discs, HaveAThirdOfTheTrianglesAboutThem)
{
    const Discs discs(test::scene_of(shapes::box({1.0F, 2.0F, 3.0F})));
    double sum = 0.0;
    for (const float area_m2 : discs.list.areas_m2) {
        sum += static_cast<double>(area_m2);
    }
    EXPECT_NEAR(sum, 2.0 * (2.0 + 3.0 + 6.0), 1e-4);
    EXPECT_EQ(discs.list.vertices.size(), 24U) << "four a side, and none of the ground";
}

TEST(Discs, SumTheFormula)
{
    for (const float radius_m : {far_m, 1.0F}) {
        Discs discs(finely_cut(12));
        ASSERT_GT(discs.list.vertices.size(), 400U);
        const std::vector<float> open = discs.open(radius_m, 0.0F);
        double least = 1.0;
        for (const uint32_t vertex : discs.list.vertices) {
            const double wanted = discs.summed(vertex, static_cast<double>(radius_m));
            EXPECT_NEAR(open[vertex], wanted, 1e-4) << vertex;
            least = std::min(least, wanted);
        }
        EXPECT_LT(least, 0.6) << "or there would be nothing to see";
    }
}

TEST(Discs, AreLookedAtManyAtOnceFromAfar)
{
    Discs discs(finely_cut(24));
    const std::vector<float> each = discs.open(far_m, 0.0F);
    std::vector<double> wanted;
    for (const uint32_t vertex : discs.list.vertices) {
        wanted.push_back(static_cast<double>(each[vertex]));
    }
    discs.buffers.is_found = false;
    const double off = rms_off(discs.open(far_m), discs.list, wanted);
    RecordProperty("rms", fmt::format("{:.4f}", off));
    EXPECT_LT(off, 0.02);
    EXPECT_GT(off, 0.0) << "nothing was looked at whole";
}

TEST(Discs, ComeNearWhatRaysTell)
{
    const Scene scene = finely_cut(24);
    const test::EmbreeScene rays(scene);
    Discs discs(scene);
    constexpr double radius_m = 1.0;
    std::vector<double> wanted;
    for (const uint32_t vertex : discs.list.vertices) {
        const glm::dvec3 normal(pose::unpack_normal(discs.posed[vertex].normal));
        const glm::dvec3 helper = std::abs(normal.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
        const glm::dvec3 side = glm::normalize(glm::cross(helper, normal));
        const glm::dvec3 other = glm::cross(normal, side);
        const glm::dvec3 from =
            glm::dvec3(discs.posed[vertex].position) + discs.drawing.layout.anchor + 1e-3 * normal;
        constexpr int count = 256;
        double closed = 0.0;
        for (int i = 0; i < count; ++i) {
            const double radius = std::sqrt((i + 0.5) / count);
            const double angle = i * std::numbers::pi * (3.0 - std::sqrt(5.0));
            const glm::dvec3 direction = radius * std::cos(angle) * side + radius * std::sin(angle) * other +
                                         std::sqrt(1.0 - radius * radius) * normal;
            if (const auto hit = rays.first_hit(from, direction, radius_m)) {
                closed += 1.0 - hit->distance_m * hit->distance_m / (radius_m * radius_m);
            }
        }
        wanted.push_back(1.0 - closed / count);
    }
    std::vector<bool> is_apart;
    for (const uint32_t vertex : discs.list.vertices) {
        is_apart.push_back(discs.touches_none(vertex));
    }
    EXPECT_GT(std::ranges::count(is_apart, true), std::ssize(is_apart) / 2);
    const auto open = discs.open(static_cast<float>(radius_m));
    const double apart = rms_off(open, discs.list, wanted, is_apart);
    const double all = rms_off(open, discs.list, wanted);
    RecordProperty("rms", fmt::format("{:.4f}, of all {:.4f}", apart, all));
    EXPECT_LT(apart, 0.08);
    EXPECT_LT(all, 0.25) << "where bodies touch";
}

TEST(Discs, AreFoundAnewOnlyWhenSomethingMoved)
{
    Discs discs(finely_cut(12));
    const std::vector<float> first = discs.open(1.0F);
    for (shared::PosedVertex& vertex : discs.posed) {
        vertex.position *= 2.0F;
    }
    EXPECT_EQ(discs.open(1.0F), first);
    EXPECT_NE(discs.open(0.5F), first);
    discs.buffers.is_found = false;
    EXPECT_NE(discs.open(1.0F), first);
}

} // namespace
} // namespace estampe::occlusion
