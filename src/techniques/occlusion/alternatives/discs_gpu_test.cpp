// SPDX-License-Identifier: MIT
// Occlusion between discs: the tree against the formula summed in double precision, and against rays.
#include "techniques/occlusion/alternatives/discs.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include <gtest/gtest.h>

#include <estampe/shapes.hpp>

#include "gpu/resources.hpp"
#include "support/drawing.hpp"
#include "support/embree_scene.hpp"
#include "support/gpu_device.hpp"
#include "support/layers.hpp"
#include "support/scenes.hpp"

namespace estampe::occlusion {
namespace {

constexpr float far_m = 1e6F;

/// A ball, a ring and a floor, divided into cells.
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
    /// Discs get the colours of `by_place`, if given.
    explicit Discs(const Scene& scene, const std::function<glm::vec3(const glm::vec3&)>& by_place = nullptr)
        : drawing(scene, {.eye = {0.0, 2.0, 6.0}, .target = {0.0, 0.0, 0.0}}, {32, 32}),
          list(list_discs(drawing.layout.stroke_coordinates, static_cast<float>(drawing.layout.stroke_unit_m),
                          std::span(drawing.layout.triangles).first(drawing.layout.opaque.count))),
          posed(drawing.posed()), buffers(colored(by_place))
    {
    }

    DiscBuffers colored(const std::function<glm::vec3(const glm::vec3&)>& by_place)
    {
        if (by_place) {
            std::vector<glm::vec3> colors;
            for (const shared::PosedVertex& vertex : posed) {
                colors.push_back(by_place(vertex.position));
            }
            color_discs(list, colors);
        }
        return upload_discs(test::shared_device(), list, static_cast<uint32_t>(posed.size()));
    }

    std::vector<float> open(float radius_m, float apart = usual_apart)
    {
        auto vertices = gpu::upload_buffer(test::shared_device(), "posed", posed);
        gpu::Graph graph;
        return test::run_and_read_as<float>(graph, add_discs(graph, buffers,
                                                             gpu::import_whole(graph, "posed", vertices),
                                                             {.radius_m = radius_m, .apart = apart})
                                                       .visibility);
    }

    std::vector<glm::vec4> bounced(float radius_m)
    {
        auto vertices = gpu::upload_buffer(test::shared_device(), "posed", posed);
        gpu::Graph graph;
        const VertexOcclusion found = add_discs(graph, buffers, gpu::import_whole(graph, "posed", vertices),
                                                {.radius_m = radius_m, .apart = 0.0F, .bounces = true});
        return test::run_and_read_as<glm::vec4>(graph, found.bounced.value());
    }

    /// Visibility per pixel.
    std::vector<float> splats(const test::SurfacePixels& seen, float radius_m)
    {
        const auto at = [&](glm::uvec2 p) { return size_t{p.y} * 32 + p.x; };
        auto depth = test::Layer::depth({32, 32}, [&](glm::uvec2 p) { return seen.depth[at(p)]; });
        auto normal = test::Layer::normals({32, 32}, [&](glm::uvec2 p) {
            return seen.depth[at(p)] > 0.0F ? seen.smooth_normal[at(p)] : glm::vec3(0.0F, 1.0F, 0.0F);
        });
        auto frame = gpu::upload_buffer(test::shared_device(), "frame", std::vector{drawing.globals});
        auto vertices = gpu::upload_buffer(test::shared_device(), "posed", posed);
        gpu::Graph graph;
        const AmbientOcclusion page =
            add_disc_splats(graph, buffers, gpu::import_whole(graph, "posed", vertices),
                            {.frame = gpu::import_whole(graph, "frame", frame),
                             .depth = depth.in(graph),
                             .normal = normal.in(graph),
                             .radius_m = radius_m,
                             .size_px = {32, 32}},
                            {}, 0.0F);
        return test::run_and_read_coverage(graph, page.visibility);
    }

