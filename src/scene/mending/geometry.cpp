// SPDX-License-Identifier: MIT
// Computes and repairs vertices, normals and tangents of a primitive.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <future>
#include <numeric>
#include <span>

#include <meshoptimizer.h>

#include "core/long_jobs.hpp"
#include "scene/mending/mend.hpp"

namespace estampe::gltf {
namespace {

template <typename Value>
void pick(std::vector<Value>& values, const std::vector<uint32_t>& order)
{
    if (values.empty()) {
        return;
    }
    std::vector<Value> picked;
    picked.reserve(order.size());
    for (const uint32_t vertex : order) {
        picked.push_back(values[vertex]);
    }
    values = std::move(picked);
}

glm::dvec3 face_cross(const Primitive& primitive, size_t corner)
{
    const glm::dvec3 a(primitive.positions[primitive.indices[corner]]);
    const glm::dvec3 b(primitive.positions[primitive.indices[corner + 1]]);
    const glm::dvec3 c(primitive.positions[primitive.indices[corner + 2]]);
    return glm::cross(b - a, c - a);
}

/// Normalises `vector`. Returns `otherwise` if `vector` has no direction.
glm::dvec3 unit_or(const glm::dvec3& vector, const glm::dvec3& otherwise)
{
    const double length = glm::length(vector);
    return std::isfinite(length) && length > 1e-150 ? vector / length : otherwise;
}

/// Returns any unit vector perpendicular to `normal`.
glm::dvec3 some_tangent(const glm::dvec3& normal)
{
    const glm::dvec3 axis = std::abs(normal.x) < 0.9 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
    return glm::normalize(axis - normal * glm::dot(axis, normal));
}

bool is_usable(const glm::vec3& normal)
{
    const float length_squared = glm::dot(normal, normal);
    return std::isfinite(length_squared) && length_squared > 1e-12F;
}

} // namespace

std::vector<uint32_t> list_indices(int mode, const std::vector<uint32_t>& indices)
{
    const size_t count = indices.size();
    std::vector<uint32_t> list;
    const auto triangle = [&](uint32_t a, uint32_t b, uint32_t c) {
        if (a != b && b != c && c != a) {
            list.insert(list.end(), {a, b, c});
        }
    };
    switch (mode) {
    case 0:
        return indices;
    case 1:
        return {indices.begin(), indices.end() - static_cast<std::ptrdiff_t>(count % 2)};
    case 2:
    case 3:
        for (size_t i = 0; i + 1 < count; ++i) {
            list.insert(list.end(), {indices[i], indices[i + 1]});
        }
        if (mode == 2 && count > 2) {
            list.insert(list.end(), {indices.back(), indices.front()});
        }
        return list;
    case 5:
        for (size_t i = 0; i + 2 < count; ++i) {
            triangle(indices[i], indices[i + 1 + i % 2], indices[i + 2 - i % 2]);
        }
        return list;
    case 6:
        for (size_t i = 1; i + 1 < count; ++i) {
            triangle(indices[0], indices[i], indices[i + 1]);
        }
        return list;
    default:
        return {indices.begin(), indices.end() - static_cast<std::ptrdiff_t>(count % 3)};
    }
}

void pick_vertices(Primitive& primitive, const std::vector<uint32_t>& order)
{
    pick(primitive.positions, order);
    pick(primitive.normals, order);
    pick(primitive.tangents, order);
    pick(primitive.uvs[0], order);
    pick(primitive.uvs[1], order);
    pick(primitive.colors, order);
    pick(primitive.joints_0, order);
    pick(primitive.joints_1, order);
    pick(primitive.weights_0, order);
    pick(primitive.weights_1, order);
    for (MorphTarget& target : primitive.morph_targets) {
        pick(target.position_offsets, order);
        pick(target.normal_offsets, order);
    }
}

void drop_unused_vertices(Primitive& primitive)
{
    constexpr uint32_t unused = no_index;
    std::vector<uint32_t> new_of_old(primitive.positions.size(), unused);
    std::vector<uint32_t> order;
    for (const uint32_t index : primitive.indices) {
        if (new_of_old[index] == unused) {
            new_of_old[index] = 0;
            order.push_back(index);
        }
    }
    if (order.size() * 2 > primitive.positions.size()) {
        return;
    }
    for (uint32_t i = 0; i < order.size(); ++i) {
        new_of_old[order[i]] = i;
    }
    pick_vertices(primitive, order);
    for (uint32_t& index : primitive.indices) {
        index = new_of_old[index];
    }
}

void make_flat_normals(Primitive& primitive)
{
    const std::vector<uint32_t> order = primitive.indices;
    primitive.normals.clear();
    primitive.tangents.clear();
    pick_vertices(primitive, order);
    for (uint32_t i = 0; i < order.size(); ++i) {
        primitive.indices[i] = i;
    }
    primitive.normals.resize(order.size());
    for (size_t corner = 0; corner + 2 < order.size(); corner += 3) {
        const glm::vec3 normal(unit_or(face_cross(primitive, corner), glm::dvec3(0, 1, 0)));
        std::fill_n(primitive.normals.begin() + static_cast<std::ptrdiff_t>(corner), 3, normal);
    }
}

size_t repair_normals(Primitive& primitive)
{
    size_t bad = 0;
    for (glm::vec3& normal : primitive.normals) {
        if (is_usable(normal)) {
            normal = glm::normalize(normal);
        } else {
            normal = glm::vec3(0.0F);
            ++bad;
        }
    }
    if (bad == 0) {
        return 0;
    }
    std::vector<glm::dvec3> sums(primitive.positions.size(), glm::dvec3(0.0));
    for (size_t corner = 0; corner + 2 < primitive.indices.size(); corner += 3) {
        const glm::dvec3 cross = face_cross(primitive, corner);
        for (size_t i = corner; i < corner + 3; ++i) {
            sums[primitive.indices[i]] += cross;
        }
    }
    for (size_t i = 0; i < sums.size(); ++i) {
        if (primitive.normals[i] == glm::vec3(0.0F)) {
            primitive.normals[i] = glm::vec3(unit_or(sums[i], glm::dvec3(0, 1, 0)));
        }
    }
    return bad;
}

void make_tangents(Primitive& primitive, uint32_t uv_set)
{
    const std::vector<glm::vec2>& uvs = primitive.uvs[uv_set];
    const size_t count = primitive.positions.size();
    std::vector<glm::dvec3> along_u(count, glm::dvec3(0.0));
    std::vector<glm::dvec3> along_v(count, glm::dvec3(0.0));
    for (size_t corner = 0; corner + 2 < primitive.indices.size(); corner += 3) {
        const uint32_t* index = &primitive.indices[corner];
        const glm::dvec3 edge_1 =
            glm::dvec3(primitive.positions[index[1]]) - glm::dvec3(primitive.positions[index[0]]);
        const glm::dvec3 edge_2 =
            glm::dvec3(primitive.positions[index[2]]) - glm::dvec3(primitive.positions[index[0]]);
        const glm::dvec2 uv_1 = glm::dvec2(uvs[index[1]]) - glm::dvec2(uvs[index[0]]);
        const glm::dvec2 uv_2 = glm::dvec2(uvs[index[2]]) - glm::dvec2(uvs[index[0]]);
        const double orientation = uv_1.x * uv_2.y - uv_2.x * uv_1.y < 0.0 ? -1.0 : 1.0;
        const double area = glm::length(glm::cross(edge_1, edge_2));
        const glm::dvec3 u = orientation * area * unit_or(edge_1 * uv_2.y - edge_2 * uv_1.y, glm::dvec3(0.0));
        const glm::dvec3 v = orientation * area * unit_or(edge_2 * uv_1.x - edge_1 * uv_2.x, glm::dvec3(0.0));
        for (size_t i = 0; i < 3; ++i) {
            along_u[index[i]] += u;
            along_v[index[i]] += v;
        }
    }
    primitive.tangents.resize(count);
    for (size_t i = 0; i < count; ++i) {
        const glm::dvec3 normal(primitive.normals[i]);
        const glm::dvec3 flat = along_u[i] - normal * glm::dot(normal, along_u[i]);
        const glm::dvec3 tangent = unit_or(flat, some_tangent(normal));
        const double sign = glm::dot(glm::cross(normal, tangent), along_v[i]) < 0.0 ? -1.0 : 1.0;
        primitive.tangents[i] = glm::vec4(glm::dvec4(tangent, sign));
    }
}

size_t normalise_weights(Primitive& primitive)
{
    size_t without_weight = 0;
    const bool two_sets = !primitive.weights_1.empty();
    for (size_t vertex = 0; vertex < primitive.weights_0.size(); ++vertex) {
        glm::vec4 none(0.0F);
        glm::u16vec4 nothing(0);
        glm::vec4* weights[] = {&primitive.weights_0[vertex],
                                two_sets ? &primitive.weights_1[vertex] : &none};
        glm::u16vec4* joints[] = {&primitive.joints_0[vertex],
                                  two_sets ? &primitive.joints_1[vertex] : &nothing};
        double sum = 0.0;
        for (int i = 0; i < 8; ++i) {
            float& weight = (*weights[i / 4])[i % 4];
            if (!std::isfinite(weight) || weight <= 0.0F) {
                weight = 0.0F;
            }
            sum += weight;
        }
        if (sum < 1e-6) {
            ++without_weight;
            *weights[0] = glm::vec4(1.0F, 0.0F, 0.0F, 0.0F);
            *weights[1] = glm::vec4(0.0F);
            sum = 1.0;
        }
        for (int i = 0; i < 8; ++i) {
            float& weight = (*weights[i / 4])[i % 4];
            weight = static_cast<float>(weight / sum);
            if (weight == 0.0F) {
                (*joints[i / 4])[i % 4] = 0;
            }
        }
    }
    return without_weight;
}

} // namespace estampe::gltf

