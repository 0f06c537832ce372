// SPDX-License-Identifier: MIT
// Poses meshes: computes the matrices and weights of a point in time, finds the changes since the last pose,
// and dispatches the posing of vertices on the GPU.
#include "techniques/pose/pose.hpp"

#include <algorithm>
#include <cstring>
#include <limits>
#include <set>
#include <span>
#include <utility>

#include <glm/gtc/matrix_transform.hpp>

#include "gpu/resources.hpp"
#include "scene/pose.hpp"
#include "shaders/pose_comp.hpp"
#include "techniques/pose/mesh_data.hpp"
#include "techniques/pose/pose_variant.glsl.h"

namespace estampe::pose {
namespace {

Bounds transformed(const Bounds& local, const glm::dmat4& place)
{
    Bounds result;
    for (int i = 0; i < 8 && !local.empty(); ++i) {
        const glm::dvec3 corner((i & 1) != 0 ? local.max.x : local.min.x,
                                (i & 2) != 0 ? local.max.y : local.min.y,
                                (i & 4) != 0 ? local.max.z : local.min.z);
        result.extend(glm::dvec3(place * glm::dvec4(corner, 1.0)));
    }
    return result;
}

/// Whether a draw call is a floor: flat, level, and the lowest, so that nothing can receive its shadow.
bool is_lowest_floor(const Bounds& draw, const Bounds& scene)
{
    const double extent =
        std::max({scene.max.x - scene.min.x, scene.max.y - scene.min.y, scene.max.z - scene.min.z});
    return draw.max.y - draw.min.y <= 1e-3 * extent && draw.max.y <= scene.min.y + 2e-3 * extent;
}

bool is_mirrored(const shared::DrawRecord& draw)
{
    return (draw.flags & shared::draw_mirrored) != 0;
}

void set_mirrored(shared::DrawRecord& draw, bool mirrored)
{
    draw.flags = (draw.flags & ~shared::draw_mirrored) | (mirrored ? shared::draw_mirrored : 0U);
}

} // namespace

bool PoseData::operator==(const PoseData& other) const
{
    return draws.size() == other.draws.size() && joints == other.joints &&
           morph_weights == other.morph_weights &&
           std::memcmp(draws.data(), other.draws.data(), draws.size() * sizeof(shared::DrawRecord)) == 0;
}

PoseData pose_meshes(const MeshData& meshes, const Scene& scene, const ScenePose& pose)
{
    PoseData data;
    data.draws = meshes.draws;
    const glm::dmat4 anchor_from_world = glm::translate(glm::dmat4(1.0), -meshes.anchor);
    bool has_deforming = false;
    std::vector<Bounds> draw_bounds;
    Bounds all;
    for (size_t i = 0; i < meshes.sources.size(); ++i) {
        const DrawSource& source = meshes.sources[i];
        const auto& instances = scene.nodes[source.node].instances;
        glm::dmat4 place = pose.world_from_node[source.node];
        if (!instances.empty()) {
            place = place * glm::dmat4(instances[source.instance]);
        }
        data.draws[i].anchor_from_object = glm::mat4(anchor_from_world * place);
        has_deforming |=
            data.draws[i].first_skin_vertex != shared::no_skin || data.draws[i].morph_target_count > 0;
        draw_bounds.push_back(transformed(source.local_bounds, place));
        if (!draw_bounds.back().empty()) {
            all.extend(draw_bounds.back().min);
            all.extend(draw_bounds.back().max);
        }
    }
    for (Index node = 0; node < scene.nodes.size(); ++node) {
        if (scene.nodes[node].mesh == no_index) {
            continue;
        }
        for (const glm::mat4& world_from_bind : skin_matrices(scene, pose, node)) {
            data.joints.emplace_back(anchor_from_world * glm::dmat4(world_from_bind));
        }
        const auto& weights = pose.morph_weights[node];
        data.morph_weights.insert(data.morph_weights.end(), weights.begin(), weights.end());
    }
    for (size_t i = 0; i < meshes.sources.size(); ++i) {
        shared::DrawRecord& draw = data.draws[i];
        const bool is_skinned = draw.first_skin_vertex != shared::no_skin;
        const glm::mat3 linear(is_skinned ? data.joints[draw.first_joint] : draw.anchor_from_object);
        set_mirrored(draw, glm::determinant(glm::dmat3(linear)) < 0.0);
    }
    if (has_deforming) {
        data.casters = scene_bounds(scene, pose);
        return data;
    }
    for (size_t i = 0; i < draw_bounds.size(); ++i) {
        const Bounds& bounds = draw_bounds[i];
        const bool see_through = scene.materials[meshes.draws[i].material].alpha_mode == AlphaMode::blend;
        const bool casts = (meshes.draws[i].groups >> 16U) != 0;
        if (!bounds.empty() && casts && !see_through && !is_lowest_floor(bounds, all)) {
            data.casters.extend(bounds.min);
            data.casters.extend(bounds.max);
        }
    }
    return data;
}

bool is_plain(std::span<const glm::uvec4> triangles)
{
    constexpr uint32_t flags = shared::triangle_two_sided | shared::triangle_mirrored;
    return std::ranges::all_of(triangles,
                               [](const glm::uvec4& triangle) { return (triangle.w & flags) == 0; });
}

bool turn_triangles(MeshData& meshes, const PoseData& pose)
{
    bool changed = false;
    for (size_t i = 0; i < meshes.draws.size(); ++i) {
        changed |= is_mirrored(meshes.draws[i]) != is_mirrored(pose.draws[i]);
        set_mirrored(meshes.draws[i], is_mirrored(pose.draws[i]));
    }
    if (!changed) {
        return false;
    }
    for (glm::uvec4& triangle : meshes.triangles) {
        const bool mirrored = is_mirrored(meshes.draws[triangle.w & shared::triangle_draw_mask]);
        triangle.w = (triangle.w & ~shared::triangle_mirrored) | (mirrored ? shared::triangle_mirrored : 0U);
    }
    for (Range* const range : {&meshes.opaque, &meshes.masked, &meshes.blended, &meshes.ground}) {
        range->plain = is_plain(std::span(meshes.triangles).subspan(range->first, range->count));
    }
    for (CasterRun& run : meshes.casters) {
        run.range.plain = is_plain(std::span(meshes.triangles).subspan(run.range.first, run.range.count));
    }
    return true;
}

namespace {

void extend(Bounds& place, const Bounds& local, const glm::mat4& anchor_from_local)
{
    for (int i = 0; i < 8 && !local.empty(); ++i) {
        const glm::dvec3 corner((i & 1) != 0 ? local.max.x : local.min.x,
                                (i & 2) != 0 ? local.max.y : local.min.y,
                                (i & 4) != 0 ? local.max.z : local.min.z);
        place.extend(glm::dvec3(glm::dmat4(anchor_from_local) * glm::dvec4(corner, 1.0)));
    }
}

/// The matrices that transform the vertices of one draw call.
struct Places {
    size_t first = 0;
    size_t count = 0;
    bool are_joints = false;

