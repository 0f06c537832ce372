// SPDX-License-Identifier: MIT
// Renders demons.
#include "temple/world.hpp"

#include <algorithm>

#include <gtest/gtest.h>

#include "support/gpu_device.hpp"

namespace temple {
namespace {

constexpr estampe::RenderSettings small{.width = 144, .height = 96};

/// A scene with only demons, on a white page.
struct Stage {
    /// All demons except one have dissolved.
    explicit Stage(size_t kept) : demons(plan, make_site(1), make_desert(plan, 1), 1)
    {
        for (size_t i = 0; i < demons.all().size(); ++i) {
            if (i != kept) {
                demons.dissolve(i);
            }
        }
        demons.step(6.0, glm::dvec3(1e4), {});
        scene.materials.emplace_back();
        demons.add_to(scene);
        estampe::test::shared_renderer().set_scene(scene);
        style.set("picture.ground=false");
        style.set("hatch.enabled=false");
        style.set("material.demon*.wash.strength=1");
        style.set("material.demon*.wash.neutral=1");
        style.set("material.demon*.wash.least=0");
    }

    /// Number and centre of the dark pixels on the page.
    struct Dark {
        size_t count = 0;
        glm::dvec2 middle_px{0.0};
        bool has_pale_within = false;
    };

    Dark draw(double time_s, const estampe::Camera& camera)
    {
        estampe::Renderer& renderer = estampe::test::shared_renderer();
        renderer.place(demons.places(0), time_s);
        estampe::RenderSettings settings = small;
        settings.time_s = time_s;
        const estampe::Image image = renderer.render(camera, style, settings);
        Dark dark;
        const auto value = [&](uint32_t x, uint32_t y) {
            return image.rgba[4 * (size_t{y} * image.width + x)];
        };
        for (uint32_t y = 0; y < image.height; ++y) {
            bool was_dark = false;
            bool was_pale_after = false;
            for (uint32_t x = 0; x < image.width; ++x) {
                const bool is_dark = value(x, y) < 60;
                dark.count += is_dark ? 1 : 0;
                dark.middle_px += is_dark ? glm::dvec2(x, y) : glm::dvec2(0.0);
                dark.has_pale_within = dark.has_pale_within || (is_dark && was_pale_after && y < 60);
                was_pale_after = was_dark && !is_dark ? value(x, y) > 120 : was_pale_after && !is_dark;
                was_dark = is_dark;
            }
        }
        dark.middle_px /= std::max<double>(static_cast<double>(dark.count), 1.0);
        return dark;
    }

    /// A camera in front of a demon's face, at a distance.
    [[nodiscard]] estampe::Camera before(size_t demon, double away_m) const
    {
        const glm::dvec3 head(demons.all()[demon].head());
        const auto yaw = static_cast<double>(demons.all()[demon].yaw_rad());
        return {.eye = head + away_m * glm::dvec3(std::sin(yaw), 0.0, std::cos(yaw)),
                .target = head - glm::dvec3(0.0, 0.7, 0.0),
                .vertical_fov_rad = 0.7};
    }

    const Plan plan = make_plan(1);
    Demons demons;
    estampe::Scene scene;
    estampe::Style style;
};

TEST(DemonPictures, ShowThemWhereTheyAreWithTwoEyes)
{
    for (const size_t demon : {size_t{0}, size_t{8}}) {
        Stage stage(demon);
        const Stage::Dark seen = stage.draw(2.0, stage.before(demon, 4.5));
        EXPECT_GT(seen.count, 600U);
        EXPECT_LT(seen.count, 8000U);
        EXPECT_NEAR(seen.middle_px.x, 72.0, 12.0);
        EXPECT_NEAR(seen.middle_px.y, 50.0, 14.0);
        EXPECT_TRUE(seen.has_pale_within);
        estampe::Camera beside = stage.before(demon, 4.5);
        beside.target = 2.0 * beside.eye - beside.target;
        EXPECT_LT(stage.draw(2.0, beside).count, 8U) << "behind the eye there is none";
    }
}

TEST(DemonPictures, MoveAndAreGoneWhenTheyHaveDissolved)
{
    constexpr size_t demon = 8;
    Stage stage(demon);
    const estampe::Camera camera = stage.before(demon, 9.0);
    const Stage::Dark before = stage.draw(2.0, camera);
    const glm::vec3 head = stage.demons.all()[demon].head();
    double time_s = 2.0;
    const glm::dvec3 ahead = camera.target - camera.eye;
    const glm::dvec3 aside = glm::normalize(glm::cross(ahead, glm::dvec3(0.0, 1.0, 0.0)));
    const auto gone_aside_m = [&] {
        return std::abs(glm::dot(aside, glm::dvec3(stage.demons.all()[demon].head() - head)));
    };
    while (gone_aside_m() < 0.7 && time_s < 90.0) {
        stage.demons.step(0.5, glm::dvec3(1e4), {});
        time_s += 0.5;
    }
    const Stage::Dark after = stage.draw(time_s, camera);
    EXPECT_GT(glm::distance(before.middle_px, after.middle_px), 2.0);
    stage.demons.dissolve(demon);
    stage.demons.step(0.6 * static_cast<double>(Demon::dissolves_s), glm::dvec3(1e4), {});
    const Stage::Dark dissolving = stage.draw(time_s + 3.0, camera);
    EXPECT_LT(dissolving.count, after.count);
    stage.demons.step(3.0, glm::dvec3(1e4), {});
    EXPECT_LT(stage.draw(time_s + 6.0, camera).count, 8U);
}

} // namespace
} // namespace temple