namespace estampe {
namespace {

/// Smallest number of items for which a second thread is started; for fewer items, starting a thread takes
/// too long.
constexpr size_t many = 50000;

/// At a position where more faces than this meet, all faces share one average normal. The shared normal keeps
/// the cost linear in faces.
constexpr size_t crowd = 64;

/// Calls work(begin, end) for each half of the range 0 to `count`. The halves run in parallel if `count` is
/// large.
template <typename Work>
void in_halves(size_t count, const Work& work)
{
    if (count < many) {
        work(size_t{0}, count);
        return;
    }
    std::future<void> second = std::async(launch_if_possible, [&] { work(count / 2, count); });
    work(size_t{0}, count / 2);
    second.get();
}

/// List of the triangles' corners at each vertex position. The corners at position p are corners[first[p]] to
/// corners[first[p + 1]], in ascending order.
struct CornersOfPlace {
    std::vector<uint32_t> first;
    std::vector<uint32_t> corners;
};

CornersOfPlace gather_corners(const Primitive& primitive)
{
    const size_t vertices = primitive.positions.size();
    std::vector<uint32_t> place_of_vertex(vertices);
    const size_t places = meshopt_generateVertexRemap(
        place_of_vertex.data(), nullptr, vertices, primitive.positions.data(), vertices, sizeof(glm::vec3));
    CornersOfPlace result{.first = std::vector<uint32_t>(places + 2, 0),
                          .corners = std::vector<uint32_t>(primitive.indices.size())};
    // Counts are stored one entry later than their position. While the corners are filled in, each start
    // advances to its final value.
    for (const uint32_t vertex : primitive.indices)
        ++result.first[place_of_vertex[vertex] + 2];
    std::partial_sum(result.first.begin(), result.first.end(), result.first.begin());
    for (uint32_t corner = 0; corner < primitive.indices.size(); ++corner)
        result.corners[result.first[place_of_vertex[primitive.indices[corner]] + 1]++] = corner;
    result.first.pop_back();
    return result;
}

/// The contribution of each face to vertex normals: the unit normal of the face, weighted by the face's angle
/// at the corner. Faces with zero area have a zero normal.
struct FaceParts {
    std::vector<glm::vec3> normals;
    std::vector<float> angles; ///< one angle per corner
};

FaceParts face_parts(const Primitive& primitive)
{
    const size_t faces = primitive.indices.size() / 3;
    FaceParts parts{.normals = std::vector<glm::vec3>(faces, glm::vec3(0.0F)),
                    .angles = std::vector<float>(3 * faces, 0.0F)};
    in_halves(faces, [&](size_t begin, size_t end) {
        for (size_t face = begin; face < end; ++face) {
            glm::dvec3 p[3];
            for (size_t k = 0; k < 3; ++k)
                p[k] = primitive.positions[primitive.indices[3 * face + k]];
            const glm::dvec3 cross = glm::cross(p[1] - p[0], p[2] - p[0]);
            const double length = glm::length(cross);
            if (!(length > 0.0))
                continue;
            parts.normals[face] = glm::vec3(cross / length);
            for (size_t k = 0; k < 3; ++k) {
                const glm::dvec3 to_next = p[(k + 1) % 3] - p[k];
                const glm::dvec3 to_last = p[(k + 2) % 3] - p[k];
                parts.angles[3 * face + k] =
                    static_cast<float>(std::atan2(length, glm::dot(to_next, to_last)));
            }
        }
    });
    return parts;
}

/// Decides which of the faces at a vertex position contribute to the normal of a corner.
class Neighbours {
public:
    Neighbours(const FaceParts& parts, std::span<const uint32_t> groups, float crease_rad)
        : parts_(parts), groups_(groups), least_cosine_(std::cos(crease_rad))
    {
    }

