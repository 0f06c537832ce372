// SPDX-License-Identifier: MIT
#include <algorithm>
#include <map>
#include <set>

#include <fmt/format.h>

#include "scene/mending/repair.hpp"
#include "scene/pose.hpp"

namespace estampe {
namespace {

/// One primitive of one node, as it stands in the rest pose.
struct PlacedSurface {
    Index node = no_index;
    Index mesh = no_index;
    size_t primitive = 0;
    size_t triangles = 0;
    Bounds bounds;
    /// Integral of the way from the middle of the bounds along the surface's front: three times the volume
    /// where the surface is closed, and of the same sign where it nearly is.
    double outward_m3 = 0.0;
    bool is_one_sided = false;
};

std::vector<PlacedSurface> placed_surfaces(const Scene& scene)
{
    std::vector<PlacedSurface> surfaces;
    visit_posed(scene, pose_scene(scene, 0.0, no_index), [&](const PosedPrimitive& posed) {
        const std::vector<uint32_t>& indices = posed.primitive->indices;
        const Index mesh = scene.nodes[posed.node].mesh;
        if (posed.primitive->topology != Topology::triangles || indices.empty() ||
            !scene.nodes[posed.node].instances.empty()) {
            return;
        }
        PlacedSurface& surface = surfaces.emplace_back();
        surface.node = posed.node;
        surface.mesh = mesh;
        surface.primitive = static_cast<size_t>(posed.primitive - scene.meshes[mesh].primitives.data());
        surface.triangles = indices.size() / 3;
        surface.is_one_sided = !scene.materials[posed.primitive->material].double_sided;
        for (const uint32_t index : indices) {
            surface.bounds.extend(posed.positions[index]);
        }
        const glm::dvec3 middle = surface.bounds.center();
        for (size_t i = 0; i + 2 < indices.size(); i += 3) {
            const glm::dvec3 a = posed.positions[indices[i]] - middle;
            const glm::dvec3 b = posed.positions[indices[i + 1]] - middle;
            const glm::dvec3 c = posed.positions[indices[i + 2]] - middle;
            surface.outward_m3 += 0.5 * glm::dot(a, glm::cross(b, c)) * (posed.mirrored ? -1.0 : 1.0);
        }
    });
    return surfaces;
}

/// Whether `hull` lies around `figure`: no side within it, and none further out than an outline is wide.
bool lies_close_around(const Bounds& hull, const Bounds& figure)
{
    constexpr double widest = 0.12; // of the figure's diagonal
    const double slack_m = 1e-4 * figure.radius();
    const double widest_m = 2.0 * widest * figure.radius();
    const glm::dvec3 below = figure.min - hull.min;
    const glm::dvec3 above = hull.max - figure.max;
    const bool is_around = glm::all(glm::greaterThan(below, glm::dvec3(-slack_m))) &&
                           glm::all(glm::greaterThan(above, glm::dvec3(-slack_m)));
    const double sum_m = below.x + below.y + below.z + above.x + above.y + above.z;
    return is_around && sum_m > slack_m &&
           glm::all(glm::lessThan(glm::max(below, above), glm::dvec3(widest_m)));
}

/// Whether both have as many triangles but for a few that an exporter dropped or added.
bool has_count_of(const PlacedSurface& hull, const PlacedSurface& figure)
{
    const auto [least, most] = std::minmax(hull.triangles, figure.triangles);
    return 50 * (most - least) <= most;
}

bool is_hull_of(const PlacedSurface& hull, const PlacedSurface& figure)
{
    return hull.is_one_sided && hull.outward_m3 < 0.0 && figure.outward_m3 > 0.0 &&
           has_count_of(hull, figure) && -hull.outward_m3 < 2.0 * figure.outward_m3 &&
           lies_close_around(hull.bounds, figure.bounds);
}

/// Whether a one-sided primitive stands beside others: without one nothing needs to be posed.
bool may_have_hulls(const Scene& scene)
{
    size_t primitives = 0;
    bool has_one_sided = false;
    for (const Mesh& mesh : scene.meshes) {
        primitives += mesh.primitives.size();
        has_one_sided =
            has_one_sided || std::ranges::any_of(mesh.primitives, [&](const Primitive& primitive) {
                return !scene.materials[primitive.material].double_sided;
            });
    }
    return primitives > 1 && has_one_sided;
}

/// What a hull may go around: each primitive, all of a node together, and all of the scene together. Only
/// what is turned outwards counts.
std::vector<PlacedSurface> possible_figures(const std::vector<PlacedSurface>& surfaces)
{
    std::vector<PlacedSurface> figures;
    std::map<Index, PlacedSurface> of_node;
    PlacedSurface all;
    const auto add = [](PlacedSurface& sum, const PlacedSurface& part) {
        sum.triangles += part.triangles;
        sum.outward_m3 += part.outward_m3;
        sum.bounds.extend(part.bounds.min);
        sum.bounds.extend(part.bounds.max);
    };
    for (const PlacedSurface& surface : surfaces) {
        if (surface.outward_m3 > 0.0) {
            figures.push_back(surface);
            add(of_node[surface.node], surface);
            add(all, surface);
        }
    }
    for (const auto& [node, surface] : of_node) {
        figures.push_back(surface);
    }
    figures.push_back(all);
    return figures;
}

} // namespace

void leave_out_outline_hulls(Scene& scene)
{
    if (!may_have_hulls(scene)) {
        return;
    }
    const std::vector<PlacedSurface> surfaces = placed_surfaces(scene);
    std::vector<PlacedSurface> figures = possible_figures(surfaces);
    std::ranges::sort(figures, {}, &PlacedSurface::triangles);
    std::set<std::pair<Index, size_t>> hulls; // mesh and primitive
    for (const PlacedSurface& hull : surfaces) {
        const auto first =
            std::ranges::lower_bound(figures, hull.triangles * 49 / 50, {}, &PlacedSurface::triangles);
        const auto last = std::find_if(first, figures.end(), [&hull](const PlacedSurface& figure) {
            return !has_count_of(hull, figure) && figure.triangles > hull.triangles;
        });
        if (std::any_of(first, last,
                        [&hull](const PlacedSurface& figure) { return is_hull_of(hull, figure); })) {
            hulls.emplace(hull.mesh, hull.primitive);
        }
    }
    const std::vector<std::pair<Index, size_t>> last_first(hulls.rbegin(), hulls.rend()); // of each mesh
    for (const auto& [index, primitive] : last_first) {
        Mesh& mesh = scene.meshes[index];
        scene.warnings.push_back(fmt::format("mesh \"{}\": an outline hull, a larger copy turned inside out; "
                                             "left out, as lines are drawn without it",
                                             mesh.name));
        mesh.primitives.erase(mesh.primitives.begin() + static_cast<std::ptrdiff_t>(primitive));
    }
    for (Node& node : scene.nodes) {
        if (node.mesh != no_index && scene.meshes[node.mesh].primitives.empty()) {
            node.mesh = no_index;
            node.skin = no_index;
        }
    }
}

} // namespace estampe
