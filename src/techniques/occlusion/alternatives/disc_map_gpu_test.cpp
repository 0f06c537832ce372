// SPDX-License-Identifier: MIT
// Occlusion by discs at the texels of a map. Compares the sum with the formula in double precision, and tests
// when a result is reused and how it appears on the page.
#include "techniques/occlusion/alternatives/discs.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include <estampe/layers.hpp>
#include <estampe/renderer.hpp>
#include <estampe/shapes.hpp>

#include "features/common/surface_map.hpp"
#include "gpu/resources.hpp"
#include "support/drawing.hpp"
#include "support/effect_pictures.hpp"
#include "support/embree_scene.hpp"
#include "support/gpu_device.hpp"
#include "support/scenes.hpp"

namespace estampe::occlusion {
namespace {

/// A ball and a ring over a floor.
Scene ball_and_ring(uint32_t cells)
{
    Scene scene = test::scene_of(shapes::plane(4.0F, 4.0F, cells));
    test::add_object(scene, shapes::sphere(0.5F, cells + 4, cells / 2 + 2), glm::vec3(0.9F, 0.2F, 0.1F),
                     {0.3, 0.55, 0.0});
    test::add_object(scene, shapes::torus(0.6F, 0.2F, cells + 6, 10), glm::vec3(1.0F), {-1.0, 0.22, 0.5});
    return scene;
}

class MappedDiscs {
public:
    explicit MappedDiscs(const Scene& scene, uint32_t size = 64)
        : drawing(scene, {.eye = {0.0, 2.0, 6.0}, .target = {0.0, 0.0, 0.0}}, {32, 32}),
          list(list_discs(drawing.layout.stroke_coordinates, static_cast<float>(drawing.layout.stroke_unit_m),
                          std::span(drawing.layout.triangles).first(drawing.layout.opaque.count))),
          posed(drawing.posed()), data(features::make_surface_map(drawing.layout, size)),
          map(features::upload_surface_map(test::shared_device(), data)), buffers(colored()),
          found(make_disc_map(test::shared_device(), size))
    {
    }

    DiscBuffers colored()
    {
        std::vector<glm::vec3> colors;
        for (const shared::PosedVertex& vertex : posed) {
            colors.push_back(color_at(vertex.position));
        }
        color_discs(list, colors);
        return upload_discs(test::shared_device(), list, static_cast<uint32_t>(posed.size()));
    }

    static glm::vec3 color_at(const glm::vec3& place)
    {
        return place.x < 0.0F ? glm::vec3(0.9F, 0.2F, 0.1F) : glm::vec3(0.1F, 0.3F, 0.8F);
    }

    std::vector<glm::vec4> texels(float radius_m, bool bounces = false)
    {
        auto vertices = gpu::upload_buffer(test::shared_device(), "posed", posed);
        auto triangles = gpu::upload_buffer(test::shared_device(), "triangles", drawing.layout.triangles);
        gpu::Graph graph;
        return test::run_and_read_as<glm::vec4>(
            graph, add_disc_map(graph, buffers, found,
                                {.map_texels = gpu::import_whole(graph, "texels", map.texels),
                                 .triangles = gpu::import_whole(graph, "triangles", triangles),
                                 .posed_vertices = gpu::import_whole(graph, "posed", vertices)},
                                {.radius_m = radius_m, .apart = 0.0F, .bounces = bounces}));
    }

    struct Point {
        glm::dvec3 place;
        glm::dvec3 normal;
    };

    /// The surface point of a texel that lies on a surface.
    [[nodiscard]] Point point_at(size_t texel) const
    {
        const glm::uvec4& words = data.texels[texel];
        const glm::dvec2 weights(std::bit_cast<float>(words.y), std::bit_cast<float>(words.z));
        const glm::uvec4& corners = drawing.layout.triangles[words.x - 1];
        const std::array<double, 3> of_corners{1.0 - weights.x - weights.y, weights.x, weights.y};
        Point point{};
        for (int i = 0; i < 3; ++i) {
            const shared::PosedVertex& vertex = posed[corners[i]];
            const double weight = of_corners.at(static_cast<size_t>(i));
            point.place += weight * glm::dvec3(vertex.position);
            point.normal += weight * glm::dvec3(pose::unpack_normal(vertex.normal));
        }
        point.normal = glm::normalize(point.normal);
        return point;
    }