    /// Averages the unit normals of the faces that contribute to corner `of`. If the corner's face has no
    /// area, or if many faces meet at the position, all faces at the position contribute.
    [[nodiscard]] glm::vec3 average(std::span<const uint32_t> corners, uint32_t of) const
    {
        const glm::vec3 face = parts_.normals[of / 3];
        const uint32_t group = group_of(of);
        const bool all = shares_average(corners, of) || face == glm::vec3(0.0F);
        if (group == 0 && !all)
            // Adding zero removes negative zeros, whose bytes differ from those of positive zeros.
            return glm::normalize(face) + glm::vec3(0.0F);
        glm::vec3 sum{0.0F};
        // Normals are added in the order of the corners. Corners with the same neighbours then get bitwise
        // equal normals.
        for (const uint32_t corner : corners) {
            const bool counts =
                all || (group_of(corner) == group &&
                        (group != no_index || glm::dot(parts_.normals[corner / 3], face) >= least_cosine_));
            if (counts)
                sum += parts_.angles[corner] * parts_.normals[corner / 3];
        }
        const float length = glm::length(sum);
        // If all faces have zero area, no direction is right, so any unit vector is returned.
        return length > 0.0F ? glm::normalize(sum / length) : glm::vec3(0.0F, 1.0F, 0.0F);
    }

