// SPDX-License-Identifier: MIT
#include "techniques/pose/mesh_data.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <numeric>
#include <span>

#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/packing.hpp>

#include <estampe/error.hpp>

#include "scene/pose.hpp"
#include "scene/scene_limits.hpp"
#include "scene/static_triangles.hpp"

namespace estampe::pose {
namespace {

constexpr uint32_t enough_sheets = 8;
// Radius of drawn wires as a share of the scene's radius; about a pen's width in a framed view.
constexpr double wire_radius = 3e-3;

template <typename T>
T value_or(const std::vector<T>& values, size_t index, const T& otherwise)
{
    return index < values.size() ? values[index] : otherwise;
}

/// Rounds skin weights to 16 bits so that they still sum to one: the largest weight takes the rounding error.
std::array<uint32_t, 8> round_weights(const glm::vec4& weights_0, const glm::vec4& weights_1)
{
    std::array<uint32_t, 8> rounded{};
    for (int i = 0; i < 8; ++i) {
        const float weight = i < 4 ? weights_0[i] : weights_1[i - 4];
        rounded[static_cast<size_t>(i)] =
            static_cast<uint32_t>(std::lround(std::clamp(weight, 0.0F, 1.0F) * 65535.0F));
    }
    const uint32_t sum = std::accumulate(rounded.begin(), rounded.end(), 0U);
    auto& largest = *std::max_element(rounded.begin(), rounded.end());
    const bool is_rounding = sum + 8 >= 65535U && sum <= 65535U + 8;
    largest = is_rounding ? largest + 65535U - sum : largest;
    return rounded;
}

shared::SkinVertex pack_influences(const Primitive& primitive, size_t vertex)
{
    const auto joints_0 = value_or(primitive.joints_0, vertex, glm::u16vec4(0));
    const auto joints_1 = value_or(primitive.joints_1, vertex, glm::u16vec4(0));
    const auto weights = round_weights(value_or(primitive.weights_0, vertex, glm::vec4(0.0F)),
                                       value_or(primitive.weights_1, vertex, glm::vec4(0.0F)));
    const auto pair = [](uint32_t low, uint32_t high) { return low | high << 16U; };
    return {.joints = {pair(joints_0.x, joints_0.y), pair(joints_0.z, joints_0.w),
                       pair(joints_1.x, joints_1.y), pair(joints_1.z, joints_1.w)},
            .weights = {pair(weights[0], weights[1]), pair(weights[2], weights[3]),
                        pair(weights[4], weights[5]), pair(weights[6], weights[7])}};
}

/// Positions of a primitive's data in the uploaded vertex lists, which nodes with the same mesh share.
struct UploadedPrimitive {
    uint32_t first_rest_vertex = 0;
    uint32_t first_skin_vertex = shared::no_skin;
    uint32_t first_morph_offset = 0;
    Bounds bounds;
    bool follows_uv = false;
    bool is_round = false;
};

class Builder {
public:
    Builder(const Scene& scene, MeshData& data)
        : scene_(scene), data_(data), rest_pose_(pose_scene(scene, 0.0, no_index)),
          moving_nodes_(moving_nodes(scene))
    {
    }

    void run(Index ground_material, const ForeignMesh* foreign)
    {
        check_places(scene_, rest_pose_);
        data_.bounds = scene_bounds(scene_, rest_pose_);
        if (foreign != nullptr && data_.bounds.empty()) {
            data_.bounds = foreign->near;
        }
        check_extent(data_.bounds, scene_.name);
        data_.anchor = data_.bounds.center();
        if (foreign != nullptr) {
            data_.anchor = anchor_beside_foreign(data_.bounds);
        }
        data_.rest_anchor = data_.anchor;
        data_.stroke_unit_m = std::exp2(std::ceil(std::log2(std::max(data_.bounds.radius(), 1e-9))));
        for (Index node = 0; node < scene_.nodes.size(); ++node) {
            const bool is_foreign =
                foreign != nullptr && (foreign->node == node || foreign->instead_of == node);
            if (scene_.nodes[node].mesh != no_index && !is_foreign) {
                add_node(node);
            }
        }
        if (foreign != nullptr) {
            add_foreign(*foreign);
        }
        data_.opaque = append_solid(opaque_, false);
        data_.masked = append_solid(masked_, true);
        data_.blended = append(blended_);
        add_ground(ground_material);
        data_.edge_marks = edge_marks_of(data_, scene_);
    }

private:
    Range append(const std::vector<glm::uvec4>& triangles)
    {
        const Range range{static_cast<uint32_t>(data_.triangles.size()),
                          static_cast<uint32_t>(triangles.size()), is_plain(triangles)};
        data_.triangles.insert(data_.triangles.end(), triangles.begin(), triangles.end());
        return range;
    }

