// SPDX-License-Identifier: MIT
// Analysis of single primitives for build_meshes(): meshes of lines and points, the number of layers behind
// each other, and whether texture coordinates can carry strokes.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <set>
#include <span>
#include <tuple>

#include <meshoptimizer.h>

#include "techniques/pose/mesh_data.hpp"

namespace estampe::pose {
namespace {

/// Copies a vertex's attributes to a vertex with a new position and normal, so that the new vertex moves like
/// its source.
class Copier {
public:
    Copier(const Primitive& source, Primitive& target) : source_(source), target_(target)
    {
        target.morph_targets.resize(source.morph_targets.size());
    }

    uint32_t add(uint32_t from, const glm::vec3& position, const glm::vec3& normal)
    {
        const auto copy = [from](const auto& values, auto& copies) {
            if (from < values.size()) {
                copies.push_back(values[from]);
            }
        };
        copy(source_.colors, target_.colors);
        copy(source_.joints_0, target_.joints_0);
        copy(source_.joints_1, target_.joints_1);
        copy(source_.weights_0, target_.weights_0);
        copy(source_.weights_1, target_.weights_1);
        for (size_t i = 0; i < source_.morph_targets.size(); ++i) {
            copy(source_.morph_targets[i].position_offsets, target_.morph_targets[i].position_offsets);
        }
        target_.positions.push_back(position);
        target_.normals.push_back(normal);
        return static_cast<uint32_t>(target_.positions.size() - 1);
    }

private:
    const Primitive& source_;
    Primitive& target_;
};

constexpr uint32_t sides_around = 5;

void add_wire(const Primitive& source, Copier& copier, Primitive& target, uint32_t from, uint32_t to,
              float radius)
{
    const glm::vec3 a = source.positions[from];
    const glm::vec3 b = source.positions[to];
    const glm::vec3 along = b - a;
    if (!(glm::length(along) > 0.0F)) {
        return;
    }
    const glm::vec3 helper =
        std::abs(along.y) < 0.9F * glm::length(along) ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0);
    const glm::vec3 x = glm::normalize(glm::cross(helper, along));
    const glm::vec3 y = glm::normalize(glm::cross(along, x));
    std::array<uint32_t, sides_around> ring_a{};
    std::array<uint32_t, sides_around> ring_b{};
    for (uint32_t i = 0; i < sides_around; ++i) {
        const float angle = 6.2831853F * static_cast<float>(i) / static_cast<float>(sides_around);
        const glm::vec3 outward = std::cos(angle) * x + std::sin(angle) * y;
        ring_a[i] = copier.add(from, a + radius * outward, outward);
        ring_b[i] = copier.add(to, b + radius * outward, outward);
    }
    for (uint32_t i = 0; i < sides_around; ++i) {
        const uint32_t next = (i + 1) % sides_around;
        target.indices.insert(target.indices.end(),
                              {ring_a[i], ring_a[next], ring_b[next], ring_a[i], ring_b[next], ring_b[i]});
    }
}

void add_dot(const Primitive& source, Copier& copier, Primitive& target, uint32_t vertex, float radius)
{
    std::array<uint32_t, 6> corner{};
    for (uint32_t i = 0; i < 6; ++i) {
        glm::vec3 outward(0.0F);
        outward[static_cast<int>(i / 2)] = i % 2 == 0 ? 1.0F : -1.0F;
        corner[i] = copier.add(vertex, source.positions[vertex] + radius * outward, outward);
    }
    for (uint32_t octant = 0; octant < 8; ++octant) {
        const uint32_t x = corner[octant & 1U];
        const uint32_t y = corner[2 + ((octant >> 1U) & 1U)];
        const uint32_t z = corner[4 + ((octant >> 2U) & 1U)];
        const bool flipped = ((octant ^ (octant >> 1U) ^ (octant >> 2U)) & 1U) != 0;
        target.indices.insert(target.indices.end(), {x, flipped ? z : y, flipped ? y : z});
    }
}

} // namespace

