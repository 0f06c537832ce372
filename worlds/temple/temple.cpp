// SPDX-License-Identifier: MIT
#include "temple.hpp"

#include <utility>

#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>

#include "cameras.hpp"
#include "lamps.hpp"
#include "plan.hpp"
#include "prison.hpp"
#include "sand.hpp"
#include "site.hpp"

namespace temple {
namespace {

using estampe::Index;

/// Collects the nodes and meshes of the temple's scene.
class Stage {
public:
    estampe::Node& node(const std::string& name, const glm::dvec3& place_m)
    {
        scene_.roots.push_back(static_cast<Index>(scene_.nodes.size()));
        estampe::Node& node = scene_.nodes.emplace_back();
        node.name = name;
        node.transform.translation = place_m;
        return node;
    }

    /// Stores a mesh, which several nodes may use, and returns its index.
    Index keep(estampe::Mesh mesh)
    {
        scene_.meshes.push_back(std::move(mesh));
        return static_cast<Index>(scene_.meshes.size() - 1);
    }

    estampe::Node& mesh(estampe::Mesh mesh, const glm::dvec3& place_m)
    {
        const std::string name = mesh.name;
        const Index kept = keep(std::move(mesh));
        estampe::Node& placed = node(name, place_m);
        placed.mesh = kept;
        return placed;
    }

    void light(const estampe::Light& light, const glm::dvec3& place_m, const glm::dvec3& towards)
    {
        scene_.lights.push_back(light);
        estampe::Node& placed = node(light.name, place_m);
        placed.light = static_cast<Index>(scene_.lights.size() - 1);
        placed.transform.rotation = looking(towards);
    }

    void camera(const Viewpoint& view)
    {
        scene_.cameras.push_back(
            {.name = view.name,
             .vertical_fov_rad = glm::radians(static_cast<double>(view.vertical_fov_deg)),
             .near_m = 0.1});
        estampe::Node& placed = node(view.name, view.eye_m);
        placed.camera = static_cast<Index>(scene_.cameras.size() - 1);
        placed.transform.rotation = looking(glm::dvec3(view.target_m - view.eye_m));
    }

    estampe::Scene& scene() { return scene_; }

private:
    /// Returns a rotation that turns -z towards a direction and keeps y upright.
    static glm::dquat looking(const glm::dvec3& towards)
    {
        const glm::dvec3 way = glm::normalize(towards);
        const glm::dvec3 up =
            std::abs(way.y) > 0.999 ? glm::dvec3(0.0, 0.0, -1.0) : glm::dvec3(0.0, 1.0, 0.0);
        return glm::quatLookAtRH(way, up);
    }

    estampe::Scene scene_;
};

/// Adds the sun: low in the east and a little south, so that long shadows fall across the court.
void add_sun(Stage& stage)
{
    constexpr double azimuth_deg = 66.0; // Direction of the sun: 0 is +z, 90 is +x
    constexpr double elevation_deg = 17.0;
    const double azimuth = glm::radians(azimuth_deg);
    const double elevation = glm::radians(elevation_deg);
    const glm::dvec3 from(std::sin(azimuth) * std::cos(elevation), std::sin(elevation),
                          std::cos(azimuth) * std::cos(elevation));
    stage.light({.name = "sun",
                 .type = estampe::LightType::directional,
                 .color = {1.0F, 0.96F, 0.87F},
                 .intensity = 3.4F},
                100.0 * from, -from);
}

estampe::Mesh sheet_mesh(const Sheet& sheet, const std::string& name)
{
    const auto count = [](const glm::vec3& side) {
        constexpr float cell_m = 0.17F;
        return static_cast<uint32_t>(std::lround(glm::length(side) / cell_m)) + 1U;
    };
    const uint32_t columns = count(sheet.along_m);
    const uint32_t rows = count(sheet.down_m);
    estampe::Primitive cloth = estampe::cloth_sheet(columns, rows, {}, sheet.along_m, sheet.down_m);
    cloth.material = static_cast<Index>(Stuff::red);
    for (size_t i = 0; i < cloth.held.size(); ++i) {
        const bool is_held = sheet.is_held_above ? i < columns : i % columns == 0;
        cloth.held[i] = is_held ? 1.0F : 0.0F;
    }
    return {.name = name, .primitives = {std::move(cloth)}};
}

} // namespace

estampe::Scene build_temple(uint64_t seed)
{
    const Plan plan = make_plan(seed);
    const Site site = make_site(seed);
    estampe::Terrain desert = make_desert(plan, seed);

    Stage stage;
    stage.scene().name = "temple";
    stage.scene().materials = materials();
    add_sun(stage);
    for (const Viewpoint& view : find_viewpoints(plan, site, desert)) {
        stage.camera(view);
    }
    for (const Thing& thing : build_prison(plan, seed)) {
        stage.mesh(thing.kit.mesh(thing.name), thing.place_m);
    }
    const auto ground_m = [&](const glm::vec2& place) {
        return static_cast<float>(desert.sample(place.x, place.y).height_m);
    };
    for (const Thing& thing : site.things) {
        const float ground = thing.on_sand ? ground_m({thing.place_m.x, thing.place_m.z}) : 0.0F;
        stage.mesh(thing.kit.mesh(thing.name), thing.place_m + glm::vec3(0.0F, ground, 0.0F));
    }
    for (size_t i = 0; i < site.columns.size(); ++i) {
        const StandingColumn& standing = site.columns[i];
        const float foot_m = standing.foot_m + (standing.is_on_floor ? 0.0F : ground_m(standing.place_m));
        stage.mesh(build_column(standing.column).mesh("column " + std::to_string(i)),
                   {standing.place_m.x, foot_m, standing.place_m.y});
    }
    for (size_t i = 0; i < site.drums.size(); ++i) {
        Dice dice(seed, 60 + i);
        Kit drum;
        const float length_m = dice.between(1.8F, 3.2F);
        drum.add(build_drum(0.74F, length_m, dice), at({}, site.drums[i].z));
        const glm::vec2 place(site.drums[i]);
        stage.mesh(drum.mesh("drum " + std::to_string(i)), {place.x, ground_m(place) - 0.22F, place.y});
    }
    for (size_t i = 0; i < site.sheets.size(); ++i) {
        const Sheet& sheet = site.sheets[i];
        stage.mesh(sheet_mesh(sheet, "flag " + std::to_string(i)), sheet.corner_m).cloth = estampe::Cloth{};
    }
    const Lamps lamps = hang_lamps(plan, seed);
    stage.mesh(lamps.kit.mesh("lamps"), {});
    const estampe::Index small = stage.keep(build_flame(false).mesh("flame"));
    const estampe::Index fire = stage.keep(build_flame(true).mesh("fire"));
    for (const PlacedFlame& flame : lamps.flames) {
        stage.node("flame", flame.place_m).mesh = flame.is_fire ? fire : small;
    }
    for (const PlacedLight& lamp : lamps.lights) {
        stage.light(lamp.light, lamp.place_m, {0.0, -1.0, 0.0});
    }
    estampe::Scene scene = std::move(stage.scene());
    add_cells(plan, seed, scene);
    scene.terrain = std::move(desert);
    scene.extensions_used = {"KHR_lights_punctual"};
    return scene;
}

} // namespace temple
