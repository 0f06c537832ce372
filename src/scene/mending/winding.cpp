// SPDX-License-Identifier: MIT
// Repairs the winding of triangles: agree_winding() of mend.hpp, and turn_outside() of repair.hpp.
#include <algorithm>
#include <array>
#include <numeric>
#include <vector>

#include <fmt/format.h>

#include "scene/mending/mend.hpp"
#include "scene/mending/repair.hpp"

namespace estampe {
namespace {

/// One side of a triangle. The side is listed at the smaller of its two position numbers.
struct Side {
    uint32_t other; ///< position number (index of a distinct position) of the end with the larger number
    uint32_t triangle;
    bool rising; ///< the side runs from the smaller position number (index of a position) to the larger
};

/// All sides of triangles, sorted by the smaller of the two position numbers (indices of distinct positions).
/// The sides of position p are sides[first[p]] to sides[first[p + 1]].
struct Sides {
    std::vector<uint32_t> first;
    std::vector<Side> sides;
};

std::vector<uint32_t> places_of_corners(const Primitive& primitive, size_t& places)
{
    const std::vector<uint32_t> place = places_of_vertices(primitive, &places);
    std::vector<uint32_t> corners(primitive.indices.size() / 3 * 3);
    for (size_t i = 0; i < corners.size(); ++i)
        corners[i] = place[primitive.indices[i]];
    return corners;
}

/// Calls use(from, to, triangle) for each side of each triangle. Skips triangles that use a position twice.
template <typename Use>
void each_side(const std::vector<uint32_t>& corners, const Use& use)
{
    for (size_t i = 0; i < corners.size(); i += 3) {
        const uint32_t a = corners[i];
        const uint32_t b = corners[i + 1];
        const uint32_t c = corners[i + 2];
        if (a == b || b == c || c == a)
            continue;
        const auto triangle = static_cast<uint32_t>(i / 3);
        use(a, b, triangle);
        use(b, c, triangle);
        use(c, a, triangle);
    }
}

Sides gather_sides(const std::vector<uint32_t>& corners, size_t places)
{
    Sides result{.first = std::vector<uint32_t>(places + 2, 0), .sides = {}};
    each_side(corners, [&](uint32_t from, uint32_t to, uint32_t) { ++result.first[std::min(from, to) + 2]; });
    std::partial_sum(result.first.begin(), result.first.end(), result.first.begin());
    result.sides.resize(result.first.back());
    each_side(corners, [&](uint32_t from, uint32_t to, uint32_t triangle) {
        result.sides[result.first[std::min(from, to) + 1]++] = {std::max(from, to), triangle, from < to};
    });
    result.first.pop_back();
    for (size_t place = 0; place < places; ++place)
        std::sort(result.sides.begin() + result.first[place], result.sides.begin() + result.first[place + 1],
                  [](const Side& a, const Side& b) {
                      return a.other != b.other ? a.other < b.other : a.triangle < b.triangle;
                  });
    return result;
}

/// The neighbour across an edge of a triangle. `against` means that both triangles run along the edge in the
/// same direction, so that their windings contradict.
struct EdgeNeighbour {
    uint32_t triangle = no_index;
    bool against = false;
};

struct EdgeNeighbours {
    std::vector<std::array<EdgeNeighbour, 3>> of_triangle;
    bool any_against = false;
};

bool same_places(const std::vector<uint32_t>& corners, uint32_t one, uint32_t other)
{
    const uint32_t* const a = &corners[size_t{3} * one];
    const uint32_t* const b = &corners[size_t{3} * other];
    return std::is_permutation(a, a + 3, b);
}

/// Finds the neighbours of triangles across all edges that exactly two triangles share. A triangle is not a
/// neighbour of a copy of itself.
EdgeNeighbours pair_triangles(const std::vector<uint32_t>& corners, const Sides& sides)
{
    EdgeNeighbours result;
    result.of_triangle.resize(corners.size() / 3);
    const auto add = [&](uint32_t triangle, const EdgeNeighbour& neighbour) {
        for (EdgeNeighbour& slot : result.of_triangle[triangle]) {
            if (slot.triangle == no_index) {
                slot = neighbour;
                return;
            }
        }
    };
    for (size_t place = 0; place + 1 < sides.first.size(); ++place) {
        const size_t end = sides.first[place + 1];
        for (size_t i = sides.first[place]; i < end;) {
            size_t next = i + 1;
            while (next < end && sides.sides[next].other == sides.sides[i].other)
                ++next;
            const Side& one = sides.sides[i];
            if (next - i == 2 && !same_places(corners, one.triangle, sides.sides[i + 1].triangle)) {
                const Side& two = sides.sides[i + 1];
                const bool against = one.rising == two.rising;
                result.any_against = result.any_against || against;
                add(one.triangle, {two.triangle, against});
                add(two.triangle, {one.triangle, against});
            }
            i = next;
        }
    }
    return result;
}

/// Returns whether there is an edge along which two triangles run in the same direction, so that their
/// windings contradict.
bool any_edge_run_twice(const std::vector<uint32_t>& corners, size_t places)
{
    std::vector<uint32_t> first(places + 2, 0);
    each_side(corners, [&](uint32_t from, uint32_t, uint32_t) { ++first[from + 2]; });
    std::partial_sum(first.begin(), first.end(), first.begin());
    std::vector<uint32_t> ends(first.back());
    each_side(corners, [&](uint32_t from, uint32_t to, uint32_t) { ends[first[from + 1]++] = to; });
    std::vector<uint32_t> seen_from(places, no_index);
    for (uint32_t place = 0; place < places; ++place) {
        for (size_t i = first[place]; i < first[place + 1]; ++i) {
            if (seen_from[ends[i]] == place)
                return true;
            seen_from[ends[i]] = place;
        }
    }
    return false;
}

double area(const Primitive& primitive, uint32_t triangle)
{
    const uint32_t* const corners = &primitive.indices[size_t{3} * triangle];
    const glm::dvec3 a = primitive.positions[corners[0]];
    return glm::length(glm::cross(glm::dvec3(primitive.positions[corners[1]]) - a,
                                  glm::dvec3(primitive.positions[corners[2]]) - a));
}

} // namespace

size_t agree_winding(Primitive& primitive)
{
    size_t places = 0;
    const std::vector<uint32_t> corners = places_of_corners(primitive, places);
    if (!any_edge_run_twice(corners, places))
        return 0;
    const EdgeNeighbours neighbours = pair_triangles(corners, gather_sides(corners, places));
    if (!neighbours.any_against)
        return 0;
    constexpr uint8_t unseen = 2;
    std::vector<uint8_t> side(corners.size() / 3, unseen);
    std::vector<uint32_t> piece;
    size_t turned = 0;
    for (uint32_t start = 0; start < side.size(); ++start) {
        if (side[start] != unseen)
            continue;
        piece.assign(1, start);
        side[start] = 0;
        bool agrees = true;
        double areas[2] = {0.0, 0.0};
        for (size_t next = 0; next < piece.size(); ++next) {
            const uint32_t triangle = piece[next];
            areas[side[triangle]] += area(primitive, triangle);
            for (const EdgeNeighbour& neighbour : neighbours.of_triangle[triangle]) {
                if (neighbour.triangle == no_index)
                    continue;
                const auto wanted = static_cast<uint8_t>(side[triangle] ^ (neighbour.against ? 1U : 0U));
                uint8_t& found = side[neighbour.triangle];
                if (found == unseen) {
                    found = wanted;
                    piece.push_back(neighbour.triangle);
                }
                agrees = agrees && found == wanted;
            }
        }
        if (!agrees)
            continue; // the surface has only one side, like a Moebius strip, and is not changed
        const uint8_t minority = areas[1] <= areas[0] ? 1 : 0;
        for (const uint32_t triangle : piece) {
            if (side[triangle] == minority) {
                turn_triangle(primitive, triangle);
                ++turned;
            }
        }
    }
    return turned;
}

void agree_winding(Primitive& primitive, const std::string& name, std::vector<std::string>& warnings)
{
    if (const size_t turned = agree_winding(primitive); turned > 0)
        warnings.push_back(
            fmt::format("mesh \"{}\": {} triangles ran against their neighbours, turned", name, turned));
}

namespace {

/// Disjoint sets (union-find) of the positions that triangles connect.
class Sets {
public:
    explicit Sets(size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0U); }

