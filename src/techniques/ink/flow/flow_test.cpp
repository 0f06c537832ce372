// SPDX-License-Identifier: MIT
// The flow of ink, by the shader's own functions.
#include "techniques/ink/flow/flow.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "support/glsl.hpp"

namespace estampe {
namespace ink_flow {

using namespace test::glsl; // NOLINT(google-build-using-namespace)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wunused-function"
using shared::ink_map_side;
using shared::ink_node_cells;
using shared::ink_shape_side;
using shared::InkZone;

struct Globals {
    uvec2 grid_size{200, 150};
    vec2 page_mm{200.0F, 150.0F}; // a cell is a millimetre
    float map_mm_per_s = 20.0F;
};

static Globals globals;

vec4 texelFetch(const std::vector<float>& texels, int i)
{
    return vec4(texels.at(static_cast<size_t>(i)));
}

static std::vector<float> map_texels;
static std::vector<float> stream_texels;
static std::vector<float> zone_shapes;
#include "techniques/ink/cube.glsl"
#include "techniques/ink/flow/carried.glsl"
#include "techniques/ink/flow/flow.glsl"
#include "techniques/ink/flow/flow_map.glsl"
#include "techniques/ink/flow/zones.glsl"
#pragma GCC diagnostic pop

} // namespace ink_flow

namespace ink {
namespace {

constexpr auto node_cells = static_cast<float>(shared::ink_node_cells);

/// Everything that drives ink on the page.
struct Flow {
    InkStyle style;
    bool has_map = false;
    std::vector<shared::InkZone> zones;

    [[nodiscard]] float stream(glm::vec2 place_mm, double time_s) const
    {
        const Waves waves = page_waves(style);
        const auto phases = phases_at(waves, time_s);
        float psi = ink_flow::wind_stream(place_mm, wind_mm_per_s(style));
        for (size_t i = 0; i < waves.size(); ++i) {
            const shared::InkWave& wave = waves.at(i).wave;
            psi += ink_flow::wave_stream(glm::vec2(wave.wave), wave.amplitude, phases.at(i), place_mm);
        }
        psi += has_map ? ink_flow::flow_map_stream(place_mm) : 0.0F;
        for (const shared::InkZone& zone : zones) {
            psi = ink_flow::in_zone(psi, place_mm - zone.middle_mm, ink_flow::share_of_zone(zone, place_mm),
                                    zone.velocity_mm_per_s, zone.turn_rad_s,
                                    stream_at(waves, phases, wind_mm_per_s(style), zone.middle_mm));
        }
        return psi;
    }

