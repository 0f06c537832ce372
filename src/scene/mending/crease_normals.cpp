// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <future>
#include <numeric>
#include <span>

#include <meshoptimizer.h>

#include "core/at_once.hpp"
#include "scene/gltf/geometry.hpp"
#include "scene/mending/mend.hpp"

namespace estampe {
namespace {

/// Above, one thread is started besides this one.
constexpr size_t many = 50000;

/// Where more faces meet, one average for all keeps the cost linear.
constexpr size_t crowd = 64;

/// Calls work(begin, end) for both halves of 0 to `count`, at the same time when there are many.
template <typename Work>
void in_halves(size_t count, const Work& work)
{
    if (count < many) {
        work(size_t{0}, count);
        return;
    }
    std::future<void> second = std::async(at_once, [&] { work(count / 2, count); });
    work(size_t{0}, count / 2);
    second.get();
}

/// Corners around each place: those of place p are corners[first[p]] to corners[first[p + 1]], in their
/// order.
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
    // Counted one place further on, so that filling moves each start to where it belongs.
    for (const uint32_t vertex : primitive.indices)
        ++result.first[place_of_vertex[vertex] + 2];
    std::partial_sum(result.first.begin(), result.first.end(), result.first.begin());
    for (uint32_t corner = 0; corner < primitive.indices.size(); ++corner)
        result.corners[result.first[place_of_vertex[primitive.indices[corner]] + 1]++] = corner;
    result.first.pop_back();
    return result;
}

/// What faces add to the normals around them: their unit normals, zero without an area, weighted by the angle
/// at each corner.
struct FaceParts {
    std::vector<glm::vec3> normals;
    std::vector<float> angles; ///< of corners
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

/// Which faces at a place count for the normal of one.
class Neighbours {
public:
    Neighbours(const FaceParts& parts, std::span<const uint32_t> groups, float crease_rad)
        : parts_(parts), groups_(groups), least_cosine_(std::cos(crease_rad))
    {
    }

    /// Mean normal for a corner, of unit length; of all corners, when its face has no area or there is a
    /// crowd.
    [[nodiscard]] glm::vec3 average(std::span<const uint32_t> corners, uint32_t of) const
    {
        const glm::vec3 face = parts_.normals[of / 3];
        const uint32_t group = group_of(of);
        const bool all = shares_average(corners, of) || face == glm::vec3(0.0F);
        if (group == 0 && !all)
            return glm::normalize(face) + glm::vec3(0.0F); // no negative zeros, which have other bytes
        glm::vec3 sum{0.0F};
        // The order of the sum is that of the corners, so that corners with equal neighbours get equal bits.
        for (const uint32_t corner : corners) {
            const bool counts =
                all || (group_of(corner) == group &&
                        (group != no_index || glm::dot(parts_.normals[corner / 3], face) >= least_cosine_));
            if (counts)
                sum += parts_.angles[corner] * parts_.normals[corner / 3];
        }
        const float length = glm::length(sum);
        // Faces without an area have no direction: theirs is any.
        return length > 0.0F ? glm::normalize(sum / length) : glm::vec3(0.0F, 1.0F, 0.0F);
    }

    /// Whether the corner takes the one average of a crowd.
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

/// New vertices, each an old one with a normal; which of them each corner uses.
struct NewVertices {
    std::vector<uint32_t> old;
    std::vector<glm::vec3> normals;
};

/// Makes the new vertices of places `begin` to `end` and numbers them from `result.old.size()`.
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
            // In a crowd only the last few are compared; what is missed is a vertex too many.
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
    // Which half a corner's place is in.
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

} // namespace estampe
