// SPDX-License-Identifier: MIT
// Light that spreads in a map of the surface: the profile's integral, energy, seams, and pictures compared to
// spreading on the page.
#include "techniques/subsurface/subsurface.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include <estampe/renderer.hpp>
#include <estampe/shapes.hpp>

#include "features/common/surface_map.hpp"
#include "gpu/resources.hpp"
#include "support/drawing.hpp"
#include "support/effect_pictures.hpp"
#include "support/gpu_device.hpp"
#include "support/layers.hpp"
#include "support/scenes.hpp"
#include "techniques/subsurface/subsurface_test_support.hpp"

namespace estampe::subsurface {
namespace {

constexpr uint32_t size = 96;

/// Light in the map of one sheet of two metres per side, or of two such sheets with a gap between them.
class Sheet {
public:
    explicit Sheet(const Scene& scene)
        : drawing(scene, {.eye = {0.0, 3.0, 0.1}, .target = {0.0, 0.0, 0.0}}, {16, 16}),
          data(features::make_surface_map(drawing.layout, size)),
          map(features::upload_surface_map(test::shared_device(), data)), posed(drawing.posed())
    {
    }

    /// Light scattered from other texels, per texel.
    [[nodiscard]] std::vector<glm::vec4> spread(const test::Painter<glm::vec4>& paint, float scatter_tx)
    {
        const SubsurfaceStyle style{.enabled = true,
                                    .scatter_m = scatter_tx / data.texels_per_m,
                                    .scatter_color = glm::vec3(1.0F),
                                    .depth_m = 0.0F};
        gpu::Device& device = test::shared_device();
        auto light = test::Layer::color(glm::uvec2(size), paint);
        auto parameters =
            gpu::upload_buffer(device, "subsurface parameters", std::vector{parameters_of(style)});
        auto vertices = gpu::upload_buffer(device, "posed", posed);
        auto triangles = gpu::upload_buffer(device, "triangles", drawing.layout.triangles);
        auto draws = gpu::upload_buffer(device, "draws", drawing.pose.draws);
        auto materials = gpu::upload_buffer(
            device, "materials", std::vector<shared::MaterialRecord>(drawing.pose.draws.size() + 1));
        gpu::Graph graph;
        const TextureInputs in{.map_texels = gpu::import_whole(graph, "texels", map.texels),
                               .map_corners = gpu::import_whole(graph, "corners", map.corners),
                               .triangles = gpu::import_whole(graph, "triangles", triangles),
                               .posed_vertices = gpu::import_whole(graph, "posed", vertices),
                               .draws = gpu::import_whole(graph, "draws", draws),
                               .materials = gpu::import_whole(graph, "materials", materials),
                               .parameters = gpu::import_whole(graph, "subsurface parameters", parameters),
                               .variant_of_draw = std::nullopt,
                               .size = size,
                               .most_spread_tx = scatter_tx};
        const TextureSurface surface = add_texture_surface(graph, in);
        const TextureLight result = add_texture_scatter(graph, in, surface, light.in(graph));
        return test::run_and_read_as<glm::vec4>(graph, result.sum);
    }

    /// Scattered light with the light that stays in place.
    [[nodiscard]] std::vector<glm::vec4> mixed(const test::Painter<glm::vec4>& paint, float scatter_tx)
    {
        std::vector<glm::vec4> all = spread(paint, scatter_tx);
        const double x = 0.5 * 0.5 / std::numbers::sqrt2 / static_cast<double>(scatter_tx);
        const auto kept = static_cast<float>(0.25 * std::erf(x) + 0.75 * std::erf(x / 3.0));
        for (uint32_t i = 0; i < all.size(); ++i) {
            all[i] += kept * paint({i % size, i / size});
        }
        return all;
    }