    uint32_t find(uint32_t i)
    {
        while (parent_[i] != i) {
            parent_[i] = parent_[parent_[i]];
            i = parent_[i];
        }
        return i;
    }

    void join(uint32_t a, uint32_t b) { parent_[find(a)] = find(b); }

private:
    std::vector<uint32_t> parent_;
};

/// A piece of a surface: triangles that are connected by shared positions.
struct SurfacePiece {
    Bounds bounds;
    double volume_m3 = 0.0;
    /// The piece is closed and consistently wound, and its back faces point outwards.
    bool is_inside_out = false;
    std::vector<uint32_t> triangles; ///< triangles of the piece; only filled if the piece is inside out
};

/// Splits a primitive into pieces, which are triangles connected by shared positions.
class Pieces {
public:
    explicit Pieces(const Primitive& primitive)
        : primitive_(primitive), places_(places_of_vertices(primitive)), sets_(places_.size())
    {
        for (size_t t = 0; t < triangle_count(); ++t) {
            sets_.join(place(t, 0), place(t, 1));
            sets_.join(place(t, 0), place(t, 2));
        }
    }

    std::vector<SurfacePiece> run()
    {
        std::vector<uint32_t> piece_of_set(places_.size(), no_index);
        std::vector<uint32_t> piece_of_triangle(triangle_count());
        for (size_t t = 0; t < triangle_count(); ++t) {
            uint32_t& number = piece_of_set[sets_.find(place(t, 0))];
            if (number == no_index) {
                number = static_cast<uint32_t>(pieces_.size());
                pieces_.emplace_back();
            }
            piece_of_triangle[t] = number;
            SurfacePiece& piece = pieces_[number];
            std::array<glm::dvec3, 3> corners;
            for (size_t k = 0; k < 3; ++k) {
                corners[k] = primitive_.positions[primitive_.indices[3 * t + k]];
                piece.bounds.extend(corners[k]);
            }
            piece.volume_m3 += glm::dot(corners[0], glm::cross(corners[1], corners[2])) / 6.0;
        }
        // Triangles are listed only for pieces with negative volume. Pieces with negative volume are few, and
        // lists of triangles are long.
        if (std::ranges::any_of(pieces_, [](const SurfacePiece& piece) { return piece.volume_m3 < 0.0; })) {
            for (uint32_t t = 0; t < triangle_count(); ++t)
                if (SurfacePiece& piece = pieces_[piece_of_triangle[t]]; piece.volume_m3 < 0.0)
                    piece.triangles.push_back(t);
        }
        for (SurfacePiece& piece : pieces_) {
            piece.is_inside_out = piece.volume_m3 < 0.0 && is_closed(piece);
            if (!piece.is_inside_out)
                std::vector<uint32_t>().swap(piece.triangles);
        }
        return std::move(pieces_);
    }

private:
    [[nodiscard]] size_t triangle_count() const { return primitive_.indices.size() / 3; }