    [[nodiscard]] const glm::mat4& of(const PoseData& pose, size_t draw, size_t index) const
    {
        return are_joints ? pose.joints[first + index] : pose.draws[draw].anchor_from_object;
    }
};

Places places_of(const shared::DrawRecord& draw, const std::set<uint32_t>& first_joints, size_t joint_count)
{
    if (draw.first_skin_vertex == shared::no_skin) {
        return {.count = 1};
    }
    const auto next = first_joints.upper_bound(draw.first_joint);
    const size_t end = next == first_joints.end() ? joint_count : *next;
    return {.first = draw.first_joint, .count = end - draw.first_joint, .are_joints = true};
}

bool morphs_differ(const shared::DrawRecord& draw, const PoseData& before, const PoseData& now)
{
    const auto first = static_cast<std::ptrdiff_t>(draw.first_morph_weight);
    return !std::equal(now.morph_weights.begin() + first,
                       now.morph_weights.begin() + first + draw.morph_target_count,
                       before.morph_weights.begin() + first);
}

} // namespace

Bounds everywhere()
{
    constexpr double endless = std::numeric_limits<double>::infinity();
    return {.min = glm::dvec3(-endless), .max = glm::dvec3(endless)};
}

std::vector<Bounds> moved_places(const MeshData& meshes, const PoseData& before, const PoseData& now)
{
    std::set<uint32_t> first_joints;
    for (const shared::DrawRecord& draw : now.draws) {
        if (draw.first_skin_vertex != shared::no_skin) {
            first_joints.insert(draw.first_joint);
        }
    }
    std::vector<Bounds> moved;
    for (size_t i = 0; i < meshes.sources.size(); ++i) {
        const shared::DrawRecord& draw = now.draws[i];
        const Places places = places_of(draw, first_joints, now.joints.size());
        bool differs = false;
        Bounds place;
        for (size_t k = 0; k < places.count; ++k) {
            const glm::mat4& was = places.of(before, i, k);
            const glm::mat4& is = places.of(now, i, k);
            differs = differs || was != is;
            extend(place, meshes.sources[i].local_bounds, was);
            extend(place, meshes.sources[i].local_bounds, is);
        }
        if (morphs_differ(draw, before, now)) {
            moved.push_back(everywhere());
        } else if (differs) {
            moved.push_back(place);
        }
    }
    return moved;
}

namespace {

bool stands_otherwise(const shared::DrawRecord& before, const shared::DrawRecord& now)
{
    return before.anchor_from_object != now.anchor_from_object || before.first_joint != now.first_joint ||
           before.first_morph_weight != now.first_morph_weight;
}

bool weighs_otherwise(const shared::DrawRecord& draw, const PoseData& before, const PoseData& now)
{
    const auto weights = [&](const PoseData& pose) {
        return std::span(pose.morph_weights).subspan(draw.first_morph_weight, draw.morph_target_count);
    };
    return draw.morph_target_count > 0 && !std::ranges::equal(weights(before), weights(now));
}

/// Collects runs of vertices in ascending order. When the list is full, merges the two runs with the smallest
/// gap.
class Collector {
public:
    void add(const VertexRun& run)
    {
        if (count_ > 0 && end_of(runs_[count_ - 1]) == run.first) {
            runs_[count_ - 1].count += run.count;
            return;
        }
        runs_[count_++] = run;
        if (count_ == runs_.size()) {
            join_nearest();
        }
    }