Primitive drawn_body(const Primitive& primitive, float radius_m)
{
    Primitive body;
    body.material = primitive.material;
    Copier copier(primitive, body);
    if (primitive.topology == Topology::lines) {
        for (size_t i = 0; i + 1 < primitive.indices.size(); i += 2) {
            add_wire(primitive, copier, body, primitive.indices[i], primitive.indices[i + 1], radius_m);
        }
    } else {
        for (const uint32_t vertex : primitive.indices) {
            add_dot(primitive, copier, body, vertex, 2.0F * radius_m);
        }
    }
    return body;
}

namespace {

constexpr size_t most_triangles = 1U << 16U; // most triangles of a primitive whose layers are analysed
constexpr size_t most_tests = 1U << 24U;     // most tests of a corner against a triangle's plane

/// Gives vertices at one position a common number, so that meshes with split vertices along edges stay
/// connected.
std::vector<uint32_t> weld(const std::vector<glm::vec3>& positions)
{
    std::map<std::tuple<float, float, float>, uint32_t> places;
    std::vector<uint32_t> first_at;
    first_at.reserve(positions.size());
    for (const glm::vec3& p : positions) {
        first_at.push_back(
            places.try_emplace({p.x, p.y, p.z}, static_cast<uint32_t>(first_at.size())).first->second);
    }
    return first_at;
}

uint32_t root_of(std::vector<uint32_t>& parents, uint32_t vertex)
{
    while (parents[vertex] != vertex) {
        parents[vertex] = parents[parents[vertex]];
        vertex = parents[vertex];
    }
    return vertex;
}

/// The connected parts of a primitive; each part is a list of corners, three per triangle.
std::vector<std::vector<uint32_t>> parts_of(const Primitive& primitive)
{
    const std::vector<uint32_t> welded = weld(primitive.positions);
    std::vector<uint32_t> parents(welded.size());
    std::iota(parents.begin(), parents.end(), 0U);
    const auto& indices = primitive.indices;
    for (size_t i = 0; i + 2 < indices.size(); i += 3) {
        for (const size_t k : {i + 1, i + 2}) {
            parents[root_of(parents, welded[indices[k]])] = root_of(parents, welded[indices[i]]);
        }
    }
    std::map<uint32_t, std::vector<uint32_t>> parts;
    for (size_t i = 0; i + 2 < indices.size(); i += 3) {
        auto& part = parts[root_of(parents, welded[indices[i]])];
        part.insert(part.end(), {welded[indices[i]], welded[indices[i + 1]], welded[indices[i + 2]]});
    }
    std::vector<std::vector<uint32_t>> result;
    result.reserve(parts.size());
    for (auto& [root, part] : parts) {
        result.push_back(std::move(part));
    }
    return result;
}

enum class Form : uint8_t { flat, convex, other };

/// Form of a connected part of a mesh. The part is flat if all corners lie in the plane of every triangle.
/// The part is convex if all corners lie on one side of every triangle's plane.
Form form_of(const std::vector<glm::vec3>& positions, const std::vector<uint32_t>& part)
{
    const std::set<uint32_t> corners(part.begin(), part.end());
    if (part.size() / 3 * corners.size() > most_tests) {
        return Form::other;
    }
    Bounds bounds;
    for (const uint32_t corner : corners) {
        bounds.extend(positions[corner]);
    }
    const double radius = bounds.radius();
    // Rounding error of positions in 32-bit floats.
    const double rounding = 1.2e-7 * (glm::length(bounds.center()) + radius);
    bool has_below = false;
    bool has_above = false;
    for (size_t i = 0; i < part.size() && !(has_below && has_above); i += 3) {
        const glm::dvec3 a(positions[part[i]]);
        const glm::dvec3 ab = glm::dvec3(positions[part[i + 1]]) - a;
        const glm::dvec3 ac = glm::dvec3(positions[part[i + 2]]) - a;
        const glm::dvec3 across = glm::cross(ab, ac);
        const double twice_area = glm::length(across);
        // The plane of a very thin triangle is inaccurate, so the tolerance grows with the triangle's length
        // over its width.
        const double breadth =
            twice_area / std::max({glm::length(ab), glm::length(ac), glm::length(ac - ab)});
        const double tolerance = 1e-5 * radius + 4.0 * radius * rounding / breadth;
        if (!(twice_area > 0.0)) {
            continue;
        }
        for (const uint32_t corner : corners) {
            const double height = glm::dot(across, glm::dvec3(positions[corner]) - a) / twice_area;
            has_below = has_below || height < -tolerance;
            has_above = has_above || height > tolerance;
        }
    }
    return has_below && has_above ? Form::other : has_below || has_above ? Form::convex : Form::flat;
}

} // namespace