    /// Appends triangles sorted by their shadow groups: larger group masks first, and within a group static
    /// triangles before moving ones.
    Range append_solid(std::vector<glm::uvec4>& triangles, bool masked)
    {
        const auto kind_of = [this](const glm::uvec4& triangle) {
            const uint32_t draw = triangle.w & shared::triangle_draw_mask;
            return std::pair(static_cast<Groups>(data_.draws[draw].groups >> 16U), !draw_moves_[draw]);
        };
        const auto comes_first = [&](const glm::uvec4& a, const glm::uvec4& b) {
            return kind_of(a) > kind_of(b);
        };
        // The triangles of most scenes are sorted already.
        if (!std::is_sorted(triangles.begin(), triangles.end(), comes_first)) {
            std::stable_sort(triangles.begin(), triangles.end(), comes_first);
        }
        const Range whole = append(triangles);
        for (uint32_t first = 0; first < whole.count && kind_of(triangles[first]).first != 0;) {
            const auto kind = kind_of(triangles[first]);
            const auto begin = triangles.begin() + first;
            const auto end =
                std::find_if(begin, triangles.end(), [&](const glm::uvec4& t) { return kind_of(t) != kind; });
            const auto count = static_cast<uint32_t>(end - begin);
            data_.casters.push_back({.range = {whole.first + first, count, is_plain({begin, end})},
                                     .masked = masked,
                                     .groups = kind.first,
                                     .moves = !kind.second});
            first += count;
        }
        return whole;
    }

    void add_node(Index node_index)
    {
        const Node& node = scene_.nodes[node_index];
        const Mesh& mesh = scene_.meshes[node.mesh];
        const std::vector<glm::mat4> joints = skin_matrices(scene_, rest_pose_, node_index);
        const uint32_t first_joint = data_.joint_count;
        data_.joint_count += static_cast<uint32_t>(joints.size());
        const uint32_t first_weight = data_.morph_weight_count;
        data_.morph_weight_count += static_cast<uint32_t>(rest_pose_.morph_weights[node_index].size());
        const size_t places = joints.empty() ? std::max<size_t>(node.instances.size(), 1) : 1;
        for (const Primitive& original : mesh.primitives) {
            const Primitive& primitive = in_triangles(original);
            if (primitive.indices.empty()) {
                continue;
            }
            const UploadedPrimitive& uploaded = upload(primitive);
            for (uint32_t instance = 0; instance < places; ++instance) {
                shared::DrawRecord draw{};
                draw.first_posed_vertex = static_cast<uint32_t>(data_.draw_of_vertex.size());
                draw.first_rest_vertex = uploaded.first_rest_vertex;
                draw.vertex_count = static_cast<uint32_t>(primitive.positions.size());
                draw.material = primitive.material;
                draw.first_skin_vertex = joints.empty() ? shared::no_skin : uploaded.first_skin_vertex;
                draw.first_joint = first_joint;
                draw.first_morph_offset = uploaded.first_morph_offset;
                draw.morph_target_count = static_cast<uint32_t>(
                    std::min(primitive.morph_targets.size(), rest_pose_.morph_weights[node_index].size()));
                draw.first_morph_weight = first_weight;
                draw.object = node_index;
                draw.flags = (uploaded.follows_uv ? shared::draw_follows_uv : 0U) |
                             (uploaded.is_round ? shared::draw_is_round : 0U) |
                             (primitive.uvs[0].empty() ? 0U : shared::draw_has_uv);
                const Material& material = scene_.materials[primitive.material];
                draw.flags |= is_cut(material) ? shared::draw_is_cut : 0U;
                const bool is_foliage = is_cut(material) && material.is_foliage;
                draw.flags |= is_foliage ? shared::draw_is_foliage : 0U;
                data_.has_foliage = data_.has_foliage || is_foliage;
                data_.has_cut_outs = data_.has_cut_outs || (is_cut(material) && !is_foliage);
                link(draw, node.links, material.links);
                data_.sources.push_back(
                    {.node = node_index,
                     .primitive = static_cast<uint32_t>(&original - mesh.primitives.data()),
                     .instance = instance,
                     .local_bounds = reached_bounds(node, original, uploaded.bounds)});
                draw_moves_.push_back(can_move(scene_, moving_nodes_, node_index, original));
                add_draw(primitive, draw, place_of(node_index, instance), joints);
            }
        }
    }

