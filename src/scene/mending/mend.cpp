// SPDX-License-Identifier: MIT
#include "scene/mending/mend.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>
#include <meshoptimizer.h>

#include <estampe/error.hpp>

#include "core/long_jobs.hpp"

namespace estampe {

std::vector<uint32_t> places_of_vertices(const Primitive& primitive, size_t* count)
{
    // Vertices are compared by bytes. Negative zeros become positive here, because their bytes differ.
    std::vector<glm::vec3> positions = primitive.positions;
    for (glm::vec3& position : positions) {
        position += 0.0F;
    }
    std::vector<uint32_t> places(positions.size());
    const size_t found = meshopt_generateVertexRemap(places.data(), nullptr, positions.size(),
                                                     positions.data(), positions.size(), sizeof(glm::vec3));
    if (count != nullptr) {
        *count = found;
    }
    return places;
}

void turn_triangle(Primitive& primitive, size_t triangle)
{
    std::swap(primitive.indices[3 * triangle + 1], primitive.indices[3 * triangle + 2]);
    if (!primitive.edge_marks.empty()) {
        uint8_t& marks = primitive.edge_marks[triangle];
        // Swapping two corners swaps the first and the last edge, so their marks are swapped too.
        marks = static_cast<uint8_t>((marks & ~5U) | (marks & 1U) << 2U | (marks >> 2U & 1U));
    }
}

void check_structure(const Scene& scene, const std::string& where)
{
    const std::vector<std::string> found = faults(scene);
    if (!found.empty())
        throw Error("is damaged: " + found.front(), where,
                    "check that the file opens in other programs, or convert it to glTF");
}

namespace {

/// Coordinates above this limit are unusable, because squares of lengths overflow floats.
constexpr float farthest_vertex_m = 1e15F;

size_t corners_of(Topology topology)
{
    return topology == Topology::triangles ? 3 : topology == Topology::lines ? 2 : 1;
}

bool usable(const glm::vec3& position)
{
    // The comparison is written with `<`, so that the result is false for NaN.
    return std::abs(position.x) < farthest_vertex_m && std::abs(position.y) < farthest_vertex_m &&
           std::abs(position.z) < farthest_vertex_m;
}

void drop_bad_elements(Primitive& primitive, const std::string& name, std::vector<std::string>& warnings)
{
    const size_t corners = corners_of(primitive.topology);
    const bool all_usable = std::all_of(primitive.positions.begin(), primitive.positions.end(), usable);
    if (all_usable && primitive.indices.size() % corners == 0 &&
        std::all_of(primitive.indices.begin(), primitive.indices.end(),
                    [&primitive](uint32_t index) { return index < primitive.positions.size(); }))
        return;
    std::vector<uint32_t> kept;
    for (size_t i = 0; i + corners <= primitive.indices.size(); i += corners) {
        const auto first = primitive.indices.begin() + static_cast<std::ptrdiff_t>(i);
        const auto last = first + static_cast<std::ptrdiff_t>(corners);
        if (std::all_of(first, last, [&primitive](uint32_t index) {
                return index < primitive.positions.size() && usable(primitive.positions[index]);
            }))
            kept.insert(kept.end(), first, last);
    }
    const size_t dropped = (primitive.indices.size() - kept.size() + corners - 1) / corners;
    if (dropped > 0)
        warnings.push_back(fmt::format(
            "mesh \"{}\": {} {} left out, as their vertices are missing or not finite", name, dropped,
            corners == 3   ? "faces"
            : corners == 2 ? "lines"
                           : "points"));
    primitive.indices = std::move(kept);
}

/// Clears a vertex attribute whose length is wrong. Replaces values that are not finite by zero.
template <typename Vector>
void mend_attribute(std::vector<Vector>& values, size_t vertices)
{
    if (values.size() != vertices)
        values.clear();
    for (Vector& value : values)
        for (int i = 0; i < Vector::length(); ++i)
            if (!std::isfinite(value[i]))
                value[i] = 0.0F;
}

void mend_attributes(Primitive& primitive)
{
    const size_t vertices = primitive.positions.size();
    mend_attribute(primitive.normals, vertices);
    mend_attribute(primitive.uvs[0], vertices);
    mend_attribute(primitive.uvs[1], vertices);
    mend_attribute(primitive.colors, vertices);
    for (MorphTarget& target : primitive.morph_targets) {
        mend_attribute(target.position_offsets, vertices);
        mend_attribute(target.normal_offsets, vertices);
    }
    if (primitive.joints_0.size() != vertices || primitive.joints_1.size() != vertices ||
        primitive.weights_0.size() != vertices || primitive.weights_1.size() != vertices) {
        primitive.joints_0.clear();
        primitive.joints_1.clear();
        primitive.weights_0.clear();
        primitive.weights_1.clear();
    }
}

} // namespace

void share_vertices(Primitive& primitive)
{
    const size_t vertices = primitive.positions.size();
    std::vector<meshopt_Stream> streams;
    const auto add = [&streams](const auto& values) {
        if (!values.empty())
            streams.push_back({values.data(), sizeof(values[0]), sizeof(values[0])});
    };
    add(primitive.positions);
    add(primitive.normals);
    add(primitive.uvs[0]);
    add(primitive.uvs[1]);
    add(primitive.colors);
    add(primitive.joints_0);
    add(primitive.joints_1);
    add(primitive.weights_0);
    add(primitive.weights_1);
    for (const MorphTarget& target : primitive.morph_targets) {
        add(target.position_offsets);
        add(target.normal_offsets);
    }
    // meshoptimizer compares at most 16 vertex attributes. If a mesh has more attributes, its vertices are
    // not merged.
    if (streams.size() > 16 || primitive.indices.empty())
        return;
    // meshoptimizer requires that the number of indices is a multiple of three, also for lines and points.
    std::vector<uint32_t> named = primitive.indices;
    named.resize((named.size() + 2) / 3 * 3, named.back());
    std::vector<uint32_t> new_of_old(vertices);
    const size_t count = meshopt_generateVertexRemapMulti(new_of_old.data(), named.data(), named.size(),
                                                          vertices, streams.data(), streams.size());
    std::vector<uint32_t> order(count);
    for (uint32_t old = 0; old < vertices; ++old)
        if (new_of_old[old] != no_index)
            order[new_of_old[old]] = old;
    gltf::pick_vertices(primitive, order);
    for (uint32_t& index : primitive.indices)
        index = new_of_old[index];
}

void mend_primitive(Primitive& primitive, const std::string& name, std::vector<std::string>& warnings)
{
    mend_attributes(primitive);
    drop_bad_elements(primitive, name, warnings);
    // Vertices are compared by bytes. Negative zeros become positive here, because their bytes differ.
    for (glm::vec3& position : primitive.positions)
        position += glm::vec3(0.0F);
    if (!primitive.joints_0.empty() && gltf::normalise_weights(primitive) > 0)
        warnings.push_back(fmt::format("mesh \"{}\": vertices that hang on no joint follow the first", name));
    if (primitive.topology == Topology::triangles) {
        if (primitive.normals.empty()) {
            agree_winding(primitive, name, warnings);
            make_crease_normals(primitive, usual_crease_rad);
            return;
        }
        if (const size_t repaired = gltf::repair_normals(primitive); repaired > 0)
            warnings.push_back(fmt::format("mesh \"{}\": {} bad normals replaced", name, repaired));
    }
    share_vertices(primitive);
}

namespace {

// Shares of the load time at which the repair of meshes begins and ends; files are read before the repair.
constexpr double mending_from = 0.4;
constexpr double mending_to = 0.85;

} // namespace

void mend_meshes(Scene& scene, const std::string& where)
{
    if (scene.materials.empty()) {
        scene.materials.emplace_back();
        scene.materials.front().double_sided = true;
    }
    size_t elements = 0;
    size_t done = 0;
    for (Mesh& mesh : scene.meshes) {
        size_t targets = 0;
        for (Primitive& primitive : mesh.primitives) {
            if (primitive.material >= scene.materials.size())
                primitive.material = 0;
            mend_primitive(primitive, mesh.name, scene.warnings);
            targets = std::max(targets, primitive.morph_targets.size());
        }
        std::erase_if(mesh.primitives, [](const Primitive& primitive) { return primitive.indices.empty(); });
        mesh.morph_weights.assign(targets, 0.0F);
        elements += mesh.primitives.size();
        report_progress(std::lerp(mending_from, mending_to,
                                  static_cast<double>(++done) / static_cast<double>(scene.meshes.size())));
    }
    if (elements == 0)
        throw Error(scene.warnings.empty() ? std::string("has no triangles, lines or points")
                                           : fmt::format("has nothing to draw ({})", scene.warnings.back()),
                    where, "give a file with meshes");
}

namespace {

/// Computes tangents for all primitives whose material has a normal map.
void make_needed_tangents(Scene& scene)
{
    for (Mesh& mesh : scene.meshes) {
        for (Primitive& primitive : mesh.primitives) {
            const TextureRef& normals = scene.materials[primitive.material].normal_texture;
            if (normals.texture != no_index && primitive.topology == Topology::triangles &&
                !primitive.uvs[normals.uv_set].empty())
                gltf::make_tangents(primitive, normals.uv_set);
        }
    }
}

} // namespace

void finish_import(Scene& scene, const std::string& where)
{
    mend_meshes(scene, where);
    check_structure(scene, where);
    make_needed_tangents(scene);
}

} // namespace estampe
