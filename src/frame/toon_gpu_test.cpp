// SPDX-License-Identifier: MIT
// Cel shading with two textures in whole pictures: the lit texture where the sun shines, the second texture
// in the shade, and the step between them.
#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <estampe/error.hpp>
#include <estampe/renderer.hpp>
#include <estampe/shapes.hpp>

#include "core/color.hpp"
#include "core/file.hpp"
#include "support/effect_pictures.hpp"
#include "support/folder.hpp"
#include "support/gpu_device.hpp"
#include "support/scenes.hpp"

namespace estampe {
namespace {

constexpr uint32_t side_px = 160;
constexpr RenderSettings toon_page{.width = side_px, .height = side_px};

/// Colours of texels, in eight bits of sRGB.
const glm::ivec3 lit_color(230, 120, 60);
const glm::ivec3 shade_color(70, 60, 150);

Image one_color(const glm::ivec3& color)
{
    return {.width = 1,
            .height = 1,
            .rgba = {static_cast<uint8_t>(color.x), static_cast<uint8_t>(color.y),
                     static_cast<uint8_t>(color.z), 255}};
}

/// An image with red and green above blue and yellow.
Image four_colors()
{
    return {
        .width = 2, .height = 2, .rgba = {255, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 255, 255, 255, 0, 255}};
}

/// Adds `image` as the second texture of the first material.
void add_shade_texture(Scene& scene, Image image)
{
    scene.materials[0].toon.emplace();
    scene.materials[0].toon->shade_texture.texture = static_cast<Index>(scene.textures.size());
    scene.textures.push_back({.image = std::move(image)});
}

/// An object with the lit colour as its texture, and a sun.
Scene lit_scene(Primitive primitive, const glm::dvec3& towards_sun)
{
    Scene scene = test::scene_of(std::move(primitive));
    scene.materials[0].name = "paint";
    scene.textures.push_back({.image = one_color(lit_color)});
    scene.materials[0].base_color_texture.texture = 0;
    test::add_sun(scene, towards_sun);
    return scene;
}

/// A square of 2 m in z = 0 that fills the page, with the first row of texels on top.
Primitive wall()
{
    Primitive primitive;
    primitive.positions = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
    primitive.normals.assign(4, {0, 0, 1});
    primitive.uvs[0] = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
    primitive.uvs[1] = {{1, 1}, {0, 1}, {0, 0}, {1, 0}};
    primitive.indices = {0, 1, 2, 0, 2, 3};
    return primitive;
}

Camera flat_camera()
{
    Camera camera = test::front_camera(5.0, 0.6);
    camera.orthographic_half_height_m = 1.0;
    return camera;
}

/// A style that draws only paint, in the colours of the textures. Light changes no colour.
Style paint_alone(const std::vector<std::string>& assignments = {})
{
    return test::effect_style({"hatch.enabled=false", "paper.color=#ffffff", "paper.margin_mm=0",
                               "wash.strength=1", "wash.neutral=1", "wash.saturation=1", "wash.detail=1",
                               "wash.least=0", "light.shadows=false", "sky.enabled=false"},
                              assignments);
}

Image draw(const Scene& scene, const Style& style)
{
    test::shared_renderer().set_scene(scene);
    return test::shared_renderer().render(flat_camera(), style, toon_page);
}

glm::ivec3 color_at(const Image& picture, uint32_t x, uint32_t y)
{
    const uint8_t* const texel = &picture.rgba[4 * (size_t{y} * picture.width + x)];
    return {texel[0], texel[1], texel[2]};
}

/// The colour at a place of the page, 0 to 1 to the right and down.
glm::ivec3 color_at(const Image& picture, double x, double y)
{
    return color_at(picture, static_cast<uint32_t>(x * side_px), static_cast<uint32_t>(y * side_px));
}

int difference(const glm::ivec3& a, const glm::ivec3& b)
{
    const glm::ivec3 each = glm::abs(a - b);
    return std::max({each.x, each.y, each.z});
}

/// Mixes two colours in linear light.
glm::ivec3 mixed(const glm::ivec3& a, const glm::ivec3& b, double share)
{
    glm::ivec3 result;
    for (int i = 0; i < 3; ++i) {
        const double linear = (1.0 - share) * linear_from_srgb(static_cast<float>(a[i]) / 255.0F) +
                              share * linear_from_srgb(static_cast<float>(b[i]) / 255.0F);
        const double encoded =
            linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055;
        result[i] = static_cast<int>(std::lround(255.0 * encoded));
    }
    return result;
}

/// Outward normal of the unit sphere at a pixel; none outside the sphere and near its outline.
std::optional<glm::dvec3> sphere_normal(uint32_t x, uint32_t y)
{
    const glm::dvec2 place = (glm::dvec2(x, y) + 0.5) * (2.0 / side_px) - 1.0;
    const double squared = glm::dot(place, place);
    return squared < 0.92 ? std::optional(glm::dvec3(place.x, -place.y, std::sqrt(1.0 - squared)))
                          : std::nullopt;
}

TEST(ToonShade, TheStepOfASphereLiesWhereTheFormulaOfMtoonPutsIt)
{
    const glm::dvec3 towards_sun = glm::normalize(glm::dvec3(1.0, 0.8, 0.4));
    int worst = 0;
    for (const auto& [shift, toony] :
         {std::pair(0.0F, 0.5F), std::pair(-0.3F, 0.5F), std::pair(0.35F, 0.7F), std::pair(0.0F, 0.9F)}) {
        Scene scene = lit_scene(shapes::sphere(1.0F, 256, 128), towards_sun);
        add_shade_texture(scene, one_color(shade_color));
        scene.materials[0].toon->shade_shift = shift;
        scene.materials[0].toon->shade_toony = toony;
        const Image picture = draw(scene, paint_alone());
        size_t wholly_lit = 0;
        size_t in_shade = 0;
        for (uint32_t y = 0; y < side_px; ++y) {
            for (uint32_t x = 0; x < side_px; ++x) {
                const auto normal = sphere_normal(x, y);
                if (!normal) {
                    continue;
                }
                const double shading = glm::dot(*normal, towards_sun) + static_cast<double>(shift);
                const double half = 1.0 - static_cast<double>(toony);
                const double share = std::clamp((shading + half) / (2.0 * half), 0.0, 1.0);
                worst = std::max(worst,
                                 difference(color_at(picture, x, y), mixed(shade_color, lit_color, share)));
                wholly_lit += share == 1.0 ? 1 : 0;
                in_shade += share == 0.0 ? 1 : 0;
            }
        }
        EXPECT_GT(wholly_lit, 500U) << shift << ", " << toony;
        EXPECT_GT(in_shade, 500U) << shift << ", " << toony;
    }
    RecordProperty("worst", worst);
    EXPECT_LE(worst, 2) << "of 255";
}

TEST(ToonShade, AHardStepHasTwoColoursAlone)
{
    const glm::dvec3 towards_sun = glm::normalize(glm::dvec3(1.0, 0.8, 0.4));
    Scene scene = lit_scene(shapes::sphere(1.0F, 256, 128), towards_sun);
    add_shade_texture(scene, one_color(shade_color));
    scene.materials[0].toon->shade_toony = 1.0F;
    scene.materials[0].toon->shade_shift = -0.2F;
    const Image picture = draw(scene, paint_alone());
    for (uint32_t y = 0; y < side_px; ++y) {
        for (uint32_t x = 0; x < side_px; ++x) {
            const auto normal = sphere_normal(x, y);
            const double cosine = normal ? glm::dot(*normal, towards_sun) : 0.2;
            if (std::abs(cosine - 0.2) > 0.005) {
                EXPECT_LE(difference(color_at(picture, x, y), cosine > 0.2 ? lit_color : shade_color), 1);
            }
        }
    }
}

TEST(ToonShade, TheStyleCanPutTheStepWhereTheWashHasIt)
{
    // The sun shines along the view, so all that is visible faces the sun, and the rim is darker.
    Scene scene = lit_scene(shapes::sphere(1.0F, 256, 128), {0.0, 0.0, 1.0});
    add_shade_texture(scene, one_color(shade_color));
    scene.materials[0].toon->shade_toony = 1.0F;
    const std::vector<std::string> step{"wash.shadow_from=0.5", "wash.softness=0.001", "light.ambient=0",
                                        "light.fill=0", "light.falloff=1"};
    const Image by_material = draw(scene, paint_alone(step));
    std::vector<std::string> of_wash = step;
    of_wash.emplace_back("wash.shade_step=wash");
    const Image by_wash = draw(scene, paint_alone(of_wash));
    size_t in_shade = 0;
    double most_in_shade = 0.0; // greatest cosine of incidence
    double least_lit = 1.0;
    for (uint32_t y = 0; y < side_px; ++y) {
        for (uint32_t x = 0; x < side_px; ++x) {
            if (const auto normal = sphere_normal(x, y)) {
                EXPECT_LE(difference(color_at(by_material, x, y), lit_color), 1) << "it faces the sun";
                const bool is_in_shade = difference(color_at(by_wash, x, y), shade_color) <= 1;
                in_shade += is_in_shade ? 1 : 0;
                most_in_shade = is_in_shade ? std::max(most_in_shade, normal->z) : most_in_shade;
                least_lit = is_in_shade ? least_lit : std::min(least_lit, normal->z);
            }
        }
    }
    EXPECT_GT(in_shade, 300U) << "the rim is dark enough for the wash's shade";
    EXPECT_GT(least_lit, most_in_shade - 0.1) << "one edge, which wavers a little";
    EXPECT_LE(difference(color_at(by_wash, 0.5, 0.5), lit_color), 1);
}

TEST(ToonShade, TheSecondTextureHasItsOwnUvsAndTransform)
{
    Scene scene = lit_scene(wall(), {0.0, 0.2, -1.0});
    add_shade_texture(scene, four_colors());
    ToonShade& toon = *scene.materials[0].toon;
    Image picture = draw(scene, paint_alone());
    EXPECT_LE(difference(color_at(picture, 0.1, 0.1), {255, 0, 0}), 3);
    EXPECT_LE(difference(color_at(picture, 0.9, 0.1), {0, 255, 0}), 3);
    EXPECT_LE(difference(color_at(picture, 0.1, 0.9), {0, 0, 255}), 3);
    toon.shade_texture.uv_set = 1;
    picture = draw(scene, paint_alone());
    EXPECT_LE(difference(color_at(picture, 0.1, 0.1), {0, 255, 0}), 3) << "mirrored";
    toon.shade_texture.uv_set = 0;
    toon.shade_texture.uv_transform = glm::mat3(0, 1, 0, 1, 0, 0, 0, 0, 1);
    picture = draw(scene, paint_alone());
    EXPECT_LE(difference(color_at(picture, 0.9, 0.1), {0, 0, 255}), 3) << "u and v exchanged";
    toon.shade_color = {0.0F, 0.0F, 0.5F};
    picture = draw(scene, paint_alone());
    EXPECT_LE(difference(color_at(picture, 0.9, 0.1), mixed({0, 0, 0}, {0, 0, 255}, 0.5)), 3) << "times it";
    toon.shade_color = glm::vec3(1.0F);
    picture = draw(scene, paint_alone({"wash.detail=0"}));
    // The mean of red, green, blue and yellow in linear light.
    EXPECT_LE(difference(color_at(picture, 0.9, 0.1), {188, 188, 137}), 3) << "one flat colour";
}

TEST(ToonShade, CastShadowsShowTheSecondTexture)
{
    Scene scene = lit_scene(wall(), {0.0, -1.0, 1.0});
    add_shade_texture(scene, one_color(shade_color));
    // A screen between the sun and the wall, below the lower edge of the page.
    Primitive screen = wall();
    for (glm::vec3& position : screen.positions) {
        position = {position.x, 0.5F * position.y - 1.6F, 1.0F};
    }
    test::add_object(scene, std::move(screen), glm::vec3(1.0F));
    const Image picture = draw(scene, paint_alone({"light.shadows=true"}));
    EXPECT_LE(difference(color_at(picture, 0.5, 0.1), lit_color), 1);
    EXPECT_LE(difference(color_at(picture, 0.5, 0.6), shade_color), 1);
    EXPECT_EQ(color_at(draw(scene, paint_alone()), 0.5, 0.6), color_at(picture, 0.5, 0.1)) << "no shadows";
}

TEST(ToonShade, AWallThatIsNotLinkedToTheSunIsInShade)
{
    Scene scene = lit_scene(wall(), {0.0, 0.0, 1.0});
    add_shade_texture(scene, one_color(shade_color));
    EXPECT_LE(difference(color_at(draw(scene, paint_alone()), 0.5, 0.5), lit_color), 1);
    scene.lights.at(0).groups = 1;
    scene.nodes.at(0).links.lit_by = 2;
    EXPECT_LE(difference(color_at(draw(scene, paint_alone()), 0.5, 0.5), shade_color), 1);
}

TEST(ToonShade, SortedSurfacesAreSeenThroughInTheColourOfTheShade)
{
    Scene scene = lit_scene(wall(), {0.0, 0.2, -1.0});
    add_shade_texture(scene, one_color(shade_color));
    scene.materials[0].base_color.w = 0.5F;
    scene.materials[0].alpha_mode = AlphaMode::blend;
    const Image picture = draw(scene, paint_alone({"transparency.mode=sorted"}));
    EXPECT_LE(difference(color_at(picture, 0.5, 0.5), mixed({255, 255, 255}, shade_color, 0.5)), 2);
}

/// Draws a wall that is turned away from the sun, with `assignments`.
Image draw_wall_in_shade(const std::vector<std::string>& assignments, bool has_uvs = true)
{
    Primitive primitive = wall();
    if (!has_uvs) {
        primitive.uvs = {};
    }
    return draw(lit_scene(std::move(primitive), {0.0, 0.2, -1.0}), paint_alone(assignments));
}

bool has_note(const std::string& part)
{
    return std::ranges::any_of(test::shared_renderer().notes(),
                               [&](const std::string& note) { return note.find(part) != std::string::npos; });
}

TEST(ToonShade, AStyleNamesAPictureForTheShade)
{
    const test::Folder folder;
    save_png(four_colors(), folder / "shade.png");
    const std::string path = (folder / "shade.png").string();
    Image picture = draw_wall_in_shade({"wash.shade_texture=" + path});
    EXPECT_LE(difference(color_at(picture, 0.1, 0.1), {255, 0, 0}), 3);
    EXPECT_LE(difference(color_at(picture, 0.9, 0.9), {255, 255, 0}), 3);
    picture = draw_wall_in_shade({"material.p*.wash.shade_texture=" + path});
    EXPECT_LE(difference(color_at(picture, 0.1, 0.9), {0, 0, 255}), 3) << "by material";
    EXPECT_FALSE(has_note("shade_texture"));
    picture = draw_wall_in_shade({"material.other.wash.shade_texture=" + path});
    EXPECT_FALSE(test::has_pass("surface/shade")) << "another material";

    const Image lit = draw(lit_scene(wall(), {0.0, 0.2, 1.0}), paint_alone({"wash.shade_texture=" + path}));
    EXPECT_LE(difference(color_at(lit, 0.1, 0.1), lit_color), 1) << "in the light";

    Scene turned = lit_scene(wall(), {0.0, 0.2, -1.0});
    turned.materials[0].base_color_texture.uv_transform = glm::mat3(0, 1, 0, 1, 0, 0, 0, 0, 1);
    picture = draw(turned, paint_alone({"wash.shade_texture=" + path}));
    EXPECT_LE(difference(color_at(picture, 0.9, 0.1), {0, 0, 255}), 3) << "placed like the base colour";

    Scene toon = lit_scene(wall(), {0.0, 0.2, -1.0});
    add_shade_texture(toon, one_color(shade_color));
    picture = draw(toon, paint_alone({"wash.shade_texture=" + path}));
    EXPECT_LE(difference(color_at(picture, 0.1, 0.1), {255, 0, 0}), 3) << "in place of the file's";
    picture = draw(toon, paint_alone());
    EXPECT_LE(difference(color_at(picture, 0.1, 0.1), shade_color), 1) << "the file's";
}

TEST(ToonShade, TwoPicturesOfDifferentSizesAreBothDrawn)
{
    const test::Folder folder;
    save_png(four_colors(), folder / "small.png");
    Image large{.width = 300, .height = 300};
    for (uint32_t i = 0; i < 300 * 300; ++i) {
        large.rgba.insert(large.rgba.end(), {40, 90, 200, 255});
    }
    save_png(large, folder / "large.png");
    Scene scene = lit_scene(wall(), {0.0, 0.2, -1.0});
    scene.nodes[0].transform.scale = {0.4, 1.0, 1.0};
    scene.nodes[0].transform.translation = {-0.5, 0.0, 0.0};
    const Index right = test::add_object(scene, wall(), glm::vec3(1.0F), {0.5, 0.0, 0.0});
    scene.nodes[right].name = "right";
    scene.nodes[right].transform.scale = {0.4, 1.0, 1.0};
    const Image picture =
        draw(scene, paint_alone({"material.paint.wash.shade_texture=" + (folder / "small.png").string(),
                                 "object.right.wash.shade_texture=" + (folder / "large.png").string()}));
    EXPECT_LE(difference(color_at(picture, 0.1, 0.1), {255, 0, 0}), 3);
    EXPECT_LE(difference(color_at(picture, 0.75, 0.5), {40, 90, 200}), 2);
}

std::string error_of(const std::vector<std::string>& assignments)
{
    try {
        draw_wall_in_shade(assignments);
    } catch (const Error& error) {
        return error.what();
    }
    return {};
}

TEST(ToonShade, APictureThatCannotBeReadIsNamed)
{
    const test::Folder folder;
    const std::string missing = (folder / "missing.png").string();
    EXPECT_NE(error_of({"wash.shade_texture=" + missing}).find(missing), std::string::npos);
    const std::string text = (folder / "text.png").string();
    write_file_atomically(text, std::as_bytes(std::span("no picture")));
    EXPECT_NE(error_of({"wash.shade_texture=" + text}).find(text), std::string::npos);
    EXPECT_NE(error_of({"wash.shade_texture=materal"}).find("did you mean \"material\"?"), std::string::npos);
    EXPECT_TRUE(error_of({}).empty());
}

TEST(ToonShade, APictureInAStyleFileIsFoundBesideIt)
{
    const test::Folder folder;
    save_png(one_color(shade_color), folder / "shade.png");
    const std::string words = "[wash]\nshade_texture = \"shade.png\"\n";
    write_file_atomically(folder / "style.toml", std::as_bytes(std::span(words)));
    Style style = Style::load((folder / "style.toml").string());
    EXPECT_EQ(style.text("wash.shade_texture"), (folder / "shade.png").string());
}

TEST(ToonShade, MeshesWithoutUvsAreNoted)
{
    const test::Folder folder;
    save_png(one_color(shade_color), folder / "shade.png");
    const std::string path = (folder / "shade.png").string();
    const Image with = draw_wall_in_shade({"wash.shade_texture=" + path}, false);
    EXPECT_TRUE(has_note("wash.shade_texture does not show on 1 of the scene's 1 meshes"));
    EXPECT_EQ(with.rgba, draw_wall_in_shade({}, false).rgba);
}

TEST(ToonShade, WithoutASecondTextureThereIsNoPass)
{
    Scene scene = lit_scene(shapes::sphere(1.0F), {1.0, 0.8, 0.4});
    scene.materials[0].toon = ToonShade{.shade_color = {0.5F, 0.5F, 0.5F}};
    const Image without = draw(scene, paint_alone());
    EXPECT_FALSE(test::has_pass("surface/shade"));
    EXPECT_EQ(draw(scene, paint_alone({"wash.shade_texture=none"})).rgba, without.rgba);
    EXPECT_EQ(draw(scene, paint_alone({"wash.shade_step=wash"})).rgba, without.rgba);
    add_shade_texture(scene, one_color(shade_color));
    scene.materials[0].toon->shade_color = {0.5F, 0.5F, 0.5F};
    EXPECT_NE(draw(scene, paint_alone()).rgba, without.rgba);
    EXPECT_TRUE(test::has_pass("surface/shade"));
    EXPECT_EQ(draw(scene, paint_alone({"wash.shade_texture=none"})).rgba, without.rgba);
    EXPECT_FALSE(test::has_pass("surface/shade"));
    draw(scene, paint_alone({"wash.strength=0"}));
    EXPECT_FALSE(test::has_pass("surface/shade"));
    draw(scene, Style::load("cel+two-tones"));
    EXPECT_FALSE(test::has_pass("surface/shade")) << "the second tone is grey";
}

TEST(ToonShade, FilmsAndTilesShowThePicture)
{
    Scene scene = lit_scene(shapes::sphere(1.0F), {1.0, 0.8, 0.4});
    add_shade_texture(scene, four_colors());
    Renderer& renderer = test::shared_renderer();
    renderer.set_scene(scene);
    const Style style = paint_alone({"light.shadows=true"});
    EXPECT_EQ(test::most_between_tiles(flat_camera(), style, 64), 0);
    std::vector<Camera> cameras(3, flat_camera());
    std::vector<Image> frames;
    RenderSettings film = toon_page;
    film.continuity = Continuity::starts;
    for (Camera& camera : cameras) {
        camera.eye.x += 0.3 * static_cast<double>(frames.size());
        frames.push_back(renderer.render(camera, style, film));
        film.continuity = Continuity::follows;
        film.time_s += 0.04;
    }
    for (size_t i = 0; i < cameras.size(); ++i) {
        EXPECT_EQ(frames[i].rgba, renderer.render(cameras[i], style, toon_page).rgba) << "frame " << i;
    }
    EXPECT_NE(frames[0].rgba, frames[1].rgba);
}

} // namespace
} // namespace estampe