    /// Bounds that a primitive may reach. Cloth swings and falls about as far as its own size.
    Bounds reached_bounds(const Node& node, const Primitive& primitive, const Bounds& bounds) const
    {
        Bounds reached = bounds;
        if (cloth_of(scene_, node, primitive) != nullptr && !bounds.empty()) {
            reached.extend(bounds.min - bounds.radius());
            reached.extend(bounds.max + bounds.radius());
        }
        return reached;
    }

    static bool is_cut(const Material& material)
    {
        return material.alpha_mode == AlphaMode::mask ||
               (material.alpha_mode == AlphaMode::blend &&
                (material.base_color.w <= 0.0F || material.has_clear_parts));
    }

    static void link(shared::DrawRecord& draw, const LightLinks& node, const LightLinks& material)
    {
        draw.groups = packed_groups(node) & packed_groups(material);
        draw.flags |= node.receives_shadows && material.receives_shadows ? 0U : shared::draw_unshadowed;
    }

    glm::dmat4 place_of(Index node, uint32_t instance) const
    {
        const auto& instances = scene_.nodes[node].instances;
        const glm::dmat4 place = rest_pose_.world_from_node[node];
        return instances.empty() ? place : place * glm::dmat4(instances[instance]);
    }

    const Primitive& in_triangles(const Primitive& primitive)
    {
        if (primitive.topology == Topology::triangles) {
            return primitive;
        }
        const auto [entry, is_new] = bodies_.try_emplace(&primitive);
        if (is_new) {
            entry->second = drawn_body(primitive, static_cast<float>(wire_radius * data_.bounds.radius()));
        }
        return entry->second;
    }

    const UploadedPrimitive& upload(const Primitive& primitive)
    {
        const auto [entry, is_new] = uploaded_.try_emplace(&primitive);
        UploadedPrimitive& result = entry->second;
        if (!is_new) {
            return result;
        }
        result.first_rest_vertex = static_cast<uint32_t>(data_.rest_vertices.size());
        result.first_morph_offset = static_cast<uint32_t>(data_.morph_offsets.size());
        result.follows_uv = uvs_are_usable(primitive);
        result.is_round = is_round(primitive);
        const size_t count = primitive.positions.size();
        for (size_t i = 0; i < count; ++i) {
            const glm::vec4 color = value_or(primitive.colors, i, glm::vec4(1.0F));
            const glm::vec4 stored(glm::sqrt(glm::clamp(glm::vec3(color), 0.0F, 1.0F)), color.w);
            data_.rest_vertices.push_back(
                {.position = primitive.positions[i],
                 .normal = pack_normal(value_or(primitive.normals, i, glm::vec3(0, 1, 0))),
                 .uv_0 = value_or(primitive.uvs[0], i, glm::vec2(0.0F)),
                 .uv_1 = value_or(primitive.uvs[1], i, glm::vec2(0.0F)),
                 .color = glm::packUnorm4x8(stored)});
            result.bounds.extend(primitive.positions[i]);
        }
        if (!primitive.weights_0.empty()) {
            result.first_skin_vertex = static_cast<uint32_t>(data_.skin_vertices.size());
            for (size_t i = 0; i < count; ++i) {
                data_.skin_vertices.push_back(pack_influences(primitive, i));
            }
        }
        for (const MorphTarget& target : primitive.morph_targets) {
            for (size_t i = 0; i < count; ++i) {
                data_.morph_offsets.push_back(
                    {.position = value_or(target.position_offsets, i, glm::vec3(0.0F)),
                     .normal = value_or(target.normal_offsets, i, glm::vec3(0.0F))});
            }
        }
        return result;
    }

    void add_draw(const Primitive& primitive, const shared::DrawRecord& draw, const glm::dmat4& place,
                  const std::vector<glm::mat4>& joints)
    {
        const auto index = static_cast<uint32_t>(data_.draws.size());
        if (index >= shared::triangle_draw_mask) {
            throw Error(fmt::format("the scene shows more than {} primitives", shared::triangle_draw_mask),
                        scene_.name, "use a lighter scene, or show fewer copies");
        }
        data_.draws.push_back(draw);
        data_.draw_of_vertex.insert(data_.draw_of_vertex.end(), draw.vertex_count, index);
        for (size_t i = 0; i < primitive.positions.size(); ++i) {
            glm::dmat4 vertex_place = place;
            if (draw.first_skin_vertex != shared::no_skin) {
                vertex_place = blended_joints(primitive, i, joints);
            }
            const glm::dvec3 world(vertex_place * glm::dvec4(primitive.positions[i], 1.0));
            data_.stroke_coordinates.emplace_back((world - data_.anchor) / data_.stroke_unit_m);
        }
        const Material& material = scene_.materials[primitive.material];
        const uint32_t flags = index | (material.double_sided ? shared::triangle_two_sided : 0U);
        auto& list = material.alpha_mode == AlphaMode::opaque ? opaque_
                     : material.alpha_mode == AlphaMode::mask ? masked_
                                                              : blended_;
        if (material.alpha_mode == AlphaMode::blend && data_.blended_sheets < enough_sheets) {
            const uint32_t sheets = most_sheets(primitive, material.double_sided, enough_sheets);
            data_.blended_sheets = std::min(data_.blended_sheets + sheets, enough_sheets);
        }
        for (size_t i = 0; i + 2 < primitive.indices.size(); i += 3) {
            list.emplace_back(draw.first_posed_vertex + primitive.indices[i],
                              draw.first_posed_vertex + primitive.indices[i + 1],
                              draw.first_posed_vertex + primitive.indices[i + 2], flags);
        }
    }