    /// Sum of occlusion over single discs, without the tree.
    [[nodiscard]] double summed(uint32_t vertex, double radius_m) const
    {
        const double hidden = hidden_from(glm::dvec3(posed[vertex].position),
                                          glm::dvec3(pose::unpack_normal(posed[vertex].normal)), radius_m)
                                  .w;
        return std::max(1.0 - hidden, 0.0);
    }

    /// The sum of occlusion in w, and the sum weighted by the discs' colours in xyz.
    [[nodiscard]] glm::dvec4 hidden_from(const glm::dvec3& place, const glm::dvec3& normal,
                                         double radius_m) const
    {
        glm::dvec4 hidden(0.0);
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
            const glm::dvec3 color = list.colors.empty() ? glm::dvec3(0.0) : glm::dvec3(list.colors[i]);
            hidden += glm::dvec4(color, 1.0) * std::max(1.0 - r * r / (radius_m * radius_m), 0.0) * area *
                      std::max(cos_e, 0.0) * std::max(cos_r, 0.0) / (std::numbers::pi * r * r + area);
        }
        return hidden;
    }

    /// Whether every disc that faces this vertex is farther away than 1.5 of its radius, the range of the
    /// formula.
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

/// Root mean square error over the discs in the formula's range, or over all.
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

glm::vec3 striped(const glm::vec3& place)
{
    return place.x < 0.0F ? glm::vec3(0.9F, 0.2F, 0.1F) : glm::vec3(0.1F, 0.3F, 0.8F);
}

TEST(Discs, BounceLightInTheirColors)
{
    Discs discs(finely_cut(12), striped);
    const std::vector<glm::vec4> bounced = discs.bounced(1.0F);
    double reddest = 0.0;
    for (const uint32_t vertex : discs.list.vertices) {
        const glm::dvec4 hidden =
            discs.hidden_from(glm::dvec3(discs.posed[vertex].position),
                              glm::dvec3(pose::unpack_normal(discs.posed[vertex].normal)), 1.0);
        const glm::dvec3 wanted = glm::dvec3(hidden) / std::max(hidden.w, 1.0);
        for (int channel = 0; channel < 3; ++channel) {
            EXPECT_NEAR(bounced[vertex][channel], wanted[channel], 2e-4) << vertex;
        }
        reddest = std::max(reddest, wanted.x - wanted.z);
    }
    EXPECT_GT(reddest, 0.1) << "or there would be nothing to see";
}

TEST(Discs, OfNodesHaveTheMeanColorOfWhatLiesBelow)
{
    const Discs discs(finely_cut(12), striped);
    const std::vector<glm::vec4>& colors = discs.list.colors;
    ASSERT_GT(colors.size(), discs.list.vertices.size());
    const glm::dvec3 first_eight = [&] {
        glm::dvec3 mean(0.0);
        double area = 0.0;
        for (size_t i = 0; i < 8; ++i) {
            mean += static_cast<double>(discs.list.areas_m2[i]) * glm::dvec3(colors[i]);
            area += static_cast<double>(discs.list.areas_m2[i]);
        }
        return mean / area;
    }();
    EXPECT_LT(glm::distance(glm::dvec3(colors[discs.list.vertices.size()]), first_eight), 1e-6);
}

TEST(Discs, AreSummedAtPixelsToo)
{
    Discs discs(finely_cut(12));
    const test::SurfacePixels seen = discs.drawing.surface();
    const std::vector<float> open = discs.splats(seen, 1.0F);
    double least = 1.0;
    for (size_t i = 0; i < open.size(); ++i) {
        if (seen.depth[i] <= 0.0F) {
            continue;
        }
        const glm::dvec3 place = discs.drawing.point_seen(i, seen.depth[i]);
        const double wanted =
            std::max(1.0 - discs.hidden_from(place, glm::dvec3(seen.smooth_normal[i]), 1.0).w, 0.0);
        EXPECT_NEAR(open[i], wanted, 2e-3) << i; // rounding of half floats and 16-bit normals
        least = std::min(least, wanted);
    }
    EXPECT_LT(least, 0.6) << "or there would be nothing to see";
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
