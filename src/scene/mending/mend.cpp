// SPDX-License-Identifier: MIT
#include "scene/mending/mend.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>

#include <fmt/format.h>
#include <meshoptimizer.h>

#include "scene/gltf/geometry.hpp"

namespace estampe {
namespace {

constexpr float most_m = 1e15F; ///< beyond it, squares of lengths leave the range of floats
constexpr float crease_rad =
    0.82F; ///< 47 degrees, so that the eight sides of a coarse tube still run together

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
    std::vector<uint32_t> kept;
    kept.reserve(primitive.indices.size());
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
            "mesh \"{}\": {} faces left out, as their vertices are missing or not finite", name, dropped));
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

/// Faces around each place: the corners of place p are corners[first[p]] to corners[first[p + 1]].
struct CornersOfPlace {
    std::vector<uint32_t> first;
    std::vector<uint32_t> corners;
};

CornersOfPlace gather_corners(const std::vector<uint32_t>& place_of_corner, size_t places)
{
    CornersOfPlace result{.first = std::vector<uint32_t>(places + 1, 0),
                          .corners = std::vector<uint32_t>(place_of_corner.size())};
    for (const uint32_t place : place_of_corner)
        ++result.first[place + 1];
    std::partial_sum(result.first.begin(), result.first.end(), result.first.begin());
    std::vector<uint32_t> next(result.first.begin(), result.first.end() - 1);
    for (uint32_t corner = 0; corner < place_of_corner.size(); ++corner)
        result.corners[next[place_of_corner[corner]]++] = corner;
    return result;
}

/// What a corner adds to the normals around it: its face's unit normal, and the angle there as its weight.
struct CornerPart {
    glm::vec3 face{0.0F};
    float angle = 0.0F;
};

std::vector<CornerPart> corner_parts(const std::vector<glm::vec3>& positions)
{
    std::vector<CornerPart> parts(positions.size());
    for (size_t i = 0; i + 2 < positions.size(); i += 3) {
        const glm::dvec3 p[3] = {positions[i], positions[i + 1], positions[i + 2]};
        const glm::dvec3 cross = glm::cross(p[1] - p[0], p[2] - p[0]);
        const double length = glm::length(cross);
        if (!(length > 0.0))
            continue;
        for (size_t k = 0; k < 3; ++k) {
            const glm::dvec3 to_next = p[(k + 1) % 3] - p[k];
            const glm::dvec3 to_last = p[(k + 2) % 3] - p[k];
            parts[i + k] = {glm::vec3(cross / length),
                            static_cast<float>(std::atan2(length, glm::dot(to_next, to_last)))};
        }
    }
    return parts;
}

/// Mean normal of the corners whose faces turn no further from `face` than the cosine allows; of all, when it
/// is zero. The order of the sum is that of the corners, so that corners with equal neighbours get equal
/// bits.
glm::vec3 average(std::span<const uint32_t> corners, const std::vector<CornerPart>& parts,
                  const glm::vec3& face, float least_cosine)
{
    const bool all = face == glm::vec3(0.0F);
    glm::vec3 sum{0.0F};
    for (const uint32_t corner : corners)
        if (all || glm::dot(parts[corner].face, face) >= least_cosine)
            sum += parts[corner].angle * parts[corner].face;
    const float length = glm::length(sum);
    return length > 0.0F ? sum / length : glm::vec3(0.0F);
}

} // namespace

void make_crease_normals(Primitive& primitive, float sharpest_rad)
{
    gltf::pick_vertices(primitive, std::vector<uint32_t>(primitive.indices));
    std::iota(primitive.indices.begin(), primitive.indices.end(), 0U);
    const size_t count = primitive.positions.size();
    std::vector<uint32_t> place_of_corner(count);
    const size_t places = meshopt_generateVertexRemap(place_of_corner.data(), nullptr, count,
                                                      primitive.positions.data(), count, sizeof(glm::vec3));
    const CornersOfPlace around = gather_corners(place_of_corner, places);
    const std::vector<CornerPart> parts = corner_parts(primitive.positions);
    const float least_cosine = std::cos(sharpest_rad);
    primitive.normals.assign(count, glm::vec3(0.0F));
    for (size_t place = 0; place < places; ++place) {
        const std::span<const uint32_t> corners(around.corners.data() + around.first[place],
                                                around.corners.data() + around.first[place + 1]);
        // Where very many faces meet, one average for all keeps the cost linear.
        const bool crowded = corners.size() > 64;
        glm::vec3 shared{0.0F};
        for (size_t i = 0; i < corners.size(); ++i) {
            if (!crowded || i == 0)
                shared =
                    average(corners, parts, crowded ? glm::vec3(0.0F) : parts[corners[i]].face, least_cosine);
            primitive.normals[corners[i]] = shared;
        }
    }
}

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
    if (primitive.topology == Topology::triangles) {
        const bool given = !primitive.normals.empty();
        if (!given)
            make_crease_normals(primitive, crease_rad);
        const size_t repaired = gltf::repair_normals(primitive);
        if (given && repaired > 0)
            warnings.push_back(fmt::format("mesh \"{}\": {} bad normals replaced", name, repaired));
    }
    if (!primitive.joints_0.empty() && gltf::normalise_weights(primitive) > 0)
        warnings.push_back(fmt::format("mesh \"{}\": vertices that hang on no joint follow the first", name));
    share_vertices(primitive);
}

} // namespace estampe