    static glm::dmat4 blended_joints(const Primitive& primitive, size_t vertex,
                                     const std::vector<glm::mat4>& joints)
    {
        glm::mat4 sum(0.0F);
        const auto add = [&](const std::vector<glm::u16vec4>& indices,
                             const std::vector<glm::vec4>& weights) {
            for (int k = 0; vertex < weights.size() && vertex < indices.size() && k < 4; ++k) {
                if (indices[vertex][k] < joints.size()) {
                    sum += weights[vertex][k] * joints[indices[vertex][k]];
                }
            }
        };
        add(primitive.joints_0, primitive.weights_0);
        add(primitive.joints_1, primitive.weights_1);
        return {sum};
    }

    void add_foreign(const ForeignMesh& mesh)
    {
        const auto index = static_cast<uint32_t>(data_.draws.size());
        const auto first = static_cast<uint32_t>(data_.draw_of_vertex.size());
        shared::DrawRecord draw{};
        draw.first_posed_vertex = first;
        draw.first_rest_vertex = static_cast<uint32_t>(data_.rest_vertices.size());
        draw.vertex_count = static_cast<uint32_t>(mesh.places.size());
        draw.material = mesh.material;
        draw.first_skin_vertex = shared::no_skin;
        draw.object = mesh.node;
        draw.groups = packed_groups({.casts_for = 0});
        for (const glm::dvec3& place : mesh.places) {
            data_.rest_vertices.push_back({.position = glm::vec3(place),
                                           .normal = pack_normal({0.0F, 1.0F, 0.0F}),
                                           .color = 0xffffffffU});
            data_.stroke_coordinates.emplace_back((place - data_.anchor) / data_.stroke_unit_m);
        }
        data_.draws.push_back(draw);
        data_.sources.push_back({.node = mesh.node});
        draw_moves_.push_back(true);
        data_.draw_of_vertex.insert(data_.draw_of_vertex.end(), mesh.places.size(), index);
        for (const glm::uvec3& corners : mesh.triangles) {
            opaque_.emplace_back(corners + first, index);
        }
        data_.foreign_vertex = first;
    }

    void add_ground(Index material)
    {
        const double radius = std::max(data_.bounds.radius(), 1e-6);
        const auto reach = static_cast<float>(60.0 * radius);
        Primitive quad;
        const auto height = static_cast<float>(data_.bounds.min.y - data_.anchor.y - 1e-3 * radius);
        for (const glm::vec2 corner :
             {glm::vec2(-1, -1), glm::vec2(-1, 1), glm::vec2(1, 1), glm::vec2(1, -1)}) {
            quad.positions.emplace_back(corner.x * reach, height, corner.y * reach);
            quad.normals.emplace_back(0.0F, 1.0F, 0.0F);
        }
        quad.indices = {0, 1, 2, 0, 2, 3};
        const auto index = static_cast<uint32_t>(data_.draws.size());
        shared::DrawRecord draw{};
        draw.anchor_from_object = glm::mat4(1.0F);
        draw.first_posed_vertex = static_cast<uint32_t>(data_.draw_of_vertex.size());
        draw.first_rest_vertex = static_cast<uint32_t>(data_.rest_vertices.size());
        draw.vertex_count = 4;
        draw.material = material;
        draw.first_skin_vertex = shared::no_skin;
        draw.object = static_cast<uint32_t>(scene_.nodes.size());
        draw.groups = packed_groups({.casts_for = 0});
        for (const glm::vec3& position : quad.positions) {
            data_.rest_vertices.push_back(
                {.position = position, .normal = pack_normal({0.0F, 1.0F, 0.0F}), .color = 0xffffffffU});
            data_.stroke_coordinates.push_back(position / static_cast<float>(data_.stroke_unit_m));
        }
        data_.draws.push_back(draw);
        data_.draw_of_vertex.insert(data_.draw_of_vertex.end(), 4, index);
        const uint32_t v = draw.first_posed_vertex;
        data_.ground = append({{v, v + 1, v + 2, index}, {v, v + 2, v + 3, index}});
    }