    /// Returns whether a corner uses the average normal that all faces share at a position where many faces
    /// meet.
    [[nodiscard]] bool shares_average(std::span<const uint32_t> corners, uint32_t corner) const
    {
        return corners.size() > crowd &&
               (group_of(corner) != 0 || parts_.normals[corner / 3] == glm::vec3(0.0F));
    }

private:
    [[nodiscard]] uint32_t group_of(uint32_t corner) const
    {
        return groups_.empty() ? no_index : groups_[corner / 3];
    }

    const FaceParts& parts_;
    std::span<const uint32_t> groups_;
    float least_cosine_;
};

bool same_bits(const glm::vec3& a, const glm::vec3& b)
{
    using Bits = std::array<uint32_t, 3>;
    return std::bit_cast<Bits>(a) == std::bit_cast<Bits>(b);
}

/// New vertices; each is an old vertex with a new normal.
struct NewVertices {
    std::vector<uint32_t> old;
    std::vector<glm::vec3> normals;
};

/// Creates the new vertices at the positions `begin` to `end` and appends them to `result`. Sets the new
/// vertex of each corner.
void make_vertices(const Primitive& primitive, const CornersOfPlace& around, const Neighbours& neighbours,
                   size_t begin, size_t end, NewVertices& result, std::vector<uint32_t>& vertex_of_corner)
{
    for (size_t place = begin; place < end; ++place) {
        const std::span<const uint32_t> corners(around.corners.data() + around.first[place],
                                                around.corners.data() + around.first[place + 1]);
        const size_t first = result.old.size();
        const bool is_crowded = corners.size() > crowd;
        glm::vec3 shared{0.0F};
        bool has_shared = false;
        for (const uint32_t corner : corners) {
            glm::vec3 normal = shared;
            const bool shares = neighbours.shares_average(corners, corner);
            if (!shares || !has_shared)
                normal = neighbours.average(corners, corner);
            if (shares) {
                shared = normal;
                has_shared = true;
            }
            const uint32_t old = primitive.indices[corner];
            size_t found = first;
            // If many corners meet at a position, only the last few new vertices are compared. A missed match
            // only adds a duplicate vertex.
            if (is_crowded && result.old.size() - first > crowd)
                found = result.old.size() - crowd;
            while (found < result.old.size() &&
                   (result.old[found] != old || !same_bits(result.normals[found], normal)))
                ++found;
            if (found == result.old.size()) {
                result.old.push_back(old);
                result.normals.push_back(normal);
            }
            vertex_of_corner[corner] = static_cast<uint32_t>(found);
        }
    }
}

} // namespace

void make_crease_normals(Primitive& primitive, float crease_rad, std::span<const uint32_t> groups)
{
    primitive.normals.clear();
    share_vertices(primitive);
    const CornersOfPlace around = gather_corners(primitive);
    const FaceParts parts = face_parts(primitive);
    const Neighbours neighbours(parts, groups, crease_rad);
    std::vector<uint32_t> vertex_of_corner(primitive.indices.size());
    const size_t places = around.first.size() - 1;
    std::array<NewVertices, 2> made;
    const size_t middle = places < many ? places : places / 2;
    in_halves(places, [&](size_t begin, size_t end) {
        make_vertices(primitive, around, neighbours, begin, end, made[begin == 0 ? 0 : 1], vertex_of_corner);
    });
    // For each corner: whether its position is in the second half of the list of positions.
    std::vector<bool> is_second(primitive.indices.size(), false);
    for (size_t i = around.first[middle]; i < around.corners.size(); ++i)
        is_second[around.corners[i]] = true;

    const auto first_count = static_cast<uint32_t>(made[0].old.size());
    std::vector<uint32_t> new_of_made(first_count + made[1].old.size(), no_index);
    std::vector<uint32_t> order;
    std::vector<glm::vec3> normals;
    order.reserve(new_of_made.size());
    normals.reserve(new_of_made.size());
    for (size_t corner = 0; corner < primitive.indices.size(); ++corner) {
        const size_t half = is_second[corner] ? 1 : 0;
        const uint32_t vertex = vertex_of_corner[corner];
        uint32_t& number = new_of_made[vertex + (half == 1 ? first_count : 0)];
        if (number == no_index) {
            number = static_cast<uint32_t>(order.size());
            order.push_back(made[half].old[vertex]);
            normals.push_back(made[half].normals[vertex]);
        }
        primitive.indices[corner] = number;
    }
    gltf::pick_vertices(primitive, order);
    primitive.normals = std::move(normals);
}

void compute_normals(Primitive& primitive, float crease_rad)
{
    make_crease_normals(primitive, crease_rad);
}

} // namespace estampe
