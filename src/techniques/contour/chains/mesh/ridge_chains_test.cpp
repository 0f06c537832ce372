// SPDX-License-Identifier: MIT
// Curvature, ridges and valleys, compared with surfaces of known curvature.
#include "techniques/contour/chains/mesh/feature_chains.hpp"

#include <cmath>
#include <functional>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include <estampe/shapes.hpp>

#include "scene/smooth_surface.hpp"

namespace estampe::contour {
namespace {

constexpr float pi = std::numbers::pi_v<float>;

/// A RestSurface that owns its data.
class Surface {
public:
    Surface(const Primitive& primitive, float size) : positions_(primitive.positions)
    {
        std::vector<glm::uvec4> triangles;
        for (size_t i = 0; i + 2 < primitive.indices.size(); i += 3) {
            triangles.emplace_back(primitive.indices[i], primitive.indices[i + 1], primitive.indices[i + 2],
                                   0U);
        }
        const std::vector<uint32_t> zeros(triangles.size(), 0);
        mesh_ = build_edge_mesh({triangles, positions_, positions_, primitive.normals, zeros, zeros, {}});
        sizes_.assign(positions_.size(), size);
        clockwise_.assign(triangles.size(), 0);
    }

    [[nodiscard]] RestSurface rest() const { return {mesh_, positions_, sizes_, clockwise_}; }

    [[nodiscard]] FeatureChains ridges(const RidgeChoice& choice) const
    {
        FeatureChains features;
        add_ridges(rest(), find_bending(rest()), choice, features);
        return features;
    }

    [[nodiscard]] glm::vec3 place(const shared::FeaturePoint& point) const
    {
        return glm::mix(positions_[point.vertex], positions_[point.other_vertex], point.share);
    }

    [[nodiscard]] const std::vector<glm::vec3>& positions() const { return positions_; }