    const Scene& scene_;
    MeshData& data_;
    ScenePose rest_pose_;
    std::vector<bool> moving_nodes_;
    std::vector<bool> draw_moves_;
    std::map<const Primitive*, UploadedPrimitive> uploaded_;
    /// For each primitive of lines or points, its triangles as wires and dots.
    std::map<const Primitive*, Primitive> bodies_;
    std::vector<glm::uvec4> opaque_, masked_, blended_;
};

} // namespace

uint32_t pack_normal(glm::vec3 n)
{
    const float sum = std::abs(n.x) + std::abs(n.y) + std::abs(n.z);
    if (!(sum > 0.0F)) {
        return pack_normal({0.0F, 1.0F, 0.0F});
    }
    glm::vec2 e = glm::vec2(n.x, n.y) / sum;
    if (n.z < 0.0F) {
        const glm::vec2 sign(e.x >= 0.0F ? 1.0F : -1.0F, e.y >= 0.0F ? 1.0F : -1.0F);
        e = (1.0F - glm::abs(glm::vec2(e.y, e.x))) * sign;
    }
    return glm::packSnorm2x16(e);
}

glm::vec3 unpack_normal(uint32_t packed)
{
    const glm::vec2 e = glm::unpackSnorm2x16(packed);
    glm::vec3 n(e, 1.0F - std::abs(e.x) - std::abs(e.y));
    if (n.z < 0.0F) {
        const glm::vec2 sign(e.x >= 0.0F ? 1.0F : -1.0F, e.y >= 0.0F ? 1.0F : -1.0F);
        const glm::vec2 folded = (1.0F - glm::abs(glm::vec2(e.y, e.x))) * sign;
        n = {folded, n.z};
    }
    return glm::normalize(n);
}

uint32_t packed_groups(const LightLinks& links)
{
    return links.lit_by | static_cast<uint32_t>(links.casts_for) << 16U;
}

bool has_plain_links(const MeshData& meshes)
{
    return std::ranges::all_of(
        std::span(meshes.draws).first(meshes.sources.size()), [](const shared::DrawRecord& draw) {
            return draw.groups == packed_groups({}) && (draw.flags & shared::draw_unshadowed) == 0;
        });
}

glm::dvec3 anchor_beside_foreign(const Bounds& bounds)
{
    return 64.0 * glm::round(bounds.center() / 64.0);
}

MeshData build_meshes(const Scene& scene, Index ground_material, const ForeignMesh* foreign)
{
    check_drawn_size(scene);
    MeshData data;
    Builder(scene, data).run(ground_material, foreign);
    return data;
}

std::vector<uint8_t> edge_marks_of(const MeshData& meshes, const Scene& scene)
{
    const auto marks_of = [&](const DrawSource& source) -> const std::vector<uint8_t>& {
        return scene.meshes[scene.nodes[source.node].mesh].primitives[source.primitive].edge_marks;
    };
    if (std::ranges::all_of(meshes.sources,
                            [&](const DrawSource& source) { return marks_of(source).empty(); })) {
        return {};
    }
    // Sorting keeps the order of triangles within a draw call.
    std::vector<size_t> seen_of_draw(meshes.draws.size(), 0);
    std::vector<uint8_t> marks(meshes.triangles.size(), 0);
    for (size_t t = 0; t < meshes.triangles.size(); ++t) {
        const uint32_t draw = meshes.triangles[t].w & shared::triangle_draw_mask;
        if (draw < meshes.sources.size() && !marks_of(meshes.sources[draw]).empty()) {
            const uint8_t marked = marks_of(meshes.sources[draw]).at(seen_of_draw[draw]++);
            marks[t] = static_cast<uint8_t>(marked | marks_edges);
        }
    }
    return marks;
}

std::vector<uint32_t> solid_triangles(const MeshData& data)
{
    std::vector<uint32_t> solid;
    for (const Range& range : {data.opaque, data.masked}) {
        for (uint32_t i = range.first; i < range.first + range.count; ++i) {
            if (data.triangles[i].x < data.foreign_vertex.value_or(UINT32_MAX)) {
                solid.push_back(i);
            }
        }
    }
    return solid;
}

} // namespace estampe::pose
