// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <numeric>
#include <vector>

#include <fmt/format.h>

#include "scene/mending/mend.hpp"

namespace estampe {
namespace {

/// One side of a triangle, under the smaller of its two places.
struct Side {
    uint32_t other; ///< the larger place
    uint32_t triangle;
    bool rising; ///< whether it runs from the smaller place to the larger
};

/// Sides by their smaller place: those of place p are sides[first[p]] to sides[first[p + 1]].
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

/// Calls use(from, to, triangle) for each side, but not those of triangles that name a place twice.
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

/// A triangle beyond an edge, and whether both run along that edge the same way.
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

/// Pairs the triangles at edges that exactly two share; not a triangle with its own copy.
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

/// Whether any edge is run twice the same way.
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
            continue; // a surface with one side only, as a Moebius strip
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

} // namespace estampe