    /// The sum of occlusion in w, and the sum weighted by the discs' colours in xyz.
    [[nodiscard]] glm::dvec4 hidden_from(const Point& point, double radius_m) const
    {
        glm::dvec4 hidden(0.0);
        for (size_t i = 0; i < list.vertices.size(); ++i) {
            const shared::PosedVertex& emitter = posed[list.vertices[i]];
            const glm::dvec3 way = glm::dvec3(emitter.position) - point.place;
            const double r = glm::length(way);
            if (r < 1e-6) {
                continue;
            }
            const double cos_e = -glm::dot(glm::dvec3(pose::unpack_normal(emitter.normal)), way) / r;
            const double cos_r = glm::dot(point.normal, way) / r;
            const auto area = static_cast<double>(list.areas_m2[i]);
            hidden += glm::dvec4(glm::dvec3(list.colors[i]), 1.0) *
                      std::max(1.0 - r * r / (radius_m * radius_m), 0.0) * area * std::max(cos_e, 0.0) *
                      std::max(cos_r, 0.0) / (std::numbers::pi * r * r + area);
        }
        return hidden;
    }

    /// Whether every disc that faces the point is farther away than 1.5 of its radius, the range of the
    /// formula.
    [[nodiscard]] bool touches_none(const Point& point) const
    {
        for (size_t i = 0; i < list.vertices.size(); ++i) {
            const shared::PosedVertex& emitter = posed[list.vertices[i]];
            const glm::dvec3 way = glm::dvec3(emitter.position) - point.place;
            const bool is_facing = glm::dot(way, point.normal) > 0.0 &&
                                   glm::dot(way, glm::dvec3(pose::unpack_normal(emitter.normal))) < 0.0;
            const double radius_m = std::sqrt(static_cast<double>(list.areas_m2[i]) / std::numbers::pi);
            if (is_facing && glm::length(way) < 1.5 * radius_m) {
                return false;
            }
        }
        return true;
    }