uint32_t most_sheets(const Primitive& primitive, bool two_sided, uint32_t enough)
{
    const bool bends = !primitive.joints_0.empty() || !primitive.morph_targets.empty();
    if (bends || primitive.indices.size() > 3 * most_triangles) {
        return enough;
    }
    uint32_t sheets = 0;
    for (const std::vector<uint32_t>& part : parts_of(primitive)) {
        const Form form = form_of(primitive.positions, part);
        sheets += form == Form::flat ? 1 : form == Form::convex ? (two_sided ? 2 : 1) : enough;
        if (sheets >= enough) {
            return enough;
        }
    }
    return sheets;
}

namespace {

/// An edge of a triangle, stored under the lower position number (equal for all vertices at one position) of
/// its two ends.
struct Side {
    uint32_t higher = 0;    ///< the higher position number (a number per position) of the edge's two ends
    uint32_t corner = 0;    ///< the edge's first corner, an index into Primitive::indices
    bool goes_up = true;    ///< the edge runs from the end with the lower position number to the other end
    bool is_paired = false; ///< the neighbouring triangle's edge has been found
};

/// Numbers vertices by position, so that an edge at a texture seam is the same edge on both sides.
std::vector<uint32_t> number_places(const Primitive& primitive)
{
    std::vector<glm::vec3> positions = primitive.positions;
    for (glm::vec3& position : positions) {
        position += 0.0F; // converts -0 to 0
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

/// Finds the pairs of triangles that share an edge.
class Edges {
public:
    explicit Edges(const Primitive& primitive)
        : primitive_(primitive), places_(number_places(primitive)), first_(places_.size() + 1, 0)
    {
    }

    /// Calls `take(there, back)` for each edge between two triangles, with the edge's first corner in either
    /// triangle: `back` runs against `there`.
    template <class Take>
    void visit(const Take& take)
    {
        file_sides();
        for (size_t place = 0; place + 1 < first_.size(); ++place) {
            const std::span<Side> sides(sides_.data() + first_[place], first_[place + 1] - first_[place]);
            for (size_t i = 0; i < sides.size(); ++i) {
                if (const Side* const other = pair_with_earlier(sides.first(i), sides[i])) {
                    take(other->corner, sides[i].corner);
                }
            }
        }
    }

private:
    [[nodiscard]] uint32_t place(uint32_t corner) const { return places_[primitive_.indices[corner]]; }

    /// Sorts edges by the lower position number (equal for all vertices at one position) of their two ends.
    /// Edges with equal numbers stay in the triangles' order.
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

    /// Pairs an edge with the last unpaired earlier edge that runs the opposite way. Returns that edge, or
    /// null if there is none.
    static const Side* pair_with_earlier(std::span<Side> earlier, Side& side)
    {
        constexpr size_t most = 256; // limits the search at vertices with very many triangles
        const size_t first = earlier.size() - std::min(earlier.size(), most);
        for (size_t i = earlier.size(); i > first; --i) {
            Side& other = earlier[i - 1];
            if (!other.is_paired && other.higher == side.higher && other.goes_up != side.goes_up) {
                other.is_paired = true;
                side.is_paired = true;
                return &other;
            }
        }
        return nullptr;
    }

    const Primitive& primitive_;
    /// Position number of each vertex (equal for all vertices at one position).
    std::vector<uint32_t> places_;
    std::vector<uint32_t> first_; ///< for each position number, the index in sides_ of the first edge
    std::vector<Side> sides_;
};

/// Total length of inner edges, and total length of inner edges on texture seams.
struct EdgeLengths {
    double inner = 0.0;
    double seams = 0.0;
};

EdgeLengths measure_edges(const Primitive& primitive)
{
    const auto uv = [&](uint32_t corner) { return primitive.uvs[0][primitive.indices[corner]]; };
    const auto position = [&](uint32_t corner) { return primitive.positions[primitive.indices[corner]]; };
    EdgeLengths lengths;
    Edges(primitive).visit([&](uint32_t there, uint32_t back) {
        const double length = glm::distance(position(back), position(end_of(back)));
        const bool joined = glm::distance(uv(there), uv(end_of(back))) < 1e-4F &&
                            glm::distance(uv(end_of(there)), uv(back)) < 1e-4F;
        lengths.inner += length;
        lengths.seams += joined ? 0.0 : length;
    });
    return lengths;
}

/// Ratio of the larger to the smaller stretch of the map from a triangle to its texture; infinite for a
/// degenerate triangle.
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
    const EdgeLengths lengths = measure_edges(primitive);
    return lengths.seams <= most_seam_length * lengths.inner;
}

namespace {

/// Whether a surface folds by more than 45 degrees at many edges: more than 10 % of the number of triangles.
/// Triangles without area fold nothing.
bool has_many_folds(const Primitive& primitive)
{
    constexpr float fold_cosine = 0.7071F;
    constexpr size_t triangles_per_fold = 10;
    const auto normal_of = [&](uint32_t corner) { // as long as the triangle is large
        const uint32_t* first = &primitive.indices[corner / 3 * 3];
        const glm::vec3& origin = primitive.positions[first[0]];
        return glm::cross(primitive.positions[first[1]] - origin, primitive.positions[first[2]] - origin);
    };
    size_t folds = 0;
    Edges(primitive).visit([&](uint32_t there, uint32_t back) {
        const glm::vec3 one = normal_of(there);
        const glm::vec3 other = normal_of(back);
        const float lengths = glm::length(one) * glm::length(other);
        folds += lengths > 0.0F && glm::dot(one, other) < fold_cosine * lengths ? 1 : 0;
    });
    return folds * triangles_per_fold > primitive.indices.size() / 3;
}

} // namespace

bool is_round(const Primitive& primitive)
{
    constexpr float least_bend_cosine = 0.9997F; // cosine of 1.5 degrees
    constexpr double least_curved_share = 0.6;
    constexpr double least_roundness = 0.2;
    if (primitive.normals.size() != primitive.positions.size()) {
        return false;
    }
    double area_all = 0.0;
    double area_curved = 0.0;
    glm::dvec3 sum(0.0);
    glm::dmat3 products(0.0);
    for (size_t i = 0; i + 2 < primitive.indices.size(); i += 3) {
        const uint32_t* corner = &primitive.indices[i];
        const glm::vec3& origin = primitive.positions[corner[0]];
        const double area = glm::length(
            glm::cross(primitive.positions[corner[1]] - origin, primitive.positions[corner[2]] - origin));
        const glm::vec3& a = primitive.normals[corner[0]];
        const glm::vec3& b = primitive.normals[corner[1]];
        const glm::vec3& c = primitive.normals[corner[2]];
        const float least_cosine = std::min({glm::dot(a, b), glm::dot(b, c), glm::dot(c, a)});
        area_all += area;
        if (least_cosine < least_bend_cosine) {
            const glm::dvec3 normal(glm::normalize(a + b + c));
            area_curved += area;
            sum += area * normal;
            products += area * glm::outerProduct(normal, normal);
        }
    }
    if (!(area_curved > 0.0 && area_curved >= least_curved_share * area_all)) {
        return false;
    }
    // The covariance of the normals: a third of the unit matrix for a sphere, singular for a cylinder or
    // cone.
    const glm::dvec3 mean = sum / area_curved;
    const glm::dmat3 covariance = products / area_curved - glm::outerProduct(mean, mean);
    const double third = (covariance[0][0] + covariance[1][1] + covariance[2][2]) / 3.0;
    return glm::determinant(covariance) > least_roundness * third * third * third &&
           !has_many_folds(primitive);
}

} // namespace estampe::pose
