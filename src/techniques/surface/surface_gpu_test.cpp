// SPDX-License-Identifier: MIT
// Output of the surface pass per pixel: coordinates and their change, normals, colours.
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include <estampe/shapes.hpp>

#include "support/drawing.hpp"
#include "support/scenes.hpp"

namespace estampe::surface {
namespace {

constexpr uint32_t side_px = 96;

/// A square of 2 m in z = 0 that fills the page of `parallel_camera`, with the first row of texels on top.
Primitive wall(float least_uv = 0.0F, float greatest_uv = 1.0F)
{
    Primitive primitive;
    primitive.positions = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
    primitive.normals.assign(4, {0, 0, 1});
    primitive.uvs[0] = {
        {least_uv, greatest_uv}, {greatest_uv, greatest_uv}, {greatest_uv, least_uv}, {least_uv, least_uv}};
    primitive.indices = {0, 1, 2, 0, 2, 3};
    return primitive;
}

Camera parallel_camera()
{
    Camera camera = test::front_camera(5.0, 0.6);
    camera.orthographic_half_height_m = 1.0;
    return camera;
}

Scene textured(Primitive primitive, Image image)
{
    Scene scene = test::scene_of(std::move(primitive));
    scene.textures.push_back({.image = std::move(image)});
    scene.materials[0].base_color_texture.texture = 0;
    return scene;
}

/// An image with red and green above blue and white.
Image four_colors()
{
    return {.width = 2,
            .height = 2,
            .rgba = {255, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 255, 255, 255, 255, 255}};
}

/// The colour at a place of the page, 0 to 1 to the right and down.
glm::vec3 color_at(const test::SurfacePixels& surface, float x, float y)
{
    const auto column = static_cast<size_t>(x * side_px);
    const auto row = static_cast<size_t>(y * side_px);
    return glm::vec3(surface.color[row * side_px + column]);
}

void expect_color(const glm::vec3& actual, const glm::vec3& wanted, const std::string& what)
{
    EXPECT_LT(glm::distance(actual, wanted), 0.03F)
        << what << ": " << actual.x << ", " << actual.y << ", " << actual.z;
}

const glm::vec3 red(1, 0, 0);
const glm::vec3 green(0, 1, 0);
const glm::vec3 blue(0, 0, 1);
const glm::vec3 white(1, 1, 1);

TEST(Surface, ATextureStandsUpright)
{
    const auto surface =
        test::Drawing(textured(wall(), four_colors()), parallel_camera(), glm::uvec2(side_px)).surface();
    expect_color(color_at(surface, 0.1F, 0.1F), red, "top left");
    expect_color(color_at(surface, 0.9F, 0.1F), green, "top right");
    expect_color(color_at(surface, 0.1F, 0.9F), blue, "bottom left");
    expect_color(color_at(surface, 0.9F, 0.9F), white, "bottom right");
}

TEST(Surface, TextureTransformsMoveScaleAndTurn)
{
    Scene scene = textured(wall(), four_colors());
    glm::mat3& transform = scene.materials[0].base_color_texture.uv_transform;
    transform = glm::mat3(1, 0, 0, 0, 1, 0, 0.5F, 0, 1);
    auto surface = test::Drawing(scene, parallel_camera(), glm::uvec2(side_px)).surface();
    expect_color(color_at(surface, 0.4F, 0.1F), green, "moved by half");
    transform = glm::mat3(2, 0, 0, 0, 1, 0, 0, 0, 1);
    surface = test::Drawing(scene, parallel_camera(), glm::uvec2(side_px)).surface();
    expect_color(color_at(surface, 0.45F, 0.1F), green, "twice as often");
    expect_color(color_at(surface, 0.55F, 0.1F), red, "twice as often");
    transform = glm::mat3(0, 1, 0, 1, 0, 0, 0, 0, 1);
    surface = test::Drawing(scene, parallel_camera(), glm::uvec2(side_px)).surface();
    expect_color(color_at(surface, 0.9F, 0.1F), blue, "u and v exchanged");
}

TEST(Surface, TheSecondUvSetIsTakenWhenAskedFor)
{
    Primitive primitive = wall();
    primitive.uvs[1] = {{1, 1}, {0, 1}, {0, 0}, {1, 0}};
    Scene scene = textured(std::move(primitive), four_colors());
    scene.materials[0].base_color_texture.uv_set = 1;
    const auto surface = test::Drawing(scene, parallel_camera(), glm::uvec2(side_px)).surface();
    expect_color(color_at(surface, 0.1F, 0.1F), green, "mirrored");
}

TEST(Surface, TexturesOfAnySizeAreStretchedToTheirClass)
{
    for (const auto& [width, height] :
         {std::pair(300U, 200U), std::pair(7U, 1000U), std::pair(1U, 1U), std::pair(512U, 512U)}) {
        Image image{.width = width, .height = height};
        for (uint32_t y = 0; y < height; ++y) {
            for (uint32_t x = 0; x < width; ++x) {
                const auto shade = static_cast<uint8_t>((255.0F * (static_cast<float>(y) + 0.5F)) /
                                                        static_cast<float>(height));
                image.rgba.insert(image.rgba.end(),
                                  {shade, static_cast<uint8_t>(x < width / 2 ? 0 : 255), 0, 255});
            }
        }
        const auto surface =
            test::Drawing(textured(wall(), image), parallel_camera(), glm::uvec2(side_px)).surface();
        for (const float y : {0.25F, 0.5F, 0.75F}) {
            const float encoded = height > 1 ? y : 0.5F;
            const float shade = std::pow((encoded + 0.055F) / 1.055F, 2.4F);
            EXPECT_NEAR(color_at(surface, 0.9F, y).x, shade, 0.02F)
                << width << " x " << height << " at " << y;
        }
        EXPECT_GT(color_at(surface, 0.9F, 0.5F).y, 0.95F);
        EXPECT_TRUE(width == 1 || color_at(surface, 0.1F, 0.5F).y < 0.05F);
    }
}

TEST(Surface, WrapModesHoldBeyondTheTexture)
{
    Scene scene = textured(wall(-1.0F, 2.0F), four_colors());
    // Reads the top row of texels of the middle copy; a sixth of the page is half a copy.
    const auto color_of = [&](Wrap wrap, float u) {
        scene.textures[0].wrap_u = wrap;
        const auto surface = test::Drawing(scene, parallel_camera(), glm::uvec2(side_px)).surface();
        return color_at(surface, (u + 1.0F) / 3.0F, (0.1F + 1.0F) / 3.0F);
    };
    expect_color(color_of(Wrap::repeat, 1.1F), red, "repeat right");
    expect_color(color_of(Wrap::repeat, -0.1F), green, "repeat left");
    expect_color(color_of(Wrap::mirror, 1.1F), green, "mirror right");
    expect_color(color_of(Wrap::mirror, -0.1F), red, "mirror left");
    expect_color(color_of(Wrap::mirror, 1.9F), red, "mirror far right");
    expect_color(color_of(Wrap::clamp, 1.6F), green, "clamp right");
    expect_color(color_of(Wrap::clamp, -0.6F), red, "clamp left");
    for (const float u : {0.99F, 1.01F}) {
        expect_color(color_of(Wrap::mirror, u), green, "mirror at the seam");
        expect_color(color_of(Wrap::clamp, u), green, "clamp at the seam");
    }
}

TEST(Surface, OcclusionTexturesSayHowMuchLightGetsBy)
{
    // Only the red channel counts: 0.4 on the left and 1 on the right; green and blue differ.
    Primitive primitive = wall();
    primitive.uvs[1] = {{1, 1}, {0, 1}, {0, 0}, {1, 0}};
    Scene scene = test::scene_of(std::move(primitive));
    Image image{.width = texture_class_px[0], .height = 1};
    for (uint32_t x = 0; x < image.width; ++x) {
        const bool left = x < image.width / 2;
        image.rgba.insert(image.rgba.end(), {static_cast<uint8_t>(left ? 102 : 255),
                                             static_cast<uint8_t>(left ? 255 : 0), 51, 255});
    }
    scene.textures.push_back({.image = std::move(image)});
    Material& material = scene.materials[0];
    material.occlusion_texture.texture = 0;
    const auto open_at = [&](float x) {
        const auto surface = test::Drawing(scene, parallel_camera(), glm::uvec2(side_px)).surface();
        expect_color(color_at(surface, x, 0.5F), glm::vec3(material.base_color), "colour stays");
        return surface.color[(side_px / 2) * side_px + static_cast<size_t>(x * side_px)].w;
    };
    EXPECT_NEAR(open_at(0.1F), 0.4F, 0.01F);
    EXPECT_NEAR(open_at(0.9F), 1.0F, 0.01F);
    material.occlusion_strength = 0.5F;
    EXPECT_NEAR(open_at(0.1F), 0.7F, 0.01F);
    material.occlusion_texture.uv_set = 1;
    EXPECT_NEAR(open_at(0.9F), 0.7F, 0.01F) << "the second UVs are mirrored";
    material.unlit = true;
    EXPECT_EQ(open_at(0.9F), 1.0F) << "what is unlit is not shaded either";
    material.unlit = false;
    material.occlusion_strength = 0.0F;
    EXPECT_EQ(open_at(0.9F), 1.0F);
    const TexturePlan plan = plan_textures(scene, 256);
    EXPECT_FALSE(scene_needs(scene, plan).occlusion);
    EXPECT_TRUE(plan.layers[0].empty()) << "nor uploaded";
}

TEST(Surface, VertexColorsTintTheMaterial)
{
    Primitive primitive = wall();
    primitive.colors.assign(4, {0.25F, 0.5F, 1.0F, 1.0F});
    Scene scene = test::scene_of(std::move(primitive));
    scene.materials[0].base_color = {1.0F, 0.5F, 0.25F, 1.0F};
    const auto surface = test::Drawing(scene, parallel_camera(), glm::uvec2(side_px)).surface();
    expect_color(color_at(surface, 0.3F, 0.6F), {0.25F, 0.25F, 0.25F}, "tinted");
}

TEST(Surface, NormalMapsTiltTheWayTheyPoint)
{
    const auto tilted = [](std::vector<glm::vec2> uvs, uint8_t x, uint8_t y) {
        Primitive primitive = wall();
        primitive.uvs[0] = std::move(uvs);
        Scene scene = test::scene_of(std::move(primitive));
        scene.textures.push_back({.image = {.width = 1, .height = 1, .rgba = {x, y, 230, 255}}});
        scene.materials[0].normal_texture.texture = 0;
        const auto surface = test::Drawing(scene, parallel_camera(), glm::uvec2(side_px)).surface();
        EXPECT_GT(surface.smooth_normal[side_px * 20 + 70].z, 0.999F);
        return surface.shading_normal[side_px * 20 + 70];
    };
    const std::vector<glm::vec2> upright{{0, 1}, {1, 1}, {1, 0}, {0, 0}};
    const std::vector<glm::vec2> mirrored{{1, 1}, {0, 1}, {0, 0}, {1, 0}};
    const std::vector<glm::vec2> quarter_turn{
        {1, 1}, {1, 0}, {0, 0}, {0, 1}}; // u runs down the page, v to the left
    const auto expect_normal = [](const glm::vec3& actual, const glm::vec3& wanted, const char* what) {
        EXPECT_LT(glm::distance(actual, wanted), 0.02F)
            << what << ": " << actual.x << ", " << actual.y << ", " << actual.z;
    };
    expect_normal(tilted(upright, 204, 128), {0.6F, 0.0F, 0.8F}, "+x is to the right of the texture");
    expect_normal(tilted(upright, 128, 204), {0.0F, 0.6F, 0.8F}, "+y is up the texture");
    expect_normal(tilted(mirrored, 204, 128), {-0.6F, 0.0F, 0.8F}, "mirrored +x");
    expect_normal(tilted(mirrored, 128, 204), {0.0F, 0.6F, 0.8F}, "mirrored +y");
    expect_normal(tilted(quarter_turn, 204, 128), {0.0F, -0.6F, 0.8F}, "turned +x");
    expect_normal(tilted(quarter_turn, 128, 204), {0.6F, 0.0F, 0.8F}, "turned +y");
}

TEST(Surface, ASphereHasItsNormals)
{
    test::Drawing drawing(test::scene_of(shapes::sphere(1.0F, 128, 64)), test::front_camera(4.0, 0.6),
                          glm::uvec2(side_px));
    const auto surface = drawing.surface();
    size_t seen = 0;
    for (size_t i = 0; i < surface.depth.size(); ++i) {
        if (surface.depth[i] <= 0.0F) {
            EXPECT_EQ(surface.draw[i], 0U);
            continue;
        }
        ++seen;
        const glm::dvec3 point =
            drawing.point_at({static_cast<double>(i % side_px) + 0.5, static_cast<double>(i / side_px) + 0.5},
                             static_cast<double>(surface.depth[i]));
        EXPECT_LT(glm::distance(glm::dvec3(surface.smooth_normal[i]), glm::normalize(point)), 0.03);
        EXPECT_EQ(surface.shading_normal[i], surface.smooth_normal[i]);
    }
    EXPECT_GT(seen, 2000U);
}

TEST(Surface, ABackThatIsSeenFacesTheEye)
{
    Camera behind = parallel_camera();
    behind.eye.z = -behind.eye.z;
    const auto surface = test::Drawing(test::scene_of(wall()), behind, glm::uvec2(side_px)).surface();
    EXPECT_LT(surface.smooth_normal[side_px * 40 + 40].z, -0.999F);
}

struct Plane {
    glm::dvec3 corner[3];
    glm::dvec3 value[3];
};

/// Value of the plane's linear function at the point where the ray through a place of the page meets the
/// plane.
glm::dvec3 value_at(const test::Drawing& drawing, const Plane& plane, glm::dvec2 position_px)
{
    const glm::dvec3 from = drawing.point_at(position_px, 0.9);
    const glm::dvec3 way = drawing.point_at(position_px, 0.1) - from;
    const glm::dvec3 e1 = plane.corner[1] - plane.corner[0];
    const glm::dvec3 e2 = plane.corner[2] - plane.corner[0];
    const glm::dvec3 solved = glm::inverse(glm::dmat3(e1, e2, -way)) * (from - plane.corner[0]);
    return plane.value[0] + solved.x * (plane.value[1] - plane.value[0]) +
           solved.y * (plane.value[2] - plane.value[0]);
}

void expect_coordinates(const Scene& scene, const Camera& camera, bool follows_uv)
{
    test::Drawing drawing(scene, camera, {120, 80});
    const auto surface = drawing.surface();
    const auto page = drawing.visibility();
    const auto posed = drawing.posed();
    const auto& uvs = scene.meshes[0].primitives[0].uvs[0];
    double worst_value = 0.0;
    double worst_change = 0.0;
    size_t looked_at = 0;
    for (size_t i = 0; i < page.size(); ++i) {
        if (page[i] == 0) {
            continue;
        }
        ++looked_at;
        const glm::uvec4 corners = drawing.layout.triangles[static_cast<uint32_t>(page[i])];
        Plane plane{};
        for (int k = 0; k < 3; ++k) {
            plane.corner[k] = glm::dvec3(posed[corners[k]].position);
            plane.value[k] = follows_uv ? glm::dvec3(uvs[corners[k]], 0.0)
                                        : plane.corner[k] / drawing.layout.stroke_unit_m;
        }
        const glm::dvec2 centre(static_cast<double>(i % 120) + 0.5, static_cast<double>(i / 120) + 0.5);
        constexpr double h = 1e-3;
        const glm::dvec3 dx = (value_at(drawing, plane, centre + glm::dvec2(h, 0)) -
                               value_at(drawing, plane, centre - glm::dvec2(h, 0))) /
                              (2.0 * h);
        const glm::dvec3 dy = (value_at(drawing, plane, centre + glm::dvec2(0, h)) -
                               value_at(drawing, plane, centre - glm::dvec2(0, h))) /
                              (2.0 * h);
        const double scale = std::max(glm::length(dx), glm::length(dy));
        worst_value = std::max(
            worst_value,
            glm::distance(value_at(drawing, plane, centre), glm::dvec3(surface.coordinate[i])) / scale);
        worst_change = std::max({worst_change, glm::distance(dx, glm::dvec3(surface.footprint_dx[i])) / scale,
                                 glm::distance(dy, glm::dvec3(surface.footprint_dy[i])) / scale});
    }
    EXPECT_GT(looked_at, 1000U);
    EXPECT_LT(worst_value, 0.02) << "pixels";
    EXPECT_LT(worst_change, 1e-3);
}

TEST(Surface, CoordinatesAndTheirChangeAreThoseOfThePlane)
{
    const Camera near{.eye = {1.5, 1.2, 3.0}, .vertical_fov_rad = 0.9};
    const Camera grazing{.eye = {0.2, 0.15, 3.0}, .target = {0.0, 0.1, 0.0}};
    Camera parallel = near;
    parallel.orthographic_half_height_m = 1.2;
    Scene column = test::scene_of(shapes::cylinder(1.0F, 1.5F, 24));
    column.meshes[0].primitives[0].uvs[0].clear();
    for (const Camera& camera : {near, parallel}) {
        expect_coordinates(column, camera, false);
        expect_coordinates(test::scene_of(wall()), camera, true);
    }
    expect_coordinates(test::scene_of(shapes::plane(40.0F, 40.0F)), grazing, true);
}

} // namespace
} // namespace estampe::surface