    test::Drawing drawing;
    DiscList list;
    std::vector<shared::PosedVertex> posed;
    features::SurfaceMapData data;
    features::SurfaceMap map;
    DiscBuffers buffers;
    DiscMapBuffers found;
};

TEST(MappedDiscs, SumTheFormulaAtTexels)
{
    for (const float radius_m : {1e6F, 1.0F}) {
        MappedDiscs discs(ball_and_ring(12));
        const std::vector<glm::vec4> found = discs.texels(radius_m, true);
        double worst = 0.0;
        double least = 1.0;
        size_t count = 0;
        for (size_t i = 0; i < found.size(); ++i) {
            if (discs.data.texels[i].x == 0) {
                EXPECT_EQ(found[i], glm::vec4(0.0F, 0.0F, 0.0F, -1.0F));
                continue;
            }
            const glm::dvec4 hidden = discs.hidden_from(discs.point_at(i), static_cast<double>(radius_m));
            const double open = std::max(1.0 - hidden.w, 0.0);
            const glm::dvec3 bounced = glm::dvec3(hidden) / std::max(hidden.w, 1.0);
            worst = std::max(worst, std::abs(static_cast<double>(found[i].w) - open));
            for (int channel = 0; channel < 3; ++channel) {
                worst = std::max(worst, std::abs(static_cast<double>(found[i][channel]) - bounced[channel]));
            }
            least = std::min(least, open);
            ++count;
        }
        RecordProperty(fmt::format("worst_at_{}_m", radius_m), fmt::format("{:.2e}", worst));
        EXPECT_LT(worst, 1e-4) << radius_m;
        EXPECT_LT(least, 0.6) << "or there would be nothing to see";
        EXPECT_GT(count, 1500U);
    }
}

TEST(MappedDiscs, AreKeptUntilSomethingMoves)
{
    MappedDiscs discs(ball_and_ring(12));
    const std::vector<glm::vec4> first = discs.texels(1.0F);
    for (shared::PosedVertex& vertex : discs.posed) {
        vertex.position *= 2.0F;
    }
    EXPECT_EQ(discs.texels(1.0F), first);
    EXPECT_NE(discs.texels(0.5F), first);
    const std::vector<glm::vec4> colored = discs.texels(0.5F, true);
    EXPECT_GT(std::ranges::max(colored, {}, &glm::vec4::x).x, 0.01F) << "colours were not asked for before";
    discs.found.is_found = false;
    EXPECT_NE(discs.texels(1.0F), first);
}

TEST(MappedDiscs, ComeNearWhatRaysTell)
{
    const Scene scene = ball_and_ring(24);
    const test::EmbreeScene rays(scene);
    MappedDiscs discs(scene);
    constexpr double radius_m = 1.0;
    const std::vector<glm::vec4> found = discs.texels(static_cast<float>(radius_m));
    double squares = 0.0;
    double squares_apart = 0.0;
    int counted = 0;
    int counted_apart = 0;
    for (size_t i = 0; i < found.size(); ++i) {
        if (found[i].w < 0.0F) {
            continue;
        }
        const MappedDiscs::Point point = discs.point_at(i);
        const glm::dvec3 helper = std::abs(point.normal.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
        const glm::dvec3 side = glm::normalize(glm::cross(helper, point.normal));
        const glm::dvec3 other = glm::cross(point.normal, side);
        constexpr int count = 128;
        double closed = 0.0;
        for (int ray = 0; ray < count; ++ray) {
            const double radius = std::sqrt((ray + 0.5) / count);
            const double angle = ray * std::numbers::pi * (3.0 - std::sqrt(5.0));
            const glm::dvec3 direction = radius * std::cos(angle) * side + radius * std::sin(angle) * other +
                                         std::sqrt(1.0 - radius * radius) * point.normal;
            const glm::dvec3 from = point.place + discs.drawing.layout.anchor + 1e-3 * point.normal;
            if (const auto hit = rays.first_hit(from, direction, radius_m)) {
                closed += 1.0 - hit->distance_m * hit->distance_m / (radius_m * radius_m);
            }
        }
        const double off = static_cast<double>(found[i].w) - (1.0 - closed / count);
        const bool is_apart = discs.touches_none(point);
        squares += off * off;
        squares_apart += is_apart ? off * off : 0.0;
        ++counted;
        counted_apart += is_apart ? 1 : 0;
    }
    const double all = std::sqrt(squares / counted);
    const double apart = std::sqrt(squares_apart / counted_apart);
    RecordProperty("rms", fmt::format("{:.4f}, of all {:.4f}", apart, all));
    EXPECT_GT(counted_apart, counted / 2);
    EXPECT_LT(apart, 0.08);
    EXPECT_LT(all, 0.25) << "where bodies touch";
}

/// The occlusion mask of a still life, by one method.
std::vector<float> mask_by(const char* method, uint32_t texels = 512)
{
    const Style style = test::effect_style(
        {"occlusion.enabled=true", "occlusion.feeds=layer", "occlusion.radius_m=1"},
        {fmt::format("occlusion.method={}", method), fmt::format("occlusion.texels={}", texels)});
    const LayeredImage image = test::shared_renderer().render_layers(
        {.eye = {0.0, 2.0, 5.0}, .target = {0.0, 0.3, 0.0}, .vertical_fov_rad = 0.6}, style,
        {.width = 120, .height = 90});
    const auto mask = std::ranges::find(image.masks, std::string("occlusion"), &PictureMask::name);
    return mask == image.masks.end() ? std::vector<float>() : mask->cover;
}

double rms_between(const std::vector<float>& a, const std::vector<float>& b)
{
    double squares = 0.0;
    for (size_t i = 0; i < a.size(); ++i) {
        squares += std::pow(static_cast<double>(a[i] - b[i]), 2);
    }
    return std::sqrt(squares / static_cast<double>(a.size()));
}

TEST(MappedDiscs, ShowOnThePageWhatPixelsFindThemselves)
{
    test::shared_renderer().set_scene(ball_and_ring(24));
    const std::vector<float> pixels = mask_by("splats");
    const std::vector<float> fine = mask_by("uv");
    ASSERT_EQ(fine.size(), pixels.size());
    EXPECT_GT(std::ranges::max(pixels), 0.3F);
    const double off = rms_between(fine, pixels);
    const double off_coarse = rms_between(mask_by("uv", 64), pixels);
    RecordProperty("rms", fmt::format("{:.4f}, of 64 texels {:.4f}", off, off_coarse));
    EXPECT_LT(off, 0.01);
    EXPECT_LT(off, off_coarse);
}

TEST(MappedDiscs, SayWhoseCoordinatesDoNotServe)
{
    Renderer& renderer = test::shared_renderer();
    Scene scene = ball_and_ring(12);
    scene.meshes.front().primitives.front().uvs[0].clear();
    renderer.set_scene(scene);
    EXPECT_FALSE(mask_by("uv", 128).empty());
    const auto speaks_of_charts = [&] {
        return std::ranges::any_of(renderer.notes(), [](const std::string& note) {
            return note.find("charts") != std::string::npos;
        });
    };
    EXPECT_TRUE(speaks_of_charts());
    EXPECT_FALSE(mask_by("discs").empty());
    EXPECT_FALSE(speaks_of_charts());
}

TEST(MappedDiscs, FollowWhatMovedWhileNobodyLooked)
{
    // A ball leaves the floor while another method is in use.
    Renderer& renderer = test::shared_renderer();
    const auto place_ball = [&](double height_m) {
        const NodePlace place{.node = 1, .transform = {.translation = {0.3, height_m, 0.0}}};
        renderer.place(std::span(&place, 1), 0.0);
    };
    for (const char* method : {"discs", "uv"}) {
        renderer.set_scene(ball_and_ring(12));
        place_ball(0.55);
        const std::vector<float> before = mask_by(method, 128);
        place_ball(1.6);
        (void)mask_by("unsharp");
        const std::vector<float> after = mask_by(method, 128);
        EXPECT_GT(rms_between(after, before), 0.02) << method;
        renderer.set_scene(ball_and_ring(12));
        place_ball(1.6);
        EXPECT_EQ(mask_by(method, 128), after) << method;
    }
}

} // namespace
} // namespace estampe::occlusion
