// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>

#include <meshoptimizer.h>

#include "techniques/pose/mesh_data.hpp"

namespace estampe::pose {
namespace {

/// A triangle's side, filed under the lower number of the two places that it joins.
struct Side {
    uint32_t higher = 0;    ///< number of the other place
    uint32_t corner = 0;    ///< where it begins, an index of Primitive::indices
    bool goes_up = true;    ///< begins at the lower place
    bool is_paired = false; ///< has met the triangle beyond
};

/// The number of each vertex's place: an edge is the same one on both sides of a seam of the texture.
std::vector<uint32_t> number_places(const Primitive& primitive)
{
    std::vector<glm::vec3> positions = primitive.positions;
    for (glm::vec3& position : positions) {
        position += 0.0F; // -0 is 0
    }
    std::vector<uint32_t> places(positions.size());
    meshopt_generateVertexRemap(places.data(), nullptr, positions.size(), positions.data(), positions.size(),
                                sizeof(glm::vec3));
    return places;
}

uint32_t end_of(uint32_t corner)
{
    return corner % 3 == 2 ? corner - 2 : corner + 1;
}

/// Lengths of the edges between two triangles, and of those along which the texture is cut.
struct EdgeLengths {
    double inner = 0.0;
    double seams = 0.0;
};

class Edges {
public:
    explicit Edges(const Primitive& primitive)
        : primitive_(primitive), places_(number_places(primitive)), first_(places_.size() + 1, 0)
    {
    }

    EdgeLengths measure()
    {
        file_sides();
        for (size_t place = 0; place + 1 < first_.size(); ++place) {
            const std::span<Side> sides(sides_.data() + first_[place], first_[place + 1] - first_[place]);
            for (size_t i = 0; i < sides.size(); ++i) {
                pair_with_earlier(sides.first(i), sides[i]);
            }
        }
        return lengths_;
    }

private:
    [[nodiscard]] uint32_t place(uint32_t corner) const { return places_[primitive_.indices[corner]]; }

    /// Sorts by the lower place, and of one place by the triangles' order.
    void file_sides()
    {
        const auto count = static_cast<uint32_t>(primitive_.indices.size() / 3 * 3);
        for (uint32_t corner = 0; corner < count; ++corner) {
            ++first_[std::min(place(corner), place(end_of(corner))) + 1];
        }
        std::partial_sum(first_.begin(), first_.end(), first_.begin());
        sides_.resize(count);
        std::vector<uint32_t> next(first_.begin(), first_.end() - 1);
        for (uint32_t corner = 0; corner < count; ++corner) {
            const uint32_t from = place(corner);
            const uint32_t to = place(end_of(corner));
            sides_[next[std::min(from, to)]++] = {std::max(from, to), corner, from <= to};
        }
    }

    /// The last side before it that runs the other way between the same places and is still alone.
    void pair_with_earlier(std::span<Side> earlier, Side& side)
    {
        constexpr size_t most = 256; // where very many triangles meet, the nearest in the list will do
        const size_t first = earlier.size() - std::min(earlier.size(), most);
        for (size_t i = earlier.size(); i > first; --i) {
            Side& other = earlier[i - 1];
            if (!other.is_paired && other.higher == side.higher && other.goes_up != side.goes_up) {
                other.is_paired = true;
                side.is_paired = true;
                add(other.corner, side.corner);
                return;
            }
        }
    }

    void add(uint32_t there, uint32_t back)
    {
        const auto uv = [this](uint32_t corner) { return primitive_.uvs[0][primitive_.indices[corner]]; };
        const auto position = [this](uint32_t corner) {
            return primitive_.positions[primitive_.indices[corner]];
        };
        const double length = glm::distance(position(back), position(end_of(back)));
        const bool joined = glm::distance(uv(there), uv(end_of(back))) < 1e-4F &&
                            glm::distance(uv(end_of(there)), uv(back)) < 1e-4F;
        lengths_.inner += length;
        lengths_.seams += joined ? 0.0 : length;
    }

    const Primitive& primitive_;
    std::vector<uint32_t> places_; ///< one per vertex
    std::vector<uint32_t> first_;  ///< one per place, into sides_
    std::vector<Side> sides_;
    EdgeLengths lengths_;
};

/// Ratio of the larger to the smaller stretch of the map from a triangle to its texture; infinite when
/// degenerate.
float stretch(const glm::vec3& p0, const glm::vec3& p1, const glm::vec3& p2, glm::vec2 u0, glm::vec2 u1,
              glm::vec2 u2)
{
    const glm::vec3 a = p1 - p0;
    const glm::vec3 b = p2 - p0;
    const glm::vec2 s = u1 - u0;
    const glm::vec2 t = u2 - u0;
    const float area = s.x * t.y - s.y * t.x;
    const glm::vec3 along_u = a * t.y - b * s.y;
    const glm::vec3 along_v = b * s.x - a * t.x;
    const float uu = glm::dot(along_u, along_u);
    const float vv = glm::dot(along_v, along_v);
    const float uv = glm::dot(along_u, along_v);
    const float mean = 0.5F * (uu + vv);
    const float root = std::sqrt(std::max(0.0F, 0.25F * (uu - vv) * (uu - vv) + uv * uv));
    const bool degenerate = area == 0.0F || mean - root <= 1e-12F * mean;
    return degenerate ? std::numeric_limits<float>::infinity() : std::sqrt((mean + root) / (mean - root));
}

} // namespace

bool uvs_are_usable(const Primitive& primitive)
{
    const auto& uvs = primitive.uvs[0];
    if (uvs.size() != primitive.positions.size() || primitive.indices.size() < 3) {
        return false;
    }
    constexpr float most_stretch = 8.0F;
    constexpr double most_bad_area = 0.1;
    constexpr double most_seam_length = 0.12;
    double area_all = 0.0;
    double area_bad = 0.0;
    for (size_t i = 0; i + 2 < primitive.indices.size(); i += 3) {
        const uint32_t* corner = &primitive.indices[i];
        const glm::vec3& p0 = primitive.positions[corner[0]];
        const glm::vec3& p1 = primitive.positions[corner[1]];
        const glm::vec3& p2 = primitive.positions[corner[2]];
        const double area = glm::length(glm::cross(p1 - p0, p2 - p0));
        area_all += area;
        if (!(stretch(p0, p1, p2, uvs[corner[0]], uvs[corner[1]], uvs[corner[2]]) < most_stretch)) {
            area_bad += area;
        }
    }
    if (!(area_bad <= most_bad_area * area_all)) {
        return false;
    }
    const EdgeLengths lengths = Edges(primitive).measure();
    return lengths.seams <= most_seam_length * lengths.inner;
}

} // namespace estampe::pose
