// SPDX-License-Identifier: MIT
#include "scene/mending/mend.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <meshoptimizer.h>

#include "scene/gltf/geometry.hpp"

namespace estampe {
namespace {

constexpr float most_m = 1e15F; ///< beyond it, squares of lengths leave the range of floats

size_t corners_of(Topology topology)
{
    return topology == Topology::triangles ? 3 : topology == Topology::lines ? 2 : 1;
}

bool usable(const glm::vec3& position)
{
    // Written so that NaN fails.
    return std::abs(position.x) < most_m && std::abs(position.y) < most_m && std::abs(position.z) < most_m;
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

/// Clears an attribute of the wrong length; replaces what is not finite by zero.
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
    // More streams than meshoptimizer compares: such a mesh keeps its vertices.
    if (streams.size() > 16 || primitive.indices.empty())
        return;
    // meshoptimizer counts in triangles, whatever the indices stand for.
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
    // Negative zero is equal to zero but not the same bytes, and vertices are compared by bytes.
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

} // namespace estampe
