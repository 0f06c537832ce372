// SPDX-License-Identifier: MIT
#include "scene/mending/repair.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include <fmt/format.h>

#include "scene/mending/mend.hpp"
#include "scene/pose.hpp"

namespace estampe {
namespace {

/// Returns whether a triangle's winding contradicts its normals: the triangle is clockwise as seen from the
/// side to which all three normals point.
bool runs_against_normals(const Primitive& primitive, const uint32_t* corners)
{
    const glm::dvec3 a = primitive.positions[corners[0]];
    const glm::dvec3 face = glm::cross(glm::dvec3(primitive.positions[corners[1]]) - a,
                                       glm::dvec3(primitive.positions[corners[2]]) - a);
    // A normal contradicts the winding only if its angle to the face is clearly more than 90 degrees. At a
    // sharp edge, the angle of smoothed normals can reach 90 degrees, and rounding errors make it a little
    // larger.
    constexpr double clearly = 0.05;
    const double least = -clearly * glm::length(face);
    return std::all_of(corners, corners + 3, [&](uint32_t corner) {
        const glm::dvec3 normal = primitive.normals[corner];
        return glm::dot(face, normal) < least * glm::length(normal);
    });
}

} // namespace

void turn_by_normals(Scene& scene)
{
    for (Mesh& mesh : scene.meshes) {
        for (Primitive& primitive : mesh.primitives) {
            if (primitive.topology != Topology::triangles || primitive.normals.empty() ||
                !scene.materials[primitive.material].double_sided) {
                continue;
            }
            for (size_t i = 0; i + 2 < primitive.indices.size(); i += 3) {
                if (runs_against_normals(primitive, &primitive.indices[i])) {
                    turn_triangle(primitive, i / 3);
                }
            }
        }
    }
}

namespace {

/// One primitive of one node in the rest pose, in world space.
struct PlacedSurface {
    Index node = no_index;
    Index mesh = no_index;
    size_t primitive = 0;
    size_t triangles = 0;
    Bounds bounds;
    /// Three times the enclosed volume if the surface is closed; positive if its faces point outwards. The
    /// value is the surface integral of the offset from the middle of the bounds, projected onto the normal.
    /// The sign is also right if the surface is nearly closed.
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

/// Returns whether the box `hull` closely encloses the box `figure`: each side of `hull` is outside `figure`,
/// but not farther than the width of an outline.
bool lies_close_around(const Bounds& hull, const Bounds& figure)
{
    constexpr double widest = 0.12; // largest outline width, as a share of the figure's diagonal
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

/// Returns whether both surfaces have nearly the same number of triangles. Exporters may drop or add a few.
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

/// Returns whether the scene can contain outline hulls: it has at least two primitives, and one of them is
/// one-sided. If not, the scene need not be posed.
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

/// Returns the surfaces that an outline hull may enclose: each primitive, all primitives of a node together,
/// and all primitives of the scene together. Only surfaces that face outwards are included.
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
    std::set<std::pair<Index, size_t>> hulls; // pairs of mesh index and primitive index
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
    const std::vector<std::pair<Index, size_t>> last_first(hulls.rbegin(),
                                                           hulls.rend()); // in descending order of index
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

namespace {

constexpr double clear_below = 0.05;
constexpr double solid_above = 0.9;

/// Area of a material's surfaces by alpha value.
struct AlphaShares {
    double area = 0.0;
    double clear = 0.0;
    double solid = 0.0;
    double wholly_solid = 0.0; ///< area where alpha rounds to 255 of 255
    double cut_out = 0.0;      ///< area where alpha is below Material::alpha_cutoff
};

double wrapped(double t, Wrap wrap)
{
    if (!std::isfinite(t)) {
        return 0.0;
    }
    if (wrap == Wrap::clamp) {
        return std::clamp(t, 0.0, 1.0);
    }
    const double part = t - std::floor(t);
    const bool is_odd = std::fmod(std::abs(std::floor(t)), 2.0) == 1.0;
    return wrap == Wrap::mirror && is_odd ? 1.0 - part : part;
}

/// Returns the alpha of the texel at `uv`, from 0 to 1, without interpolation.
double alpha_at(const Texture& texture, const glm::dvec2& uv)
{
    const auto texel = [](double t, uint32_t count) {
        return std::min(static_cast<uint32_t>(t * count), count - 1);
    };
    const uint32_t x = texel(wrapped(uv.x, texture.wrap_u), texture.image.width);
    const uint32_t y = texel(wrapped(uv.y, texture.wrap_v), texture.image.height);
    return texture.image.rgba[4 * (size_t{y} * texture.image.width + x) + 3] / 255.0;
}

/// Samples the alpha of a material at points on its triangles.
class AlphaMeter {
public:
    AlphaMeter(const Scene& scene, Index material) : scene_(scene), material_(scene.materials[material])
    {
        size_t triangles = 0;
        const auto of_material = [&](const auto& visit) {
            for (const Mesh& mesh : scene.meshes) {
                for (const Primitive& primitive : mesh.primitives) {
                    if (primitive.material == material && primitive.topology == Topology::triangles) {
                        visit(primitive);
                    }
                }
            }
        };
        of_material([&](const Primitive& primitive) { triangles += primitive.indices.size() / 3; });
        // Approximate number of triangles that are sampled. If the material has fewer triangles, each
        // triangle gets several samples.
        constexpr size_t enough = 1U << 17U;
        const size_t stride = std::max<size_t>(1, triangles / enough);
        places_ = std::clamp<size_t>(enough / std::max<size_t>(triangles, 1), 4, 4096);
        of_material([&](const Primitive& primitive) {
            for (size_t t = 0; t < primitive.indices.size() / 3; t += stride) {
                add(primitive, &primitive.indices[3 * t]);
            }
        });
    }

    [[nodiscard]] const AlphaShares& shares() const { return shares_; }

private:
    void add(const Primitive& primitive, const uint32_t* corners)
    {
        const glm::dvec3 a = primitive.positions[corners[0]];
        const double area = glm::length(glm::cross(glm::dvec3(primitive.positions[corners[1]]) - a,
                                                   glm::dvec3(primitive.positions[corners[2]]) - a));
        for (size_t i = 0; i < places_; ++i) {
            // Sample points follow Roberts' low-discrepancy sequence. Points outside of the triangle are
            // mirrored into it.
            double u = std::fmod(0.7548776662466927 * static_cast<double>(i + 1), 1.0);
            double v = std::fmod(0.5698402909980532 * static_cast<double>(i + 1), 1.0);
            if (u + v > 1.0) {
                u = 1.0 - u;
                v = 1.0 - v;
            }
            count(alpha(primitive, corners, {1.0 - u - v, u, v}), area / static_cast<double>(places_));
        }
    }

    [[nodiscard]] double alpha(const Primitive& primitive, const uint32_t* corners,
                               const glm::dvec3& weights) const
    {
        auto alpha = static_cast<double>(material_.base_color.w);
        const TextureRef& ref = material_.base_color_texture;
        const auto& uvs = primitive.uvs[std::min(ref.uv_set, 1U)];
        glm::dvec2 uv(0.0);
        double color = 0.0;
        for (int k = 0; k < 3; ++k) {
            uv += uvs.empty() ? glm::dvec2(0.0) : weights[k] * glm::dvec2(uvs[corners[k]]);
            color += primitive.colors.empty()
                         ? weights[k]
                         : weights[k] * static_cast<double>(primitive.colors[corners[k]].w);
        }
        if (ref.texture != no_index) {
            const glm::dvec3 placed = glm::dmat3(ref.uv_transform) * glm::dvec3(uv, 1.0);
            alpha *= alpha_at(scene_.textures[ref.texture], glm::dvec2(placed));
        }
        return alpha * color;
    }

    void count(double alpha, double area)
    {
        shares_.area += area;
        shares_.clear += alpha < clear_below ? area : 0.0;
        shares_.solid += alpha > solid_above ? area : 0.0;
        shares_.wholly_solid += alpha > 0.995 ? area : 0.0;
        shares_.cut_out += alpha < static_cast<double>(material_.alpha_cutoff) ? area : 0.0;
    }

    const Scene& scene_;
    const Material& material_;
    size_t places_ = 4;
    AlphaShares shares_;
};

} // namespace

void find_cut_out_materials(Scene& scene)
{
    // Textures of leaves and fences are clear or solid, except for soft borders. Textures of hair are half
    // transparent over half of the width of a strand.
    constexpr double much = 0.4;
    constexpr double some = 0.01;
    constexpr double a_part = 0.1;
    // Share of foliage that is cut out.
    constexpr double least_cut_out = 0.1;
    for (Index index = 0; index < scene.materials.size(); ++index) {
        Material& material = scene.materials[index];
        if (material.alpha_mode == AlphaMode::opaque || material.transmission) {
            continue;
        }
        const AlphaShares shares = AlphaMeter(scene, index).shares();
        if (!(shares.area > 0.0)) {
            continue;
        }
        const bool is_cut_out = shares.cut_out >= least_cut_out * shares.area;
        if (material.alpha_mode == AlphaMode::mask) {
            material.is_foliage = is_cut_out;
            if (shares.cut_out == 0.0) {
                material.alpha_mode = AlphaMode::opaque;
            }
            continue;
        }
        material.has_clear_parts = shares.clear >= some * shares.area;
        if (shares.wholly_solid == shares.area) {
            material.alpha_mode = AlphaMode::opaque;
        } else if (material.has_clear_parts && shares.solid >= a_part * shares.area &&
                   shares.clear + shares.solid >= much * shares.area) {
            material.alpha_mode = AlphaMode::mask;
            material.alpha_cutoff = 0.5F;
            material.is_foliage = is_cut_out;
        }
    }
}

} // namespace estampe