    [[nodiscard]] VertexRuns runs() const
    {
        VertexRuns runs;
        for (size_t i = 0; i < count_; ++i) {
            runs.push_back(runs_[i]);
        }
        return runs;
    }

private:
    static uint32_t end_of(const VertexRun& run) { return run.first + run.count; }

    void join_nearest()
    {
        size_t nearest = 1;
        const auto gap = [&](size_t i) { return runs_[i].first - end_of(runs_[i - 1]); };
        for (size_t i = 2; i < count_; ++i) {
            nearest = gap(i) < gap(nearest) ? i : nearest;
        }
        runs_[nearest - 1].count = end_of(runs_[nearest]) - runs_[nearest - 1].first;
        std::copy(runs_.begin() + static_cast<std::ptrdiff_t>(nearest) + 1,
                  runs_.begin() + static_cast<std::ptrdiff_t>(count_),
                  runs_.begin() + static_cast<std::ptrdiff_t>(nearest));
        --count_;
    }

    std::array<VertexRun, 9> runs_{};
    size_t count_ = 0;
};

} // namespace

VertexRuns runs_to_pose(const MeshData& meshes, const PoseData* before, const PoseData& now,
                        std::span<const uint32_t> written_over)
{
    if (before == nullptr) {
        return {VertexRun{.first = 0, .count = static_cast<uint32_t>(meshes.draw_of_vertex.size())}};
    }
    // The joints of a single skin are not known here, so all skinned bodies count as moved if any joint
    // moved.
    const bool have_joints_moved = before->joints != now.joints;
    Collector runs;
    for (uint32_t i = 0; i < now.draws.size(); ++i) {
        const shared::DrawRecord& draw = now.draws[i];
        const bool is_skinned = draw.first_skin_vertex != shared::no_skin;
        if (stands_otherwise(before->draws[i], draw) || (is_skinned && have_joints_moved) ||
            weighs_otherwise(draw, *before, now) || std::ranges::binary_search(written_over, i)) {
            runs.add({.first = draw.first_posed_vertex, .count = draw.vertex_count});
        }
    }
    return runs.runs();
}

namespace {

gpu::BufferId add_runs(gpu::Graph& graph, MeshBuffers& meshes, const MeshData& data, const VertexRuns& runs,
                       gpu::BufferId draws, gpu::BufferId rest_vertices)
{
    gpu::BufferId posed = gpu::import_whole(graph, "posed vertices", meshes.posed_vertices[0]);
    const auto draw_of_vertex = gpu::import_whole(graph, "draw of vertex", meshes.draw_of_vertex);
    const auto skin_vertices = gpu::import_whole(graph, "skin vertices", meshes.skin_vertices);
    const auto morph_offsets = gpu::import_whole(graph, "morph offsets", meshes.morph_offsets);
    const auto joints = gpu::import_whole(graph, "joints", meshes.joints);
    const auto morph_weights = gpu::import_whole(graph, "morph weights", meshes.morph_weights);
    shared::PoseRuns constants{};
    for (const VertexRun& run : runs) {
        constants.item_count += run.count;
        constants.firsts[constants.run_count] = run.first;
        constants.ends[constants.run_count++] = constants.item_count;
    }
    if (constants.item_count == 0) {
        return posed;
    }
    auto pass = graph.compute("pose", shaders::pose_comp);
    pass.sample(draws).read(draw_of_vertex).sample(rest_vertices);
    pass.read(skin_vertices).read(morph_offsets).read(joints).read(morph_weights);
    posed = pass.modify(posed);
    pass.variant((data.joint_count > 0 ? shared::pose_has_skins : 0U) |
                 (data.morph_weight_count > 0 ? shared::pose_has_morphs : 0U));
    pass.push(constants).dispatch_items(constants.item_count);
    return posed;
}

} // namespace

MeshBuffers upload_meshes(gpu::Device& device, const MeshData& data)
{
    MeshBuffers meshes;
    meshes.rest_vertices = upload_buffer(device, "rest vertices", data.rest_vertices);
    meshes.skin_vertices = upload_buffer(device, "skin vertices", data.skin_vertices);
    meshes.morph_offsets = upload_buffer(device, "morph offsets", data.morph_offsets);
    meshes.triangles = upload_buffer(device, "triangles", data.triangles);
    meshes.stroke_coordinates = upload_buffer(device, "stroke coordinates", data.stroke_coordinates);
    meshes.draw_of_vertex = upload_buffer(device, "draw of vertex", data.draw_of_vertex);
    meshes.vertex_count = static_cast<uint32_t>(data.draw_of_vertex.size());
    for (gpu::Buffer& posed : meshes.posed_vertices) {
        posed = gpu::Buffer(device, "posed vertices", meshes.vertex_count * sizeof(shared::PosedVertex),
                            gpu::MemoryUse::device);
    }
    return meshes;
}

bool upload_pose(gpu::Device& device, MeshBuffers& meshes, MeshData& data, const PoseData& pose)
{
    const bool has_turned = turn_triangles(data, pose);
    if (has_turned) {
        meshes.triangles = upload_buffer(device, "triangles", data.triangles);
    }
    meshes.draws = upload_buffer(device, "draws", pose.draws);
    meshes.joints = upload_buffer(device, "joints", pose.joints);
    meshes.morph_weights = upload_buffer(device, "morph weights", pose.morph_weights);
    return has_turned;
}

void swap_posed(MeshBuffers& meshes)
{
    std::swap(meshes.posed_vertices[0], meshes.posed_vertices[1]);
    std::swap(meshes.posed_as[0], meshes.posed_as[1]);
}

gpu::BufferId add_pose_of_moved(gpu::Graph& graph, MeshBuffers& meshes, const MeshData& data,
                                const PoseData& now, std::span<const uint32_t> written_over,
                                gpu::BufferId draws, gpu::BufferId rest_vertices)
{
    PosedAs& posed = meshes.posed_as[0];
    const VertexRuns runs = runs_to_pose(data, posed.is_known ? &posed.pose : nullptr, now, written_over);
    posed.is_known = false; // the pose is unknown until the graph has run
    posed.pose = now;
    return add_runs(graph, meshes, data, runs, draws, rest_vertices);
}

void keep_posed(MeshBuffers& meshes)
{
    meshes.posed_as[0].is_known = true;
}

} // namespace estampe::pose