    [[nodiscard]] uint32_t place(size_t t, size_t k) const { return places_[primitive_.indices[3 * t + k]]; }

    /// Returns whether two corners of a triangle are at the same position, as at the poles of many spheres. A
    /// triangle with equal corners has no area and is skipped.
    [[nodiscard]] bool has_collapsed(size_t t) const
    {
        return place(t, 0) == place(t, 1) || place(t, 1) == place(t, 2) || place(t, 2) == place(t, 0);
    }

    /// Returns a number that identifies a directed side of a triangle; spread() computes a hash of this
    /// number.
    static uint64_t side(uint32_t from, uint32_t to) { return uint64_t{from} << 32U | to; }

    static uint64_t spread(uint64_t number)
    {
        number = (number ^ number >> 30U) * 0xBF58476D1CE4E5B9U;
        number = (number ^ number >> 27U) * 0x94D049BB133111EBU;
        return number ^ number >> 31U;
    }

    /// Calls `take(from, to)` for each side of each triangle of the piece.
    template <typename Take>
    void for_sides(const SurfacePiece& piece, const Take& take) const
    {
        for (const uint32_t t : piece.triangles)
            for (size_t k = 0; k < 3 && !has_collapsed(t); ++k)
                take(place(t, k), place(t, (k + 1) % 3));
    }

    /// Returns whether a piece is closed: each side of each triangle has exactly one neighbour, which runs in
    /// the opposite direction.
    [[nodiscard]] bool is_closed(const SurfacePiece& piece) const
    {
        // Compares the sum of the hashes of all sides with the sum for the opposite directions. The sums
        // differ for almost all open pieces, because some sides have no neighbour. The slower test by sorting
        // is therefore rarely needed.
        uint64_t difference = 0;
        for_sides(piece, [&](uint32_t from, uint32_t to) {
            difference += spread(side(from, to)) - spread(side(to, from));
        });
        if (difference != 0)
            return false;
        std::vector<uint64_t> ways;
        std::vector<uint64_t> back;
        for_sides(piece, [&](uint32_t from, uint32_t to) {
            ways.push_back(side(from, to));
            back.push_back(side(to, from));
        });
        std::sort(ways.begin(), ways.end());
        if (std::adjacent_find(ways.begin(), ways.end()) != ways.end())
            return false;
        std::sort(back.begin(), back.end());
        return ways == back;
    }

