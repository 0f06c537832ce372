// SPDX-License-Identifier: MIT
#include "features/cloth/solid_grids.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <limits>

namespace estampe::features {
namespace {

constexpr uint32_t mesh_cells = 40;
constexpr double mirror = -1.0;
constexpr double margin_m = 1.0;
constexpr double nobody_there_m = -1e4; // height of ground that no sheet comes down to

cloth::SolidGrid grid_of(const Mesh& mesh, bool is_mirrored)
{
    std::vector<glm::vec3> positions;
    std::vector<glm::uvec3> triangles;
    for (const Primitive& primitive : mesh.primitives) {
        if (primitive.topology != Topology::triangles) {
            continue;
        }
        const auto first = static_cast<uint32_t>(positions.size());
        for (const glm::vec3& position : primitive.positions) {
            positions.emplace_back(is_mirrored ? -position.x : position.x, position.y, position.z);
        }
        for (size_t i = 0; i + 2 < primitive.indices.size(); i += 3) {
            triangles.push_back(
                first + glm::uvec3(primitive.indices[i], primitive.indices[i + 1], primitive.indices[i + 2]));
        }
    }
    return cloth::grid_of_distances(positions, triangles, mesh_cells);
}

using HeightAt = std::function<double(double x_m, double z_m)>;

/// Whole metres about the sheets, a metre more than they take: least x and z, most x and z.
glm::dvec4 level_box(std::span<const SheetPlace> sheets)
{
    Bounds all;
    for (const SheetPlace& sheet : sheets) {
        all.extend(sheet.box.min);
        all.extend(sheet.box.max);
    }
    return {std::floor(all.min.x - margin_m), std::floor(all.min.z - margin_m),
            std::ceil(all.max.x + margin_m), std::ceil(all.max.z + margin_m)};
}

bool is_over(const Bounds& box, const glm::dvec2& place_m, const glm::dvec2& beside_m)
{
    return place_m.x >= box.min.x - beside_m.x && place_m.x <= box.max.x + beside_m.x &&
           place_m.y >= box.min.z - beside_m.y && place_m.y <= box.max.z + beside_m.y;
}

std::vector<double> lows_of(std::span<const SheetPlace> sheets)
{
    std::vector<double> lows_m;
    for (const SheetPlace& sheet : sheets) {
        lows_m.push_back(sheet.stays_in ? std::floor(4.0 * sheet.stays_in->min.y) / 4.0 : 0.0);
    }
    return lows_m;
}

/// Whether the ground below a box may reach up to it.
bool comes_down_to(const Bounds& box, const HeightAt& height_at)
{
    constexpr int places = 5;         // either way
    constexpr double steepest = 0.7;  // sand lies at no more
    constexpr double unasked_m = 1.0; // a sheet moves as far before it is asked again, along and down
    const glm::dvec3 step = (box.max - box.min) / static_cast<double>(places - 1);
    double highest_m = -std::numeric_limits<double>::infinity();
    for (int z = 0; z < places; ++z) {
        for (int x = 0; x < places; ++x) {
            highest_m = std::max(highest_m, height_at(box.min.x + x * step.x, box.min.z + z * step.z));
        }
    }
    return box.min.y <= highest_m + 0.5 * steepest * std::hypot(step.x, step.z) + unasked_m;
}

} // namespace

SolidGrids::SolidGrids(const Scene& scene) : grids_(scene.terrain ? 1 : 0)
{
    const auto add = [&](Index mesh) {
        for (const bool is_mirrored : {false, true}) {
            if (of_mesh_.contains({mesh, is_mirrored})) {
                continue;
            }
            cloth::SolidGrid grid = grid_of(scene.meshes[mesh], is_mirrored);
            if (!grid.values_m.empty()) {
                of_mesh_[{mesh, is_mirrored}] = static_cast<uint32_t>(grids_.size());
                grids_.push_back(std::move(grid));
            }
        }
    };
    for (const Node& node : scene.nodes) {
        if (node.collider == ClothCollider::mesh && node.mesh < scene.meshes.size()) {
            add(node.mesh);
        }
    }
}

bool SolidGrids::follow_ground(const Scene& scene, std::span<const SheetPlace> sheets,
                               const glm::dvec3& anchor, double time_s)
{
    if (!scene.terrain || sheets.empty()) {
        return false;
    }
    constexpr double spacing_m = 0.125;
    constexpr double most_cells = 96.0;
    const bool stands = scene.terrain->description().meshing.update == TerrainUpdate::still;
    const GroundKey key{.box_m = level_box(sheets),
                        .anchor = anchor,
                        .time_s = stands ? 0.0 : std::floor(2.0 * std::max(time_s, 0.0)) / 2.0,
                        .program = &scene.terrain->program(),
                        .lows_m = lows_of(sheets)};
    if (ground_ == key) {
        return false;
    }
    ground_ = key;
    terrain_ = scene.terrain;
    const HeightAt height_at = [&](double x_m, double z_m) {
        return scene.terrain->sample(x_m + anchor.x, z_m + anchor.z, key.time_s).height_m - anchor.y;
    };
    std::vector<SheetPlace> near;
    std::ranges::copy_if(sheets, std::back_inserter(near), [&](const SheetPlace& sheet) {
        return !sheet.stays_in || comes_down_to(*sheet.stays_in, height_at);
    });
    is_ground_near_ = !near.empty();
    if (!is_ground_near_) {
        return false;
    }
    const glm::dvec4 box_m = level_box(near);
    const glm::dvec2 low(box_m);
    const glm::dvec2 high(box_m.z, box_m.w);
    const glm::dvec2 middle = 0.5 * (low + high);
    const glm::uvec2 cells(glm::min((high - low) / spacing_m, most_cells));
    const glm::dvec2 beside_m = glm::dvec2(margin_m) + (high - low) / glm::dvec2(cells);
    grids_.front() = cloth::grid_of_heights(
        cells + 1U, {middle.x, 0.0F, middle.y}, glm::vec2(0.5 * (high - low)), [&](double x_m, double z_m) {
            const bool is_asked = std::ranges::any_of(near, [&](const SheetPlace& sheet) {
                return !sheet.stays_in || is_over(*sheet.stays_in, {x_m, z_m}, beside_m);
            });
            return is_asked ? height_at(x_m, z_m) : nobody_there_m;
        });
    return true;
}

std::optional<cloth::Solid> SolidGrids::ground() const
{
    return ground_ && is_ground_near_
               ? std::optional(cloth::solid_of_grid(cloth::SolidKind::heights, grids_.front(), 0))
               : std::nullopt;
}

std::optional<cloth::Solid> SolidGrids::placed_mesh(Index mesh, const glm::dmat4& place) const
{
    const bool is_mirrored = glm::determinant(glm::dmat3(place)) < 0.0;
    const auto found = of_mesh_.find({mesh, is_mirrored});
    if (found == of_mesh_.end()) {
        return std::nullopt;
    }
    const cloth::Solid solid =
        cloth::solid_of_grid(cloth::SolidKind::distances, grids_.at(found->second), found->second);
    glm::dmat4 own = place;
    if (is_mirrored) {
        own[0] *= mirror;
    }
    return cloth::placed(solid, own);
}

} // namespace estampe::features