    test::Drawing drawing;
    features::SurfaceMapData data;
    features::SurfaceMap map;
    std::vector<shared::PosedVertex> posed;
};

TEST(ScatterInTexture, BlursAStepAsTheProfileDoes)
{
    Sheet sheet(test::scene_of(shapes::plane(2.0F, 2.0F, 4)));
    for (const float scatter_tx : {3.5F, 4.5F}) {
        const std::vector<glm::vec4> result =
            sheet.mixed([](glm::uvec2 texel) { return glm::vec4(texel.x < 48 ? 1.0F : 0.0F); }, scatter_tx);
        double worst = 0.0;
        for (uint32_t x = 28; x < 68; ++x) { // away from the sheet's ends
            const double off_tx = x + 0.5 - 48.0;
            const double beside = beside_line(std::abs(off_tx) / static_cast<double>(scatter_tx));
            const double wanted = off_tx < 0.0 ? 0.5 + beside : 0.5 - beside;
            worst = std::max(worst, std::abs(static_cast<double>(result[size_t{48} * size + x].x) - wanted));
        }
        RecordProperty(fmt::format("worst_at_{}_texels", scatter_tx), fmt::format("{:.4f}", worst));
        EXPECT_LT(worst, 0.01) << scatter_tx;
    }
}

TEST(ScatterInTexture, KeepsTheEnergyOfAPoint)
{
    Sheet sheet(test::scene_of(shapes::plane(2.0F, 2.0F, 4)));
    for (const float scatter_tx : {0.5F, 1.1F, 2.2F}) {
        const std::vector<glm::vec4> result = sheet.mixed(
            [](glm::uvec2 texel) { return glm::vec4(texel == glm::uvec2(48, 45) ? 1000.0F : 0.0F); },
            scatter_tx);
        double sum = 0.0;
        for (const glm::vec4& texel : result) {
            sum += static_cast<double>(texel.y);
        }
        EXPECT_NEAR(sum / 1000.0, 1.0, 1e-3) << scatter_tx;
    }
}

TEST(ScatterInTexture, DoesNotCrossASeam)
{
    // Two distant sheets: one lit, the other dark.
    Scene scene = test::scene_of(shapes::plane(2.0F, 2.0F, 4));
    test::add_object(scene, shapes::plane(2.0F, 2.0F, 4), glm::vec3(1.0F), {50.0, 0.0, 0.0});
    Sheet sheet(scene);
    const auto is_first = [&](uint32_t texel) {
        const uint32_t triangle = sheet.data.texels[texel].x;
        return triangle > 0 &&
               (sheet.drawing.layout.triangles[triangle - 1].w & shared::triangle_draw_mask) == 0;
    };
    const std::vector<glm::vec4> result = sheet.mixed(
        [&](glm::uvec2 texel) { return glm::vec4(is_first(texel.y * size + texel.x) ? 1.0F : 0.0F); }, 4.0F);
    int count = 0;
    for (uint32_t i = 0; i < result.size(); ++i) {
        if (sheet.data.texels[i].x > 0) {
            EXPECT_NEAR(result[i].x, is_first(i) ? 1.0F : 0.0F, 2e-3F) << i;
            ++count;
        }
    }
    EXPECT_GT(count, 2000);
}

/// A sheet of skin that faces the camera, half of it in the shadow of a board.
class SkinInTexture : public testing::Test {
protected:
    void SetUp() override
    {
        Scene scene = test::scene_of(shapes::plane(4.0F, 4.0F, 4));
        scene.materials.front().name = "skin";
        test::add_object(scene, shapes::box({4.0F, 0.1F, 6.0F}), glm::vec3(1.0F), {2.0, 3.0, 0.0});
        test::add_sun(scene, {0.0, 1.0, 0.0});
        renderer.set_scene(scene);
    }

    [[nodiscard]] LinearImage draw(const std::vector<std::string>& assignments, double x_m = 0.0)
    {
        std::vector<std::string> all{"paper.margin_mm=0", "hatch.enabled=false",  "sky.enabled=false",
                                     "wash.strength=1",   "wash.light_tint=1",    "light.ambient=0.1",
                                     "wash.neutral=1",    "light.turn_sun=false", "wash.least=0"};
        all.insert(all.end(), assignments.begin(), assignments.end());
        // A camera below the board.
        const Camera from_above{.eye = {x_m, 2.0, 0.0},
                                .target = {x_m, 0.0, 0.0},
                                .up = {0.0, 0.0, -1.0},
                                .vertical_fov_rad = 0.72};
        return renderer.render_linear(from_above, test::effect_style({}, all), {.width = 120, .height = 90});
    }

