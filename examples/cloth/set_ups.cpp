// SPDX-License-Identifier: MIT
#include "set_ups.hpp"

#include <cmath>
#include <map>
#include <numbers>

#include <estampe/error.hpp>

#include "kit.hpp"
#include "walker.hpp"

namespace {

using namespace estampe; // NOLINT(google-build-using-namespace): this whole file uses one library

struct Making {
    ClothScene set_up;
    float finer = 1.0F;

    [[nodiscard]] Scene& scene() { return set_up.scene; }

    [[nodiscard]] glm::uvec2 particles(uint32_t x, uint32_t y) const
    {
        return glm::uvec2(glm::round(finer * (glm::vec2(x, y) - 1.0F))) + 1U;
    }

    void seen(glm::dvec3 eye, glm::dvec3 target, double fov_rad = 0.5)
    {
        set_up.camera = {.eye = eye, .target = target, .vertical_fov_rad = fov_rad};
    }

    void wind(float speed_m_per_s, float towards_deg)
    {
        set_up.style.push_back("wind.speed_m_per_s=" + std::to_string(speed_m_per_s));
        set_up.style.push_back("wind.towards_deg=" + std::to_string(towards_deg));
    }
};

float held_left(glm::vec2 share)
{
    return share.x == 0.0F ? 1.0F : 0.0F;
}

float held_above(glm::vec2 share)
{
    return share.y == 0.0F ? 1.0F : 0.0F;
}

/// Holds a sheet by `count` hooks along its upper edge.
kit::Hold hooks(float count, float particles)
{
    return [=](glm::vec2 share) {
        const float along = share.x * (count - 1.0F);
        const bool is_near = std::abs(along - std::round(along)) < 0.5F * (count - 1.0F) / (particles - 1.0F);
        return share.y == 0.0F && is_near ? 1.0F : 0.0F;
    };
}

void column(Scene& scene, glm::dvec3 foot_m, float radius_m, float height_m)
{
    const float r = radius_m;
    kit::add(scene, "column",
             kit::turned({{1.5F * r, 0.0F},
                          {1.5F * r, 0.5F * r},
                          {r, r},
                          {0.85F * r, height_m - r},
                          {1.4F * r, height_m - 0.5F * r},
                          {1.4F * r, height_m}}),
             foot_m, ClothCollider::cylinder);
}

void flag(Making& m)
{
    kit::add(m.scene(), "pole",
             kit::turned({{0.05F, 0.0F}, {0.035F, 4.1F}, {0.07F, 4.15F}, {0.0F, 4.25F}}, 16), {});
    kit::add(m.scene(), "plinth", kit::block({0.5F, 0.15F, 0.5F}), {0.0, 0.15, 0.0});
    kit::add_sheet(m.scene(), m.particles(49, 33), {0.04, 4.0, 0.0}, {2.1F, 0.0F, 0.0F}, {0.0F, -1.4F, 0.0F},
                   held_left);
    m.wind(7.0F, 78.0F);
    m.seen({2.2, 2.3, 9.0}, {0.75, 2.1, 0.0});
}

void banner(Making& m)
{
    for (const double x : {-1.8, 1.8}) {
        column(m.scene(), {x, 0.0, 0.0}, 0.22F, 4.0F);
    }
    kit::add(m.scene(), "rope", kit::block({1.6F, 0.012F, 0.012F}), {0.0, 3.2, 0.0});
    kit::add_sheet(m.scene(), m.particles(57, 33), {-1.3, 3.19, 0.0}, {2.6F, 0.0F, 0.0F}, {0.0F, -1.5F, 0.0F},
                   hooks(4.0F, m.finer * 56.0F + 1.0F));
    m.wind(2.0F, 30.0F);
    m.seen({-3.6, 2.2, 9.0}, {0.2, 1.8, 0.0});
}

void curtain(Making& m)
{
    Primitive rod = kit::block({1.25F, 0.025F, 0.025F});
    kit::add(m.scene(), "rod", std::move(rod), {0.0, 2.5, 0.0});
    for (const double x : {-1.2, 1.2}) {
        kit::add(m.scene(), "post", kit::turned({{0.04F, 0.0F}, {0.04F, 2.55F}}, 14), {x, 0.0, 0.0});
    }
    // The cloth between two hooks is wider than their distance, so the cloth falls in folds.
    const auto node = kit::add_sheet(m.scene(), m.particles(65, 49), {-1.05, 2.47, 0.0}, {2.1F, 0.0F, 0.0F},
                                     {0.0F, -2.3F, 0.0F}, hooks(9.0F, m.finer * 64.0F + 1.0F));
    auto& positions = m.scene().meshes[m.scene().nodes[node].mesh].primitives[0].positions;
    for (glm::vec3& place : positions) { // the cloth starts in waves
        place.z += 0.07F * std::sin(place.x * 8.0F * std::numbers::pi_v<float> / 2.1F * 2.0F);
    }
    m.wind(1.2F, 10.0F);
    m.seen({2.2, 1.9, 6.2}, {0.0, 1.3, 0.0});
}

void sail(Making& m)
{
    kit::add(m.scene(), "mast", kit::turned({{0.07F, 0.0F}, {0.03F, 4.6F}}, 16), {});
    kit::add(m.scene(), "boom", kit::block({1.35F, 0.035F, 0.035F}), {1.3, 0.75, 0.0});
    kit::add(m.scene(), "yard", kit::block({1.0F, 0.03F, 0.03F}), {0.95, 4.3, 0.0});
    kit::add_sheet(m.scene(), m.particles(37, 53), {0.07, 4.25, 0.0}, {1.8F, 0.0F, 0.0F}, {0.0F, -3.4F, 0.0F},
                   [](glm::vec2 share) {
                       return share.x == 0.0F || share.y == 0.0F || (share.y == 1.0F && share.x == 1.0F)
                                  ? 1.0F
                                  : 0.0F;
                   });
    m.wind(4.0F, 15.0F);
    m.seen({6.2, 2.2, 8.6}, {0.9, 2.45, 0.0});
}

void round_table(Making& m)
{
    kit::add(m.scene(), "top", kit::turned({{0.6F, 0.0F}, {0.6F, 0.04F}}, 40), {0.0, 0.75, 0.0},
             ClothCollider::cylinder);
    kit::add(m.scene(), "foot", kit::turned({{0.3F, 0.0F}, {0.06F, 0.1F}, {0.05F, 0.75F}}, 20), {});
    kit::add_sheet(m.scene(), m.particles(61, 61), {-0.95, 0.82, -0.95}, {1.9F, 0.0F, 0.0F},
                   {0.0F, 0.0F, 1.9F}, {}, {.density_kg_m2 = 0.25F});
    m.wind(0.0F, 0.0F);
    m.seen({1.6, 2.0, 3.4}, {0.0, 0.45, 0.0}, 0.5);
}

void square_table(Making& m)
{
    kit::add(m.scene(), "top", kit::block({0.75F, 0.03F, 0.45F}), {0.0, 0.75, 0.0}, ClothCollider::box);
    for (const double x : {-0.65, 0.65}) {
        for (const double z : {-0.35, 0.35}) {
            kit::add(m.scene(), "leg", kit::block({0.035F, 0.36F, 0.035F}), {x, 0.36, z});
        }
    }
    kit::add_sheet(m.scene(), m.particles(65, 49), {-1.1, 0.82, -0.8}, {2.2F, 0.0F, 0.0F}, {0.0F, 0.0F, 1.6F},
                   {});
    m.wind(0.0F, 0.0F);
    m.seen({1.9, 1.9, 3.6}, {0.0, 0.45, 0.0}, 0.5);
}

Index ball(Making& m, glm::dvec3 centre_m, float radius_m)
{
    std::vector<glm::vec2> rings;
    for (int i = 1; i < 24; ++i) {
        const float angle = std::numbers::pi_v<float> * static_cast<float>(i) / 24.0F;
        rings.emplace_back(radius_m * std::sin(angle), -radius_m * std::cos(angle));
    }
    return kit::add(m.scene(), "ball", kit::turned(rings, 40), centre_m, ClothCollider::ellipsoid);
}

void over_ball(Making& m)
{
    ball(m, {0.0, 0.6, 0.0}, 0.5F);
    kit::add_sheet(m.scene(), m.particles(61, 61), {-0.85, 1.13, -0.85}, {1.7F, 0.0F, 0.0F},
                   {0.0F, 0.0F, 1.7F}, {});
    m.wind(0.0F, 0.0F);
    m.seen({1.4, 1.9, 3.4}, {0.0, 0.5, 0.0}, 0.5);
}

void spinning_ball(Making& m)
{
    const Index node = ball(m, {0.0, 0.9, 0.0}, 0.5F);
    kit::add(m.scene(), "post", kit::turned({{0.3F, 0.0F}, {0.08F, 0.1F}, {0.06F, 0.5F}}, 20), {});
    AnimationChannel turn{.node = node, .path = AnimatedPath::rotation};
    for (int i = 0; i <= 64; ++i) {
        const float angle = 0.5F * static_cast<float>(i) * 0.7F; // half of the rotation, for a quaternion
        turn.times_s.push_back(static_cast<float>(i) * 0.1F);
        for (const float part : {0.0F, std::sin(angle), 0.0F, std::cos(angle)}) {
            turn.values.push_back(part);
        }
    }
    m.scene().animations.push_back({.name = "turn", .channels = {turn}, .duration_s = 6.4F});
    kit::add_sheet(m.scene(), m.particles(45, 45), {-0.75, 1.43, -0.75}, {1.5F, 0.0F, 0.0F},
                   {0.0F, 0.0F, 1.5F}, {}, {.friction = 1.2F});
    m.wind(0.0F, 0.0F);
    m.seen({1.4, 2.2, 3.6}, {0.0, 0.8, 0.0}, 0.5);
}

void washing(Making& m)
{
    for (const double x : {-2.2, 2.2}) {
        kit::add(m.scene(), "post", kit::turned({{0.06F, 0.0F}, {0.05F, 2.3F}}, 14), {x, 0.0, 0.0});
    }
    kit::add(m.scene(), "line", kit::block({2.2F, 0.008F, 0.008F}), {0.0, 2.2, 0.0});
    const float widths_m[] = {1.1F, 0.8F, 1.3F};
    double x = -1.9;
    for (const float width_m : widths_m) {
        kit::add_sheet(m.scene(), m.particles(33, 33), {x, 2.19, 0.0}, {width_m, 0.0F, 0.0F},
                       {0.0F, -1.2F, 0.0F}, hooks(3.0F, m.finer * 32.0F + 1.0F));
        x += width_m + 0.2;
    }
    m.wind(2.2F, 25.0F);
    m.seen({3.4, 1.8, 6.8}, {0.0, 1.35, 0.0});
}

void hammock(Making& m)
{
    for (const double x : {-1.5, 1.5}) {
        kit::add(m.scene(), "post", kit::turned({{0.09F, 0.0F}, {0.07F, 1.9F}}, 16), {x, 0.0, 0.0});
    }
    const Index node = ball(m, {0.0, 2.0, 0.0}, 0.28F);
    AnimationChannel fall{.node = node, .path = AnimatedPath::translation};
    fall.times_s = {0.0F, 0.6F, 100.0F};
    fall.values = {0.0F, 2.1F, 0.0F, 0.0F, 1.3F, 0.0F, 0.0F, 1.3F, 0.0F};
    m.scene().animations.push_back({.name = "fall", .channels = {fall}, .duration_s = 100.0F});
    const Index sling = kit::add_sheet(
        m.scene(), m.particles(61, 25), {-1.42, 1.55, -0.45}, {2.84F, 0.0F, 0.0F}, {0.0F, 0.0F, 0.9F},
        [](glm::vec2 share) { return share.x == 0.0F || share.x == 1.0F ? 1.0F : 0.0F; });
    // The sling is as long as the path around the ball. A sling pulled straight between the posts could not
    // yield.
    for (glm::vec3& place : m.scene().meshes[m.scene().nodes[sling].mesh].primitives[0].positions) {
        const float along = place.x / 1.42F - 1.0F;
        place.y -= 0.52F * (1.0F - along * along);
    }
    m.wind(0.0F, 0.0F);
    m.seen({1.4, 2.3, 5.6}, {0.0, 1.05, 0.0}, 0.5);
}

void steps(Making& m)
{
    for (int i = 0; i < 4; ++i) {
        const double height_m = 0.2 * (4 - i);
        kit::add(m.scene(), "step", kit::block({0.9F, static_cast<float>(0.5 * height_m), 0.2F}),
                 {0.0, 0.5 * height_m, -0.6 + 0.4 * i}, ClothCollider::box);
    }
    kit::add_sheet(m.scene(), m.particles(41, 73), {-0.55, 0.95, -0.75}, {1.1F, 0.0F, 0.0F},
                   {0.0F, 0.0F, 2.1F}, {}, {.friction = 0.9F});
    m.wind(0.0F, 0.0F);
    m.seen({2.6, 2.1, 3.6}, {0.0, 0.35, 0.1}, 0.5);
}

void awning(Making& m)
{
    kit::add(m.scene(), "wall", kit::block({1.6F, 1.5F, 0.1F}), {0.0, 1.5, -0.1}, ClothCollider::box);
    for (const double x : {-1.2, 1.2}) {
        kit::add(m.scene(), "post", kit::turned({{0.035F, 0.0F}, {0.03F, 1.95F}}, 14), {x, 0.0, 1.4});
    }
    kit::add_sheet(m.scene(), m.particles(49, 33), {-1.2, 2.6, 0.02}, {2.4F, 0.0F, 0.0F},
                   {0.0F, -0.6F, 1.42F}, [](glm::vec2 share) {
                       return share.y == 0.0F || (share.y > 0.97F && (share.x == 0.0F || share.x == 1.0F))
                                  ? 1.0F
                                  : 0.0F;
                   });
    m.wind(1.5F, 60.0F);
    m.seen({3.4, 2.1, 6.8}, {0.0, 1.45, 0.4});
}

void pennants(Making& m)
{
    for (int i = 0; i < 4; ++i) {
        const double x = -2.4 + 1.6 * i;
        const double z = -0.8 * i;
        kit::add(m.scene(), "pole", kit::turned({{0.04F, 0.0F}, {0.03F, 3.2F}}, 12), {x, 0.0, z});
        kit::add_sheet(m.scene(), m.particles(33, 13), {x + 0.03, 3.1, z}, {1.3F, 0.0F, 0.0F},
                       {0.0F, -0.45F, 0.0F}, held_left, {.bending_n_m = 1e-5F});
    }
    m.wind(6.0F, 75.0F);
    m.seen({1.5, 1.6, 9.5}, {0.2, 1.7, -0.8});
}

void veil(Making& m)
{
    column(m.scene(), {0.0, 0.0, 0.0}, 0.25F, 1.2F);
    ball(m, {0.0, 1.55, 0.0}, 0.3F);
    kit::add_sheet(m.scene(), m.particles(65, 65), {-1.1, 1.87, -1.1}, {2.2F, 0.0F, 0.0F}, {0.0F, 0.0F, 2.2F},
                   {}, {.density_kg_m2 = 0.08F, .bending_n_m = 5e-6F, .friction = 0.8F});
    m.wind(1.0F, 60.0F);
    m.seen({1.8, 2.4, 4.8}, {0.0, 0.9, 0.0}, 0.5);
}

void swing(Making& m)
{
    // A rod that moves back and forth, and the cloth that hangs from it.
    const Index rod = kit::add(m.scene(), "rod", kit::block({0.8F, 0.03F, 0.03F}), {0.0, 2.4, 0.0});
    for (const double x : {-1.4, 1.4}) {
        kit::add(m.scene(), "post", kit::turned({{0.05F, 0.0F}, {0.05F, 2.5F}}, 14), {x, 0.0, -0.3});
    }
    const Index sheet = kit::add_sheet(m.scene(), m.particles(41, 49), {-0.7, 0.0, 0.0}, {1.4F, 0.0F, 0.0F},
                                       {0.0F, -1.7F, 0.0F}, held_above);
    m.scene().nodes[rod].children.push_back(sheet);
    m.scene().nodes[sheet].parent = rod;
    m.scene().roots.pop_back();
    AnimationChannel sway{.node = rod, .path = AnimatedPath::rotation};
    for (int i = 0; i <= 40; ++i) {
        const float angle =
            0.5F * 0.6F * std::sin(2.0F * std::numbers::pi_v<float> * static_cast<float>(i) / 20.0F);
        sway.times_s.push_back(static_cast<float>(i) * 0.1F);
        for (const float part : {0.0F, std::sin(angle), 0.0F, std::cos(angle)}) {
            sway.values.push_back(part);
        }
    }
    m.scene().animations.push_back({.name = "sway", .channels = {sway}, .duration_s = 4.0F});
    m.wind(0.5F, 0.0F);
    m.seen({2.2, 1.9, 5.4}, {0.0, 1.35, 0.0});
}

void cape(Making& m)
{
    const kit::Walker walker = kit::add_walker(m.scene(), {0.0, 0.0, -1.6});
    // The cape starts as half a cone: narrow around the shoulders, wider below.
    const glm::uvec2 particles = m.particles(41, 45);
    Primitive sheet = cloth_sheet(particles.x, particles.y, {}, {1.0F, 0.0F, 0.0F}, {0.0F, -1.0F, 0.0F});
    for (uint32_t i = 0; i < sheet.positions.size(); ++i) {
        const glm::vec2 share(sheet.positions[i].x, -sheet.positions[i].y);
        const float angle = (share.x - 0.5F) * 2.7F;
        const float radius_m = 0.3F + 0.28F * share.y;
        sheet.positions[i] = {-radius_m * std::sin(angle), 1.47F - 1.05F * share.y,
                              -0.72F * radius_m * std::cos(angle) + 0.02F};
        sheet.uvs[0][i] = {radius_m * angle, share.y};
        sheet.held[i] = share.y == 0.0F ? 1.0F : 0.0F;
    }
    sheet.material = 1;
    kit::bind(sheet, walker.chest);
    const Index node = kit::add(m.scene(), "cape", std::move(sheet), {});
    m.scene().nodes[node].skin = walker.skin;
    m.scene().nodes[node].cloth = Cloth{.density_kg_m2 = 0.25F, .bending_n_m = 1e-4F};
    m.wind(1.5F, -160.0F);
    m.seen({-5.2, 1.9, -3.6}, {0.0, 0.9, 0.0}, 0.5);
}

void dunes(Making& m)
{
    m.scene().terrain = Terrain(parse_terrain("[terrain]\nheight = \"ridge\"\n[nodes]\nridge = "
                                              "\"0.5 * sine(5) + 0.6 * fbm(9, octaves = 3)\"\n",
                                              "dunes"));
    const double height_m = m.scene().terrain->sample(0.0, 0.0).height_m;
    kit::add_sheet(m.scene(), m.particles(65, 57), {-1.6, height_m + 0.7, -1.4}, {3.2F, 0.0F, 0.0F},
                   {0.0F, 0.0F, 2.8F}, {}, {.density_kg_m2 = 0.3F, .friction = 0.8F});
    m.set_up.style.emplace_back("wind.from=style");
    m.wind(0.0F, 0.0F);
    m.seen({3.2, height_m + 2.2, 5.4}, {0.0, height_m - 0.1, 0.0}, 0.5);
}

const std::map<std::string, void (*)(Making&)>& makers()
{
    static const std::map<std::string, void (*)(Making&)> all{{"awning", awning},
                                                              {"ball", over_ball},
                                                              {"banner", banner},
                                                              {"cape", cape},
                                                              {"curtain", curtain},
                                                              {"dunes", dunes},
                                                              {"flag", flag},
                                                              {"hammock", hammock},
                                                              {"pennants", pennants},
                                                              {"round-table", round_table},
                                                              {"sail", sail},
                                                              {"spinning-ball", spinning_ball},
                                                              {"square-table", square_table},
                                                              {"steps", steps},
                                                              {"swing", swing},
                                                              {"veil", veil},
                                                              {"washing", washing}};
    return all;
}

} // namespace

std::vector<std::string> set_up_names()
{
    std::vector<std::string> names;
    for (const auto& [name, make] : makers()) {
        names.push_back(name);
    }
    return names;
}

ClothScene make_set_up(const std::string& name, float finer)
{
    const auto found = makers().find(name);
    if (found == makers().end()) {
        throw Error("there is no set-up of that name", name);
    }
    Making making{.set_up = {.name = name, .scene = kit::empty_scene()}, .finer = finer};
    // All these scenes have a low sun from the left.
    making.set_up.style = {"light.source=sun", "light.sun_azimuth_deg=-52", "light.sun_elevation_deg=24"};
    found->second(making);
    return making.set_up;
}