    const Primitive& primitive_;
    std::vector<uint32_t> places_;
    Sets sets_;
    std::vector<SurfacePiece> pieces_;
};

void turn_over(Primitive& primitive, const SurfacePiece& piece)
{
    double agreement = 0.0;
    std::vector<uint32_t> vertices;
    for (const uint32_t t : piece.triangles) {
        turn_triangle(primitive, t);
        const uint32_t* const corners = &primitive.indices[size_t{3} * t];
        const glm::dvec3 a = primitive.positions[corners[0]];
        const glm::dvec3 normal = glm::cross(glm::dvec3(primitive.positions[corners[1]]) - a,
                                             glm::dvec3(primitive.positions[corners[2]]) - a);
        for (size_t k = 0; k < 3; ++k) {
            agreement += glm::dot(normal, glm::dvec3(primitive.normals[corners[k]]));
            vertices.push_back(corners[k]);
        }
    }
    if (agreement >= 0.0) {
        return;
    }
    std::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    for (const uint32_t vertex : vertices) {
        primitive.normals[vertex] = -primitive.normals[vertex];
        if (!primitive.tangents.empty()) {
            primitive.tangents[vertex].w = -primitive.tangents[vertex].w;
        }
        for (MorphTarget& target : primitive.morph_targets) {
            if (!target.normal_offsets.empty()) {
                target.normal_offsets[vertex] = -target.normal_offsets[vertex];
            }
        }
    }
}

/// A piece of a primitive, and its bounds in world space.
struct PlacedPiece {
    Primitive* primitive;
    SurfacePiece piece;
    Bounds world;
    Index mesh;
};

bool contains(const Bounds& outer, const Bounds& inner)
{
    return glm::all(glm::lessThan(outer.min, inner.min)) && glm::all(glm::lessThan(inner.max, outer.max));
}

std::vector<PlacedPiece> placed_pieces(Scene& scene)
{
    const ScenePose pose = pose_scene(scene, 0.0, no_index);
    std::vector<glm::dmat4> world_from_mesh(scene.meshes.size(), glm::dmat4(1.0));
    for (size_t node = 0; node < scene.nodes.size(); ++node) {
        if (scene.nodes[node].mesh != no_index) {
            world_from_mesh[scene.nodes[node].mesh] = pose.world_from_node[node];
        }
    }
    std::vector<PlacedPiece> placed;
    for (Index mesh = 0; mesh < scene.meshes.size(); ++mesh) {
        for (Primitive& primitive : scene.meshes[mesh].primitives) {
            const bool is_one_sided = primitive.material < scene.materials.size() &&
                                      !scene.materials[primitive.material].double_sided;
            if (primitive.topology != Topology::triangles || is_one_sided) {
                continue;
            }
            for (SurfacePiece& piece : Pieces(primitive).run()) {
                Bounds world;
                for (int corner = 0; corner < 8; ++corner) {
                    const glm::dvec3 at((corner & 1) != 0 ? piece.bounds.max.x : piece.bounds.min.x,
                                        (corner & 2) != 0 ? piece.bounds.max.y : piece.bounds.min.y,
                                        (corner & 4) != 0 ? piece.bounds.max.z : piece.bounds.min.z);
                    world.extend(glm::dvec3(world_from_mesh[mesh] * glm::dvec4(at, 1.0)));
                }
                placed.push_back({&primitive, std::move(piece), world, mesh});
            }
        }
    }
    return placed;
}

} // namespace

void turn_outside(Scene& scene)
{
    const std::vector<PlacedPiece> placed = placed_pieces(scene);
    // Bounds of the pieces that may be inside a room, sorted by their smallest x. Each room is then compared
    // with few pieces.
    std::vector<Bounds> furniture;
    if (std::ranges::any_of(placed, [](const PlacedPiece& piece) { return piece.piece.is_inside_out; }))
        for (const PlacedPiece& piece : placed)
            if (!piece.piece.is_inside_out)
                furniture.push_back(piece.world);
    const auto left_of = [](const Bounds& bounds) { return bounds.min.x; };
    std::ranges::sort(furniture, {}, left_of);
    std::vector<size_t> turned(scene.meshes.size(), 0);
    for (const PlacedPiece& piece : placed) {
        const bool is_room = piece.piece.is_inside_out &&
                             std::any_of(std::ranges::upper_bound(furniture, piece.world.min.x, {}, left_of),
                                         std::ranges::lower_bound(furniture, piece.world.max.x, {}, left_of),
                                         [&](const Bounds& other) { return contains(piece.world, other); });
        if (piece.piece.is_inside_out && !is_room) {
            turn_over(*piece.primitive, piece.piece);
            ++turned[piece.mesh];
        }
    }
    for (Index mesh = 0; mesh < scene.meshes.size(); ++mesh) {
        if (turned[mesh] > 0) {
            scene.warnings.push_back(fmt::format("mesh \"{}\": {} closed piece{} inside out, turned over",
                                                 scene.meshes[mesh].name, turned[mesh],
                                                 turned[mesh] == 1 ? " was" : "s were"));
        }
    }
}

} // namespace estampe