    /// Computes the nodes of the stream function as the shader does.
    void keep(double time_s) const
    {
        const glm::uvec2 size = ink_flow::globals.grid_size;
        const glm::uvec2 count(ink_flow::nodes_across(size.x), ink_flow::nodes_across(size.y));
        ink_flow::stream_texels.clear();
        for (uint32_t y = 0; y < count.y; ++y) {
            for (uint32_t x = 0; x < count.x; ++x) {
                const glm::vec2 place_mm = node_cells * (glm::vec2(x, y) - 1.0F);
                ink_flow::stream_texels.push_back(stream(place_mm, time_s) / (node_cells * node_cells));
            }
        }
    }
};

/// Velocity from the stored nodes, in millimetres per second.
glm::dvec2 velocity(glm::dvec2 place_mm)
{
    constexpr float seconds = 0.125F;
    const glm::vec2 place(place_mm);
    return glm::dvec2(ink_flow::carried_cells(place, seconds) - ink_flow::carried_cells(place, -seconds)) /
           (2.0 * static_cast<double>(seconds));
}

constexpr std::array<double, 4> gauss_place{-0.861136311594053, -0.339981043584856, 0.339981043584856,
                                            0.861136311594053};
constexpr std::array<double, 4> gauss_weight{0.347854845137454, 0.652145154862546, 0.652145154862546,
                                             0.347854845137454};

/// Net flow out of a square, relative to its edge length times the fastest flow on it.
double divergence(glm::dvec2 middle_mm, double half_mm)
{
    double out = 0.0;
    double fastest = 1e-9;
    for (const double side : {-1.0, 1.0}) {
        for (size_t i = 0; i < gauss_place.size(); ++i) {
            const double along = half_mm * gauss_place.at(i);
            const auto right = velocity(middle_mm + glm::dvec2(side * half_mm, along));
            const auto down = velocity(middle_mm + glm::dvec2(along, side * half_mm));
            out += side * half_mm * gauss_weight.at(i) * (right.x + down.y);
            fastest = std::max({fastest, glm::length(right), glm::length(down)});
        }
    }
    return std::abs(out) / (8.0 * half_mm * fastest);
}

double most_divergence(const Flow& flow)
{
    double most = 0.0;
    for (const double time_s : {0.0, 1.7, 60.0}) {
        flow.keep(time_s);
        // Squares around nodes, where the stream function is a single polynomial.
        for (float x = node_cells; x < 196.0F; x += node_cells) {
            for (float y = node_cells; y < 146.0F; y += node_cells) {
                most = std::max(most, divergence({x, y}, 0.45 * static_cast<double>(node_cells)));
            }
        }
    }
    return most;
}

/// The field of a zone whose shape is a disc that touches the field's sides.
std::vector<float> field_of_a_disc()
{
    constexpr int side = shared::ink_shape_side;
    std::vector<float> field;
    for (int i = 0; i < side * side; ++i) {
        const glm::vec2 node = glm::vec2(i % side, i / side) / (0.5F * (side - 1)) - 1.0F;
        field.push_back(std::min(glm::length(node), 1.0F));
    }
    return field;
}

TEST(InkFlow, AZoneShapedAsADiscWeighsAsADiscDoes)
{
    ink_flow::zone_shapes = field_of_a_disc();
    shared::InkZone disc{.middle_mm = {60.0F, 70.0F}, .radius_mm = 40.0F};
    shared::InkZone shaped = disc;
    shaped.shape = 1;
    shaped.shape_min_mm = {20.0F, 30.0F};
    shaped.shape_size_mm = {80.0F, 80.0F};
    for (float x = 10.0F; x < 110.0F; x += 0.7F) {
        for (float y = 20.0F; y < 120.0F; y += 0.9F) {
            EXPECT_NEAR(ink_flow::share_of_zone(shaped, {x, y}), ink_flow::share_of_zone(disc, {x, y}), 0.02)
                << x << ' ' << y;
        }
    }
}

TEST(InkFlow, HasNoDivergence)
{
    constexpr double rounding = 2e-5; // the last bit of a stream function of some thousands is 2e-4
    Flow flow;
    const double of_waves = most_divergence(flow);
    EXPECT_LT(of_waves, rounding);
    flow.zones = {{.middle_mm = {60.0F, 70.0F}, .radius_mm = 40.0F, .velocity_mm_per_s = {30.0F, 10.0F}},
                  {.middle_mm = {90.0F, 80.0F}, .radius_mm = 30.0F, .turn_rad_s = 2.0F}};
    const double of_zones = most_divergence(flow);
    EXPECT_LT(of_zones, rounding);
    ink_flow::zone_shapes = field_of_a_disc();
    flow.zones.front().shape = 1;
    flow.zones.front().shape_min_mm = {20.0F, 30.0F};
    flow.zones.front().shape_size_mm = {80.0F, 80.0F};
    EXPECT_LT(most_divergence(flow), rounding) << "a zone with the shape of a mesh";
    std::mt19937 random(11); // NOLINT(cert-msc51-cpp): the same map each time
    std::uniform_real_distribution<float> value(-40.0F, 40.0F);
    ink_flow::map_texels.resize(size_t{shared::ink_map_side} * shared::ink_map_side);
    std::ranges::generate(ink_flow::map_texels, [&] { return value(random); });
    flow.has_map = true;
    const double of_map = most_divergence(flow);
    EXPECT_LT(of_map, rounding);
    RecordProperty("divergence", fmt::format("{:.1e} {:.1e} {:.1e}", of_waves, of_zones, of_map));
}

TEST(InkFlow, IsAsFastAsTheStyleSays)
{
    Flow flow;
    flow.style.wind_mm_per_s = 0.0F;
    double square = 0.0;
    int count = 0;
    for (int moment = 0; moment < 40; ++moment) {
        flow.keep(3.0 * moment);
        for (double x = 0.0; x < 200.0; x += 3.7) {
            for (double y = 0.0; y < 150.0; y += 3.1) {
                const glm::dvec2 flows = velocity({x, y});
                square += glm::dot(flows, flows);
                ++count;
            }
        }
    }
    const auto wanted = static_cast<double>(flow.style.swirl_mm_per_s);
    // Nodes 4 mm apart slightly smooth the smallest swirls, which measure 10 mm.
    EXPECT_NEAR(std::sqrt(square / count), wanted, 0.1 * wanted);
    flow.style.wind_mm_per_s = 20.0F;
    flow.style.wind_deg = 90.0F;
    const glm::vec2 up = wind_mm_per_s(flow.style);
    EXPECT_NEAR(up.x, 0.0F, 1e-5F);
    EXPECT_NEAR(up.y, -20.0F, 1e-5F) << "up on the page, whose y points down";
}

TEST(InkFlow, ObeysAZoneInItsMiddle)
{
    Flow flow;
    flow.zones = {{.middle_mm = {100.0F, 70.0F}, .radius_mm = 40.0F, .velocity_mm_per_s = {3.0F, -4.0F}}};
    flow.keep(1.0);
    const glm::dvec2 blown = velocity({105.0, 73.0});
    EXPECT_NEAR(blown.x, 3.0, 1e-3);
    EXPECT_NEAR(blown.y, -4.0, 1e-3);
    const glm::dvec2 outside = velocity({160.0, 70.0});
    Flow().keep(1.0);
    EXPECT_EQ(outside, velocity({160.0, 70.0}));
    flow.zones = {{.middle_mm = {100.0F, 70.0F}, .radius_mm = 40.0F, .turn_rad_s = 0.5F}};
    flow.keep(1.0);
    const glm::dvec2 turned = velocity({106.0, 70.0});
    EXPECT_NEAR(turned.x, 0.0, 1e-3);
    EXPECT_NEAR(turned.y, 3.0, 1e-3) << "clockwise";
}

TEST(InkFlow, CarriesInAnArcWhatTurns)
{
    Flow flow;
    flow.zones = {{.middle_mm = {100.0F, 76.0F}, .radius_mm = 120.0F, .turn_rad_s = 1.0F}};
    flow.keep(0.0);
    const glm::vec2 middle(100.0F, 76.0F);
    const glm::vec2 place(130.0F, 76.0F);
    const glm::vec2 from = place - ink_flow::carried_cells(place, 0.05F);
    EXPECT_NEAR(glm::distance(from, middle), 30.0F, 1e-3F) << "on its circle";
    EXPECT_NEAR(glm::distance(from, place), 1.5F, 1e-3F);
}

TEST(InkFlow, OfAPictureKeepsWhatTurnsAndDropsWhatSpreads)
{
    constexpr uint32_t side = shared::ink_map_side;
    const glm::vec2 page_mm(200.0F, 150.0F);
    const glm::dvec2 waves = std::numbers::pi / glm::dvec2(page_mm);
    // `turning` flows around the middle of the page, `spreading` away from it, and never along the edges.
    const auto turning = [&](glm::dvec2 at) {
        return glm::dvec2(0.5 * page_mm.y - at.y, at.x - 0.5 * page_mm.x) / 100.0;
    };
    const auto spreading = [&](glm::dvec2 at) {
        const glm::dvec2 turns = waves * at;
        return -glm::dvec2(std::cos(turns.x) * std::sin(turns.y),
                           page_mm.x / page_mm.y * std::sin(turns.x) * std::cos(turns.y));
    };
    Flow flow;
    flow.style.wind_mm_per_s = 0.0F;
    flow.style.swirl_mm_per_s = 0.0F;
    flow.has_map = true;
    ink_flow::globals.map_mm_per_s = 1.0F;
    for (const bool turns : {true, false}) {
        std::vector<glm::vec2> velocities;
        for (uint32_t row = 0; row < side; ++row) {
            for (uint32_t column = 0; column < side; ++column) {
                const glm::dvec2 at = glm::dvec2(column, row) / (side - 1.0) * glm::dvec2(page_mm);
                velocities.emplace_back(turns ? turning(at) : spreading(at));
            }
        }
        ink_flow::map_texels = stream_of_flow(velocities, page_mm);
        flow.keep(0.0);
        for (const glm::dvec2 place :
             {glm::dvec2(40.0, 50.0), glm::dvec2(100.0, 75.0), glm::dvec2(150.0, 30.0)}) {
            const glm::dvec2 wanted = turns ? turning(place) : glm::dvec2(0.0);
            EXPECT_LT(glm::distance(velocity(place), wanted), 0.01) << (turns ? "turns" : "spreads");
        }
    }
    ink_flow::globals = {};
}

TEST(InkCube, FindsEveryDirectionOnItsFace)
{
    std::mt19937 random(3); // NOLINT(cert-msc51-cpp)
    std::normal_distribution<float> value;
    std::array<int, 6> of_face{};
    for (int i = 0; i < 2000; ++i) {
        const glm::vec3 direction = glm::normalize(glm::vec3(value(random), value(random), value(random)));
        const ink_flow::FacePlace place = ink_flow::face_place(direction);
        ASSERT_LT(place.face, 6U);
        ++of_face.at(place.face);
        EXPECT_LE(std::max(std::abs(place.at.x), std::abs(place.at.y)), 1.0F);
        const glm::vec3 back = glm::normalize(ink_flow::face_direction(place.face, place.at));
        EXPECT_LT(glm::distance(back, direction), 1e-6F);
    }
    EXPECT_GT(*std::ranges::min_element(of_face), 200);
}

} // namespace
} // namespace ink
} // namespace estampe