    void turn_around() { clockwise_.assign(clockwise_.size(), 1); }

private:
    std::vector<glm::vec3> positions_;
    EdgeMesh mesh_;
    std::vector<float> sizes_;
    std::vector<uint8_t> clockwise_;
};

/// A grid of `side` x `side` vertices over [-1, 1], with random diagonals.
Primitive sheet(uint32_t side, const std::function<float(float, float)>& height, float noise = 0.0F)
{
    Primitive primitive;
    std::mt19937 random(5);
    const auto share = [&] { return static_cast<float>(random() % 1000) / 1000.0F - 0.5F; };
    for (uint32_t i = 0; i < side * side; ++i) {
        const float step = 2.0F / static_cast<float>(side - 1);
        const uint32_t column = i % side;
        const uint32_t row = i / side;
        const float x = static_cast<float>(column) * step - 1.0F + noise * step * share();
        const float y = static_cast<float>(row) * step - 1.0F + noise * step * share();
        primitive.positions.emplace_back(x, y, height(x, y));
        primitive.normals.emplace_back(0.0F, 0.0F, 1.0F);
    }
    for (uint32_t i = 0; i + side < side * side; ++i) {
        if (i % side + 1 < side) {
            const uint32_t a = i;
            const uint32_t b = i + 1;
            const uint32_t c = i + side + 1;
            const uint32_t d = i + side;
            const auto quad = random() % 2 == 0 ? std::vector<uint32_t>{a, b, c, a, c, d}
                                                : std::vector<uint32_t>{a, b, d, b, c, d};
            primitive.indices.insert(primitive.indices.end(), quad.begin(), quad.end());
        }
    }
    return primitive;
}

TEST(Bending, IsThatOfATorus)
{
    constexpr float big = 1.0F;
    constexpr float small = 0.4F;
    const Surface torus(subdivided(shapes::torus(big, small, 128, 64), 0),
                        0.1F); // so small that hardly anything is smoothed
    const std::vector<Bending> bendings = find_bending(torus.rest());
    size_t compared = 0;
    for (size_t v = 0; v < bendings.size(); ++v) {
        const Bending& bending = bendings[v];
        const glm::vec3 p = torus.positions()[v];
        const float around = std::hypot(p.x, p.z);
        const float cosine = (around - big) / small;
        if (bending.normal == glm::vec3(0.0F)) {
            continue; // another vertex represents it
        }
        const float sine = p.y / small;
        const glm::vec3 outwards = cosine * glm::vec3(p.x, 0.0F, p.z) / around + glm::vec3(0.0F, sine, 0.0F);
        ASSERT_GT(glm::dot(bending.normal, outwards), 0.9995F);
        const PrincipalCurvatures curvatures = principal_curvatures(bending.form);
        ASSERT_NEAR(curvatures.greatest, 1.0F / small, 0.02F / small);
        ASSERT_NEAR(curvatures.least, cosine / around, 0.02F);
        const glm::vec3 third = glm::cross(bending.normal, bending.tangent);
        const glm::vec3 meridian = curvatures.direction.x * bending.tangent + curvatures.direction.y * third;
        const glm::vec3 upwards = -sine * glm::vec3(p.x, 0.0F, p.z) / around + glm::vec3(0.0F, cosine, 0.0F);
        ASSERT_GT(std::abs(glm::dot(meridian, upwards)), 0.995F);
        // At 45 degrees the derivative contains three times that of the lesser curvature along the tube.
        const glm::vec3 across = glm::cross(bending.normal, upwards);
        const auto in_plane = [&](const glm::vec3& way) {
            return glm::vec2(glm::dot(way, bending.tangent), glm::dot(way, third));
        };
        const auto along = [&](const glm::vec3& way) { return change_along(bending.change, in_plane(way)); };
        const float mixed =
            (along(upwards + across) + along(upwards - across) - 2.0F * along(upwards)) / 6.0F;
        ASSERT_NEAR(mixed, -big * sine / (small * around * around), 0.12F);
        ASSERT_NEAR(along(upwards), 0.0F, 0.1F);
        ASSERT_NEAR(along(across), 0.0F, 0.1F);
        ++compared;
    }
    EXPECT_EQ(compared, 128U * 64U);
}

TEST(Bending, TurnsItsSignWithTheSide)
{
    Surface ball(shapes::sphere(2.0F, 48, 24), 1.0F);
    for (const bool is_inside : {false, true}) {
        if (is_inside) {
            ball.turn_around();
        }
        for (const Bending& bending : find_bending(ball.rest())) {
            if (bending.normal != glm::vec3(0.0F)) {
                ASSERT_NEAR(bending.form.x, is_inside ? -0.5F : 0.5F, 0.02F);
                ASSERT_NEAR(bending.form.z, is_inside ? -0.5F : 0.5F, 0.02F);
            }
        }
    }
}

/// Expects the lines of waves along x: straight ridges where the cosine is 1, straight valleys where it is
/// -1.
void expect_wave_lines(float noise, float tolerance)
{
    constexpr float waves = 1.5F;
    const Surface wave(sheet(
                           81, [](float x, float) { return 0.1F * std::cos(2.0F * pi * waves * x); }, noise),
                       2.8F);
    for (const bool is_ridge : {true, false}) {
        const FeatureChains lines =
            wave.ridges({.ridges = is_ridge, .valleys = !is_ridge, .ridge_deg = 10.0F});
        // Ridges at -2/3, 0 and 2/3; valleys only at -1/3 and 1/3, because those at the borders do not count.
        ASSERT_EQ(lines.chains.size(), is_ridge ? 3U : 2U);
        EXPECT_TRUE(lines.leave_edges);
        double worst = 0.0;
        double sum = 0.0;
        for (const shared::FeatureChain& chain : lines.chains) {
            EXPECT_EQ(chain.is_closed, 0U);
            double length = 0.0;
            for (uint32_t i = 0; i < chain.point_count; ++i) {
                const shared::FeaturePoint& point = lines.points.at(chain.first_point + i);
                EXPECT_EQ(point.kind, is_ridge ? shared::line_ridge : shared::line_valley);
                EXPECT_EQ(point.side & 3U, 3U);
                const glm::vec3 p = wave.place(point);
                const double crest = static_cast<double>(p.x) * waves + (is_ridge ? 0.0 : 0.5);
                const double off = std::abs(crest - std::round(crest)) / static_cast<double>(waves);
                worst = std::max(worst, off);
                sum += off;
                length += i == 0 ? 0.0
                                 : std::abs(static_cast<double>(
                                       p.y - wave.place(lines.points[chain.first_point + i - 1]).y));
            }
            EXPECT_GT(length, 1.85);
        }
        EXPECT_LT(sum / static_cast<double>(lines.points.size()), static_cast<double>(tolerance)) << noise;
        EXPECT_LT(worst, 0.025); // in units of a grid square
    }
}

TEST(RidgeChains, OfAWaveAreItsCrestsAndTroughs)
{
    expect_wave_lines(0.0F, 0.00375F); // 3/20 of a grid square
    expect_wave_lines(0.6F, 0.005F);
}

TEST(RidgeChains, OfALentilAreOneClosedRim)
{
    Primitive lentil = shapes::sphere(1.0F, 96, 48);
    for (glm::vec3& position : lentil.positions) {
        position.y *= 0.4F;
    }
    const Surface surface(lentil, 2.8F);
    const FeatureChains lines = surface.ridges({.ridges = true, .valleys = true, .ridge_deg = 5.0F});
    ASSERT_EQ(lines.chains.size(), 1U);
    EXPECT_EQ(lines.chains[0].is_closed, 1U);
    EXPECT_EQ(lines.points.front().vertex, lines.points.back().vertex);
    double length = 0.0;
    for (size_t i = 0; i < lines.points.size(); ++i) {
        EXPECT_EQ(lines.points[i].kind, shared::line_ridge);
        EXPECT_NEAR(surface.place(lines.points[i]).y, 0.0F, 0.01F);
        length += i == 0 ? 0.0
                         : static_cast<double>(glm::distance(surface.place(lines.points[i]),
                                                             surface.place(lines.points[i - 1])));
    }
    EXPECT_NEAR(length, 2.0 * std::numbers::pi, 0.02);
}

TEST(RidgeChains, AreWhereItBendsEnoughAndNotInCrumbs)
{
    // The wave grows with y; its crests become lines where they are sharp enough.
    const Surface wave(
        sheet(81, [](float x, float y) { return 0.05F * (y + 1.0F) * std::cos(2.0F * pi * 1.5F * x); }),
        2.8F);
    const auto lowest = [&](float ridge_deg) {
        float y = 1.0F;
        for (const shared::FeaturePoint& point :
             wave.ridges({.ridges = true, .ridge_deg = ridge_deg}).points) {
            y = std::min(y, wave.place(point).y);
        }
        return y;
    };
    // A crest of height a has the curvature a (2 pi 1.5)^2, or 1.6 degrees per hundredth of the size for
    // 0.01.
    EXPECT_NEAR(lowest(9.0F), 2.0F * (9.0F * 2.0F / 3.0F) / (14.3F * 1.0F) - 1.0F, 0.08F);
    EXPECT_TRUE(wave.ridges({.ridges = true, .ridge_deg = 16.0F}).chains.empty());
    // A sphere has none at any threshold, nor has a flat-shaded surface.
    EXPECT_TRUE(Surface(shapes::sphere(1.0F, 48, 24), 3.4F)
                    .ridges({.ridges = true, .valleys = true, .ridge_deg = 0.5F})
                    .chains.empty());
    EXPECT_TRUE(Surface(shapes::box({1.0F, 2.0F, 3.0F}), 3.7F)
                    .ridges({.ridges = true, .valleys = true, .ridge_deg = 0.5F})
                    .chains.empty());
}

} // namespace
} // namespace estampe::contour
