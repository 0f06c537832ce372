// SPDX-License-Identifier: MIT
#include "features/cloth/cloth_solids.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <iterator>
#include <limits>
#include <map>

#include "shaders/scene.glsl.h"

namespace estampe::features {
namespace {

constexpr size_t least_vertices = 8; // A bone that moves fewer vertices gets no capsule

/// A bone in the bind pose of its skin.
struct BoundBone {
    uint32_t from_joint = 0; ///< Parent joint of the bone, as an index of the skin's joints
    uint32_t to_joint = 0;
    glm::vec3 from{0.0F};
    glm::vec3 to{0.0F};
    std::vector<float> distances;
};

std::vector<BoundBone> bound_bones(const Scene& scene, const Skin& skin)
{
    std::vector<BoundBone> bones;
    const auto place_of = [&](size_t joint) {
        const bool is_bound = joint < skin.joint_from_bind.size();
        return is_bound ? glm::vec3(glm::inverse(skin.joint_from_bind[joint])[3]) : glm::vec3(0.0F);
    };
    for (uint32_t to = 0; to < skin.joints.size(); ++to) {
        const auto parent = std::ranges::find(skin.joints, scene.nodes[skin.joints[to]].parent);
        if (parent != skin.joints.end()) {
            const auto from = static_cast<uint32_t>(parent - skin.joints.begin());
            bones.push_back({.from_joint = from, .to_joint = to, .from = place_of(from), .to = place_of(to)});
        }
    }
    return bones;
}

float distance_to(const BoundBone& bone, const glm::vec3& place)
{
    const glm::vec3 way = bone.to - bone.from;
    const float share = glm::dot(place - bone.from, way) / std::max(glm::dot(way, way), 1e-12F);
    return glm::distance(place, bone.from + glm::clamp(share, 0.0F, 1.0F) * way);
}

/// Assigns each vertex to the nearest bone of the joint with the largest weight.
void gather_distances(std::vector<BoundBone>& bones, const Primitive& primitive)
{
    for (size_t i = 0; i < std::min(primitive.joints_0.size(), primitive.weights_0.size()); ++i) {
        int heaviest = 0;
        for (int k = 1; k < 4; ++k) {
            heaviest = primitive.weights_0[i][k] > primitive.weights_0[i][heaviest] ? k : heaviest;
        }
        const uint32_t joint = primitive.joints_0[i][heaviest];
        BoundBone* nearest = nullptr;
        float nearest_m = 0.0F;
        for (BoundBone& bone : bones) {
            if (bone.from_joint != joint) {
                continue;
            }
            const float away_m = distance_to(bone, primitive.positions[i]);
            if (nearest == nullptr || away_m < nearest_m) {
                nearest = &bone;
                nearest_m = away_m;
            }
        }
        if (nearest != nullptr) {
            nearest->distances.push_back(nearest_m);
        }
    }
}

} // namespace

std::vector<BoneCapsule> bone_capsules(const Scene& scene)
{
    std::vector<BoneCapsule> capsules;
    for (const Node& node : scene.nodes) {
        if (node.skin >= scene.skins.size() || node.mesh >= scene.meshes.size()) {
            continue;
        }
        const Skin& skin = scene.skins[node.skin];
        std::vector<BoundBone> bones = bound_bones(scene, skin);
        for (const Primitive& primitive : scene.meshes[node.mesh].primitives) {
            if (cloth_of(scene, node, primitive) == nullptr) {
                gather_distances(bones, primitive);
            }
        }
        for (BoundBone& bone : bones) {
            const float length_m = glm::distance(bone.from, bone.to);
            if (bone.distances.size() < least_vertices || !(length_m > 0.0F)) {
                continue;
            }
            const auto middle = bone.distances.begin() + static_cast<ptrdiff_t>(bone.distances.size() / 2);
            std::ranges::nth_element(bone.distances, middle);
            capsules.push_back({.from = skin.joints[bone.from_joint],
                                .to = skin.joints[bone.to_joint],
                                .radius_share = *middle / length_m});
        }
    }
    return capsules;
}

cloth::Solid placed_bone(const BoneCapsule& bone, const ScenePose& pose, const glm::dvec3& anchor)
{
    const glm::vec3 from(glm::dvec3(pose.world_from_node[bone.from][3]) - anchor);
    const glm::vec3 to(glm::dvec3(pose.world_from_node[bone.to][3]) - anchor);
    return cloth::capsule_between(from, to, std::max(bone.radius_share * glm::distance(from, to), 1e-4F));
}

namespace {

constexpr uint32_t most_nodes = 192; // Number of texels of a body's depth maps along their longest side

/// Returns the topmost joint of a skin's hierarchy.
Index root_of(const Scene& scene, const Skin& skin)
{
    for (const Index joint : skin.joints) {
        if (std::ranges::find(skin.joints, scene.nodes[joint].parent) == skin.joints.end()) {
            return joint;
        }
    }
    return no_index;
}

/// Returns the skeleton of a draw call, if the draw call is part of a body; none otherwise.
Index skeleton_of(const Scene& scene, const pose::DrawSource& source)
{
    const Node& node = scene.nodes[source.node];
    if (node.skin >= scene.skins.size() || source.instance != 0) {
        return no_index;
    }
    const Primitive& primitive = scene.meshes[node.mesh].primitives[source.primitive];
    const bool is_body =
        primitive.topology == Topology::triangles && cloth_of(scene, node, primitive) == nullptr;
    return is_body ? root_of(scene, scene.skins[node.skin]) : no_index;
}

std::vector<double> areas_of(const Primitive& primitive)
{
    std::vector<double> areas_m2(primitive.positions.size(), 0.0);
    for (size_t i = 0; i + 2 < primitive.indices.size(); i += 3) {
        const std::array corners{primitive.indices[i], primitive.indices[i + 1], primitive.indices[i + 2]};
        const glm::vec3& from = primitive.positions.at(corners[0]);
        const double area_m2 = glm::length(
            glm::cross(primitive.positions.at(corners[1]) - from, primitive.positions.at(corners[2]) - from));
        for (const uint32_t corner : corners) {
            areas_m2[corner] += area_m2 / 6.0;
        }
    }
    return areas_m2;
}

/// Appends the bounds and the area of the vertices that each joint of a skin moves.
void append_parts(const Primitive& primitive, uint32_t draw, std::vector<SeenBody::Part>& parts)
{
    std::map<uint32_t, SeenBody::Part> of_joint;
    const std::vector<double> areas_m2 = areas_of(primitive);
    const auto gather = [&](const std::vector<glm::u16vec4>& joints, const std::vector<glm::vec4>& weights) {
        for (size_t i = 0; i < std::min({joints.size(), weights.size(), primitive.positions.size()}); ++i) {
            for (int k = 0; k < 4; ++k) {
                if (!(weights[i][k] > 0.0F)) {
                    continue;
                }
                const glm::vec3& place = primitive.positions[i];
                const uint32_t joint = joints[i][k];
                SeenBody::Part& part =
                    of_joint
                        .try_emplace(
                            joint,
                            SeenBody::Part{.draw = draw, .joint = joint, .min_m = place, .max_m = place})
                        .first->second;
                part.min_m = glm::min(part.min_m, place);
                part.max_m = glm::max(part.max_m, place);
                part.area_m2 += double{weights[i][k]} * areas_m2[i];
            }
        }
    };
    gather(primitive.joints_0, primitive.weights_0);
    gather(primitive.joints_1, primitive.weights_1);
    for (const auto& [joint, part] : of_joint) {
        parts.push_back(part);
    }
}

/// Returns a rotation that maps the z axis to the shortest of a box's three sides.
glm::quat turn_to_shortest(const glm::vec3& sides)
{
    constexpr float half = 0.70710678F; // Cosine and sine of half a right angle
    if (sides.z <= sides.x && sides.z <= sides.y) {
        return {1.0F, 0.0F, 0.0F, 0.0F};
    }
    return sides.x <= sides.y ? glm::quat(half, 0.0F, half, 0.0F) : glm::quat(half, -half, 0.0F, 0.0F);
}

void finish(SeenBody& body)
{
    const auto most =
        std::ranges::max_element(body.parts, {}, [](const SeenBody::Part& part) { return part.area_m2; });
    std::iter_swap(body.parts.begin(), most);
    glm::vec3 min_m = body.parts.front().min_m;
    glm::vec3 max_m = body.parts.front().max_m;
    for (const SeenBody::Part& part : body.parts) {
        min_m = glm::min(min_m, part.min_m);
        max_m = glm::max(max_m, part.max_m);
    }
    body.solid = {.kind = cloth::SolidKind::seen,
                  .centre_m = 0.5F * (min_m + max_m),
                  .rotation = turn_to_shortest(max_m - min_m)};
    const glm::vec2 sides(glm::abs(glm::inverse(body.solid.rotation) * (max_m - min_m)));
    const float node_m = std::max({sides.x, sides.y, 1e-6F}) / static_cast<float>(most_nodes);
    body.mesh.nodes = glm::uvec2(glm::max(glm::ceil(sides / node_m), glm::vec2(8.0F)));
}

} // namespace

std::vector<SeenBody> seen_bodies(const Scene& scene, const pose::MeshData& layout)
{
    std::vector<SeenBody> bodies;
    std::map<Index, size_t> of_skeleton;
    std::map<uint32_t, size_t> of_draw;
    for (uint32_t draw = 0; draw < layout.sources.size(); ++draw) {
        const pose::DrawSource& source = layout.sources[draw];
        const Index skeleton = skeleton_of(scene, source);
        if (skeleton == no_index) {
            continue;
        }
        const auto [found, is_new] = of_skeleton.try_emplace(skeleton, bodies.size());
        if (is_new) {
            bodies.emplace_back();
        }
        of_draw[draw] = found->second;
        append_parts(scene.meshes[scene.nodes[source.node].mesh].primitives[source.primitive], draw,
                     bodies[found->second].parts);
    }
    for (const glm::uvec4& triangle : layout.triangles) {
        const auto found = of_draw.find(triangle.w & shared::triangle_draw_mask);
        if (found != of_draw.end()) {
            bodies[found->second].mesh.triangles.emplace_back(triangle);
        }
    }
    std::erase_if(bodies,
                  [](const SeenBody& body) { return body.parts.empty() || body.mesh.triangles.empty(); });
    std::ranges::for_each(bodies, finish);
    return bodies;
}

cloth::Solid placed_body(const SeenBody& body, const pose::MeshData& layout, const pose::PoseData& pose,
                         uint32_t number)
{
    const auto matrix_of = [&](const SeenBody::Part& part) {
        return glm::dmat4(pose.joints.at(layout.draws[part.draw].first_joint + part.joint));
    };
    cloth::Solid solid = cloth::placed(body.solid, matrix_of(body.parts.front()));
    const glm::dquat back(glm::inverse(solid.rotation));
    glm::dvec3 half_m(0.0);
    for (const SeenBody::Part& part : body.parts) {
        const glm::dmat4 place = matrix_of(part);
        for (int corner = 0; corner < 8; ++corner) {
            const glm::bvec3 upper((corner & 1) != 0, (corner & 2) != 0, (corner & 4) != 0);
            const glm::dvec3 point(place * glm::dvec4(glm::mix(part.min_m, part.max_m, upper), 1.0));
            half_m = glm::max(half_m, glm::abs(back * (point - glm::dvec3(solid.centre_m))));
        }
    }
    constexpr double beside = 1.04; // Factor on the body's size, which adds a margin around the body
    solid.half_m = glm::vec3(beside * half_m + 1e-4);
    solid.grid = number;
    return solid;
}

namespace {

constexpr uint32_t mesh_cells = 40;
constexpr double mirror = -1.0;
constexpr double margin_m = 1.0;
// Height of the ground that is stored for places that no sheet can reach.
constexpr double nobody_there_m = -1e4;

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

/// Returns a box around the sheets with a margin of a metre, rounded to whole metres: the result holds least
/// x and z, then greatest x and z.
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

/// Returns whether the ground below a sheet's box may reach up to the box, as estimated from a few samples.
bool comes_down_to(const Bounds& box, const HeightAt& height_at)
{
    constexpr int places = 5;        // Number of samples in each direction
    constexpr double steepest = 0.7; // Steepest slope of sand
    // Largest distance, horizontal or down, by which a sheet may move before the ground is sampled again.
    constexpr double unasked_m = 1.0;
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
