// SPDX-License-Identifier: MIT
// Parts of transparent surfaces that are drawn as solid.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <estampe/renderer.hpp>
#include <estampe/shapes.hpp>

#include "support/drawing.hpp"
#include "support/gpu_device.hpp"
#include "support/scenes.hpp"
#include "techniques/transparency/transparency.hpp"

namespace estampe::transparency {
namespace {

constexpr uint32_t card_side_px = 96;
constexpr float solid_from = 0.98F;

/// An upright card of 2 m, solid in the middle and clear at its left and right edge.
struct Card {
    double turn_rad = 0.0; ///< about the vertical axis
    double x = 0.0;
    double z = 0.0;
    glm::vec3 color{1.0F};

    static constexpr double core = 0.45; ///< half width of the solid part

    /// The place of a page position on the card, across; the card ends at -1 and 1.
    [[nodiscard]] double across(double page_x) const { return (page_x - x) / std::cos(turn_rad); }

    [[nodiscard]] double depth_z(double page_x) const { return z - across(page_x) * std::sin(turn_rad); }

    [[nodiscard]] double alpha(double page_x) const
    {
        return std::clamp((1.0 - std::abs(across(page_x))) / (1.0 - core), 0.0, 1.0);
    }
};

Primitive card_mesh()
{
    Primitive mesh;
    for (const float across :
         {-1.0F, -static_cast<float>(Card::core), static_cast<float>(Card::core), 1.0F}) {
        for (const float y : {-1.0F, 1.0F}) {
            mesh.positions.emplace_back(across, y, 0.0F);
            mesh.normals.emplace_back(0.0F, 0.0F, 1.0F);
            mesh.colors.emplace_back(1.0F, 1.0F, 1.0F, std::abs(across) < 1.0F ? 1.0F : 0.0F);
        }
    }
    for (uint32_t column = 0; column < 3; ++column) {
        const uint32_t first = 2 * column;
        for (const uint32_t corner : {0U, 2U, 3U, 0U, 3U, 1U}) {
            mesh.indices.push_back(first + corner);
        }
    }
    return mesh;
}

Scene scene_of_cards(const std::vector<Card>& cards)
{
    Scene scene;
    for (const Card& card : cards) {
        const Index node = test::add_object(scene, card_mesh(), card.color, {card.x, 0.0, card.z});
        scene.nodes[node].transform.rotation = glm::angleAxis(card.turn_rad, glm::dvec3(0, 1, 0));
        scene.materials.back().alpha_mode = AlphaMode::blend;
        scene.materials.back().has_clear_parts = true;
    }
    return scene;
}

/// A camera whose page is filled by a square of 2 m.
Camera card_camera()
{
    Camera camera = test::front_camera(6.0, 0.6);
    camera.orthographic_half_height_m = 1.0;
    return camera;
}

double page_x_of(uint32_t column)
{
    return 2.0 * (column + 0.5) / card_side_px - 1.0;
}

/// Colour of a column by compositing all cards in depth order over white.
glm::vec3 exact_color(const std::vector<Card>& cards, double page_x)
{
    std::vector<const Card*> order;
    order.reserve(cards.size());
    for (const Card& card : cards) {
        order.push_back(&card);
    }
    std::ranges::sort(order,
                      [&](const Card* a, const Card* b) { return a->depth_z(page_x) < b->depth_z(page_x); });
    glm::vec3 color(1.0F);
    for (const Card* card : order) {
        color = glm::mix(color, card->color, static_cast<float>(card->alpha(page_x)));
    }
    return color;
}

/// The middle row of a page: the solid draw + 1, and the colour of solid and transparent surfaces over white.
struct Row {
    std::vector<uint32_t> solid;
    std::vector<glm::vec3> color;
};

Row drawn_row(const std::vector<Card>& cards, const TransparencyStyle& style, RasterPath path)
{
    test::Drawing drawing(scene_of_cards(cards), card_camera(), glm::uvec2(card_side_px));
    drawing.path = path;
    drawing.set_transparency(style);
    const test::SurfacePixels solid = drawing.surface();
    const test::ScreenPixels screen = drawing.screen();
    Row row;
    for (uint32_t x = 0; x < card_side_px; ++x) {
        const size_t pixel = size_t{card_side_px / 2} * card_side_px + x;
        const uint32_t word = solid.draw[pixel];
        row.solid.push_back(word == 0 ? 0U : word & 0xffffU);
        const glm::vec3 behind = word == 0 ? glm::vec3(1.0F) : cards[row.solid.back() - 1].color;
        row.color.push_back(glm::mix(behind, glm::vec3(screen.color[pixel]), screen.color[pixel].w));
    }
    return row;
}

constexpr std::array card_paths{RasterPath::compute, RasterPath::hardware};

TEST(OpaqueParts, CrossingCardsHideEachOtherByDepth)
{
    const std::vector<Card> cards{{.turn_rad = 0.7, .color = {0.8F, 0.1F, 0.1F}},
                                  {.turn_rad = -0.7, .color = {0.1F, 0.2F, 0.8F}}};
    for (const RasterPath path : card_paths) {
        const Row row = drawn_row(cards, {.layers = 2, .opaque_above = solid_from}, path);
        int solid = 0;
        for (uint32_t x = 0; x < card_side_px; ++x) {
            const double page_x = page_x_of(x);
            const std::array solid_alpha{cards[0].alpha(page_x), cards[1].alpha(page_x)};
            const size_t nearer = cards[0].depth_z(page_x) > cards[1].depth_z(page_x) ? 0 : 1;
            const auto is_sure = [](double alpha) { return alpha < 0.95 || alpha == 1.0; };
            const bool is_clear_case =
                is_sure(solid_alpha[0]) && is_sure(solid_alpha[1]) && std::abs(page_x) > 1.0 / card_side_px;
            if (!is_clear_case) {
                continue;
            }
            const size_t hidden = 1 - nearer;
            const uint32_t wanted = solid_alpha[nearer] == 1.0   ? static_cast<uint32_t>(nearer) + 1U
                                    : solid_alpha[hidden] == 1.0 ? static_cast<uint32_t>(hidden) + 1U
                                                                 : 0U;
            EXPECT_EQ(row.solid[x], wanted) << x;
            solid += wanted != 0 ? 1 : 0;
            // A cover below 0.02 is left out, on each of the two cards.
            EXPECT_LT(glm::distance(row.color[x], exact_color(cards, page_x)), 0.04F) << x;
        }
        EXPECT_GT(solid, 20);
    }
}

/// A tuft of cards that cross each other.
std::vector<Card> tuft()
{
    std::vector<Card> cards;
    for (int i = 0; i < 12; ++i) {
        const double share = std::fmod(i * 0.618034, 1.0);
        const auto tone = static_cast<float>(std::fmod(i * 0.37, 1.0));
        cards.push_back({.turn_rad = 2.2 * (share - 0.5),
                         .x = 0.9 * (std::fmod(i * 0.7548, 1.0) - 0.5),
                         .z = 1.2 * (std::fmod(i * 0.5698, 1.0) - 0.5),
                         .color = {0.2F + 0.7F * tone, 0.15F + 0.3F * tone, 0.8F - 0.7F * tone}});
    }
    return cards;
}

double error_of(const std::vector<Card>& cards, int layers, float opaque_above)
{
    const Row row = drawn_row(cards, {.layers = layers, .opaque_above = opaque_above}, RasterPath::compute);
    double squares = 0.0;
    for (uint32_t x = 0; x < card_side_px; ++x) {
        const glm::vec3 off = row.color[x] - exact_color(cards, page_x_of(x));
        squares += static_cast<double>(glm::dot(off, off)) / 3.0;
    }
    return std::sqrt(squares / card_side_px);
}

TEST(OpaqueParts, NeedFewerLayers)
{
    const std::vector<Card> cards = tuft();
    std::string with;
    std::string without;
    for (int layers = 1; layers <= 4; ++layers) {
        const double solid = error_of(cards, layers, solid_from);
        const double all_blended = error_of(cards, layers, 1.0F);
        with += fmt::format(" {:.4f}", solid);
        without += fmt::format(" {:.4f}", all_blended);
        EXPECT_LT(solid, 0.85 * all_blended) << layers;
    }
    RecordProperty("rms", fmt::format("with one to four layers{}, without opaque parts{}", with, without));
    EXPECT_LT(error_of(cards, 4, solid_from), 0.03);
}

TEST(OpaqueParts, AreDrawnInWholePicturesOnlyIfTheStyleAsks)
{
    const std::vector<Card> cards{{.turn_rad = 0.3, .color = {0.5F, 0.4F, 0.3F}}};
    Renderer& renderer = test::shared_renderer();
    renderer.set_scene(scene_of_cards(cards));
    const auto draw = [&](std::initializer_list<const char*> assignments) {
        Style style;
        style.set("paper.grain=0");
        style.set("picture.ground=false");
        style.set("contour.outline.width_mm=2");
        for (const char* const assignment : assignments) {
            style.set(assignment);
        }
        return renderer.render(card_camera(), style, {.width = 240, .height = 240});
    };
    const auto dark_count = [](const Image& image) {
        int count = 0;
        for (size_t i = 0; i < image.rgba.size(); i += 4) {
            count += image.rgba[i] < 170 ? 1 : 0;
        }
        return count;
    };
    const Image plain = draw({});
    EXPECT_EQ(renderer.graph_dot().find("visibility/masked"), std::string::npos);
    EXPECT_EQ(draw({"transparency.opaque_above=1"}).rgba, plain.rgba);
    const Image solid = draw({"transparency.opaque_above=0.9"});
    EXPECT_NE(renderer.graph_dot().find("visibility/masked"), std::string::npos);
    EXPECT_NE(solid.rgba, plain.rgba);
    // Only a solid surface has lines of its own.
    EXPECT_GT(dark_count(draw({"hatch.enabled=false", "wash.strength=0", "transparency.opaque_above=0.9"})),
              dark_count(draw({"hatch.enabled=false", "wash.strength=0"})) + 40);
}

} // namespace
} // namespace estampe::transparency