    [[nodiscard]] static double rms_between(const LinearImage& a, const LinearImage& b)
    {
        double squares = 0.0;
        for (size_t i = 0; i < a.pixels.size(); ++i) {
            squares += std::pow(glm::distance(glm::vec3(a.pixels[i]), glm::vec3(b.pixels[i])), 2.0);
        }
        return std::sqrt(squares / static_cast<double>(a.pixels.size()));
    }

    Renderer& renderer = test::shared_renderer();
    std::vector<std::string> skin{"material.skin.subsurface.enabled=true",
                                  "material.skin.subsurface.scatter_m=0.08",
                                  "material.skin.subsurface.depth_m=0", "subsurface.reach_mm=200"};
};

TEST_F(SkinInTexture, LooksAsItDoesOnThePage)
{
    // In flat tones, as of the first wash, a column flips for a tiny difference of light; and where the reach
    // cuts the profile's tail on the page, the map's tail is longer. So the second wash is black with the
    // softest tone, its paint is 1 - smoothstep(1 - light), and the page is large enough for d of 4.8 pixels.
    // The error is then, as a share of the step: 1.1 % for a blur on the page and 1 % for one in a map. The
    // map's shadow edge is off by half a texel, 0.6 of a pixel, and from two pixels on the profile rises by
    // at most 5 % per pixel. Paint changes by 1.5 times the sum.
    constexpr double bound = 1.5 * (0.011 + 0.01 + 0.6 * 0.05);
    const std::vector<std::string> soft{
        "tone.curve=linear", "tone.exposure=0.6", "wash.shadow_tint=#000000", "wash.shadow_from=0.5",
        "wash.softness=0.5", "wash.light_tint=0", "paper.height_mm=100"};
    skin.insert(skin.end(), soft.begin(), soft.end());
    skin.emplace_back("material.skin.subsurface.scatter_color=#ffffff");
    const LinearImage plain = draw(soft);
    const LinearImage on_page = draw(skin);
    skin.emplace_back("subsurface.space=texture");
    const LinearImage in_texture = draw(skin);
    EXPECT_TRUE(test::has_pass("subsurface/map"));
    EXPECT_GT(rms_between(on_page, plain), 0.02);
    const auto red_at = [](const LinearImage& image, size_t x) {
        return static_cast<double>(image.pixels[size_t{45} * image.width + x].x);
    };
    const double step = red_at(plain, 0) - red_at(plain, 119);
    double worst = 0.0;
    for (size_t x = 0; x < 120; ++x) {
        const bool is_at_edge = x >= 58 && x < 62;
        worst = std::max(worst, is_at_edge ? 0.0 : std::abs(red_at(in_texture, x) - red_at(on_page, x)));
    }
    RecordProperty("worst_share_of_step", fmt::format("{:.4f}", worst / step));
    EXPECT_LT(worst, bound * step);
    EXPECT_LT(rms_between(in_texture, on_page), bound * rms_between(on_page, plain));
    // At this distance from the edge, light is uniform and unchanged by spreading.
    EXPECT_NEAR(red_at(in_texture, 0), red_at(plain, 0), 0.005 * step);
    EXPECT_NEAR(red_at(on_page, 0), red_at(plain, 0), 0.005 * step);
}

TEST_F(SkinInTexture, TakesLightFromWhatIsNotSeen)
{
    // All visible points are in shadow, next to the lit part.
    const double x_m = 1.02;
    const LinearImage on_page = draw(skin, x_m);
    skin.emplace_back("subsurface.space=texture");
    const LinearImage in_texture = draw(skin, x_m);
    const size_t left = size_t{45} * 120;
    EXPECT_GT(in_texture.pixels[left].x, on_page.pixels[left].x + 0.02F);
}

TEST_F(SkinInTexture, CostsNothingWhenOff)
{
    const LinearImage plain = draw({});
    EXPECT_EQ(draw({"subsurface.space=texture"}).pixels, plain.pixels);
    EXPECT_FALSE(test::has_pass("subsurface"));
    (void)draw(skin);
    EXPECT_FALSE(test::has_pass("subsurface/map"));
}

} // namespace
} // namespace estampe::subsurface
