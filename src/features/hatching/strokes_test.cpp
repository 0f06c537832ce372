// SPDX-License-Identifier: MIT
#include "features/hatching/hatching.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <estampe/shapes.hpp>

#include "shaders/stroke_kind.glsl.h"
#include "support/scenes.hpp"

namespace estampe::features {
namespace {

/// A ball with UVs and the material "Skin", a ball without UVs and the material "Sea", and the ground.
Scene two_balls()
{
    Scene scene;
    for (const char* name : {"Skin", "Sea"}) {
        Primitive ball = shapes::sphere(1.0F, 8, 6);
        if (std::string(name) == "Sea") {
            ball.uvs[0].clear();
        }
        test::add_object(scene, std::move(ball), glm::vec3(1.0F));
        scene.materials.back().name = name;
    }
    return scene;
}

class Strokes : public testing::Test {
protected:
    /// `own` overrides the stroke coordinates of the material Sea.
    [[nodiscard]] StyleVariants styles(hatch::Coordinates coordinates, const char* own = nullptr) const
    {
        StyleTables style;
        style.hatch.coordinates = coordinates;
        if (own != nullptr) {
            style_schema().set(style, fmt::format("material.Sea.hatch.coordinates={}", own));
        }
        return style_variants(meshes_, scene_, style);
    }

    [[nodiscard]] std::vector<uint32_t> kinds(hatch::Coordinates coordinates, const char* own = nullptr) const
    {
        return plan_strokes(meshes_, styles(coordinates, own)).kind_of_draw;
    }

    Scene scene_ = two_balls();
    pose::MeshData meshes_ = pose::build_meshes(scene_, static_cast<Index>(scene_.materials.size()));
};

TEST_F(Strokes, FollowUvsOnlyWhereThereAreAny)
{
    using Kinds = std::vector<uint32_t>;
    EXPECT_EQ(kinds(hatch::Coordinates::uv),
              (Kinds{shared::strokes_uv, shared::strokes_solid, shared::strokes_solid}));
    EXPECT_EQ(kinds(hatch::Coordinates::form),
              (Kinds{shared::strokes_form, shared::strokes_form, shared::strokes_solid}));
    EXPECT_EQ(kinds(hatch::Coordinates::light),
              (Kinds{shared::strokes_light, shared::strokes_light, shared::strokes_light}));
}

TEST_F(Strokes, FollowTheFormOfRoundBodiesByThemselves)
{
    using Kinds = std::vector<uint32_t>;
    EXPECT_EQ(kinds(hatch::Coordinates::automatic),
              (Kinds{shared::strokes_form, shared::strokes_form, shared::strokes_solid}));
    StyleVariants dots = styles(hatch::Coordinates::automatic);
    dots.styles.front().hatch.strokes = hatch::Strokes::dots;
    EXPECT_EQ(plan_strokes(meshes_, dots).kind_of_draw[1], shared::strokes_solid);
    pose::MeshData many = meshes_;
    many.draws[0].vertex_count = 1'000'000; // coordinates along the form would take many seconds
    EXPECT_EQ(plan_strokes(many, styles(hatch::Coordinates::automatic)).kind_of_draw,
              (Kinds{shared::strokes_solid, shared::strokes_form, shared::strokes_solid}));
}

TEST_F(Strokes, OfSingleMaterialsGoTheirOwnWay)
{
    EXPECT_EQ(kinds(hatch::Coordinates::form, "wind"),
              (std::vector<uint32_t>{shared::strokes_form, shared::strokes_wind, shared::strokes_solid}));
}

TEST_F(Strokes, AlongTheFormHaveCoordinatesForTheirTrianglesAlone)
{
    const StrokePlan plan = plan_strokes(meshes_, styles(hatch::Coordinates::solid, "form"));
    const std::vector<glm::vec2> coordinates = form_coordinates(meshes_, plan);
    ASSERT_EQ(coordinates.size(), 3 * meshes_.triangles.size());
    for (size_t i = 0; i < meshes_.triangles.size(); ++i) {
        const uint32_t draw = meshes_.triangles[i].w & shared::triangle_draw_mask;
        const bool any = coordinates[3 * i] != glm::vec2(0.0F) || coordinates[3 * i + 1] != glm::vec2(0.0F);
        EXPECT_EQ(any, draw == 1) << "triangle " << i;
    }
}

} // namespace
} // namespace estampe::features
