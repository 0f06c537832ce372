// SPDX-License-Identifier: MIT
#include "techniques/cells/cells.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include <estampe/error.hpp>

namespace estampe::cells {
namespace {

constexpr size_t most_corners = 12;
constexpr uint32_t most_steps = 4096;
constexpr size_t most_beams = 512;
/// Widens boxes and views, to allow for the rounding of positions to floats.
constexpr double slack_m = 1e-3;

/// A visible part of a portal, with positions relative to the eye. Clipping adds corners.
using Polygon = InlineVector<glm::dvec3, 2 * most_corners>;

glm::dvec3 middle_of(std::span<const glm::dvec3> corners)
{
    glm::dvec3 sum(0.0);
    for (const glm::dvec3& corner : corners) {
        sum += corner;
    }
    return sum / static_cast<double>(corners.size());
}

/// Normal of a polygon, with the polygon's area as its length (Newell's method).
glm::dvec3 normal_of(std::span<const glm::dvec3> corners)
{
    glm::dvec3 sum(0.0);
    for (size_t i = 0; i < corners.size(); ++i) {
        sum += glm::cross(corners[i] - corners[0], corners[(i + 1) % corners.size()] - corners[0]);
    }
    return 0.5 * sum;
}

/// Cuts off the part of a polygon beyond a side of a beam. The inside is widened by `margin` times the
/// distance. Measured like this, the distance from the side is a convex function, so a cut at the zero of its
/// chord keeps too much of an edge, and never too little.
Polygon clipped(const Polygon& polygon, const glm::dvec3& side, double margin)
{
    const auto inside = [&](const glm::dvec3& place) {
        return glm::dot(side, place) + margin * glm::length(place) + slack_m;
    };
    Polygon kept;
    for (size_t i = 0; i < polygon.size(); ++i) {
        const glm::dvec3& here = polygon[i];
        const glm::dvec3& next = polygon[(i + 1) % polygon.size()];
        const double from = inside(here);
        const double to = inside(next);
        if (kept.size() + 2 > 2 * most_corners) {
            return polygon;
        }
        if (from >= 0.0) {
            kept.push_back(here);
        }
        if ((from >= 0.0) != (to >= 0.0)) {
            kept.push_back(here + from / (from - to) * (next - here));
        }
    }
    return kept;
}

/// The planes through the eye and the edges of a polygon. Leaves out edges that are too short on the page to
/// give a plane; a beam with fewer sides is wider.
Sides sides_of(const Polygon& polygon, double margin)
{
    const glm::dvec3 middle = middle_of({polygon.data(), polygon.size()});
    Sides sides;
    for (size_t i = 0; i < polygon.size() && sides.size() < 12; ++i) {
        const glm::dvec3& a = polygon[i];
        const glm::dvec3& b = polygon[(i + 1) % polygon.size()];
        const glm::dvec3 normal = glm::cross(a, b);
        const double length = glm::length(normal);
        if (length <= std::max(0.1 * margin, 1e-9) * glm::length(a) * glm::length(b)) {
            continue;
        }
        sides.push_back((glm::dot(normal, middle) < 0.0 ? -1.0 : 1.0) / length * normal);
    }
    return sides;
}

/// Distance from the origin to a convex polygon.
double distance_of(std::span<const glm::dvec3> corners)
{
    const glm::dvec3 normal = glm::normalize(normal_of(corners));
    bool is_over = true; // the origin's foot on the plane lies within the polygon
    double nearest = std::numeric_limits<double>::infinity();
    for (size_t i = 0; i < corners.size(); ++i) {
        const glm::dvec3& a = corners[i];
        const glm::dvec3 along = corners[(i + 1) % corners.size()] - a;
        is_over = is_over && glm::dot(glm::cross(along, -a), normal) >= 0.0;
        const double share = glm::clamp(-glm::dot(a, along) / glm::dot(along, along), 0.0, 1.0);
        nearest = std::min(nearest, glm::length(a + share * along));
    }
    return is_over ? std::abs(glm::dot(corners[0], normal)) : nearest;
}

/// Whether a box reaches outside of all cells from number `first` on, by more than rounding.
bool reaches_outdoors(std::span<const SceneCell> cells, const Bounds& box, size_t first = 0)
{
    constexpr double rounding_m = 1e-4;
    for (size_t i = first; i < cells.size(); ++i) {
        const glm::dvec3 low = glm::max(box.min, cells[i].low_m);
        const glm::dvec3 high = glm::min(box.max, cells[i].high_m);
        if (glm::any(glm::lessThanEqual(high, low))) {
            continue;
        }
        // The parts of the box beside this cell must lie in the cells that follow.
        Bounds left = box;
        for (int axis = 0; axis < 3; ++axis) {
            Bounds below = left;
            below.max[axis] = low[axis];
            Bounds above = left;
            above.min[axis] = high[axis];
            if ((low[axis] - left.min[axis] > rounding_m && reaches_outdoors(cells, below, i + 1)) ||
                (left.max[axis] - high[axis] > rounding_m && reaches_outdoors(cells, above, i + 1))) {
                return true;
            }
            left.min[axis] = low[axis];
            left.max[axis] = high[axis];
        }
        return false;
    }
    return true;
}

bool touches(const SceneCell& cell, const Bounds& box)
{
    return glm::all(glm::lessThanEqual(box.min, cell.high_m)) &&
           glm::all(glm::lessThanEqual(cell.low_m, box.max));
}

Bounds grown(const Bounds& box, double by_m)
{
    return {box.min - by_m, box.max + by_m};
}

[[noreturn]] void fail(const char* kind, size_t number, const std::string& problem)
{
    throw Error(fmt::format("{} {} of the scene {}", kind, number, problem), "cells and portals",
                "see estampe::SceneCell and estampe::ScenePortal");
}

} // namespace

std::optional<Eye> eye_of(const glm::mat4& clip_from_anchor, const glm::dvec3& anchor, glm::uvec2 size_px)
{
    const glm::dmat4 rows = glm::transpose(glm::dmat4(clip_from_anchor));
    const glm::dmat3 axes =
        glm::transpose(glm::dmat3(glm::dvec3(rows[0]), glm::dvec3(rows[1]), glm::dvec3(rows[3])));
    if (std::abs(glm::determinant(axes)) < 1e-12) {
        return std::nullopt;
    }
    // The eye is the place whose x, y and w in clip space are 0.
    const glm::dvec3 place = -(glm::inverse(axes) * glm::dvec3(rows[0].w, rows[1].w, rows[3].w));
    Eye eye;
    eye.place_m = anchor + place;
    const glm::dmat4 anchor_from_clip = glm::inverse(glm::dmat4(clip_from_anchor));
    for (int corner = 0; corner < 4; ++corner) {
        const glm::dvec4 near = anchor_from_clip * glm::dvec4((corner & 1) != 0 ? 1.0 : -1.0,
                                                              (corner & 2) != 0 ? 1.0 : -1.0, 1.0, 1.0);
        eye.near_m = std::max(eye.near_m, glm::length(glm::dvec3(near) / near.w - place));
    }
    const glm::dvec3 ahead(rows[3]);
    for (int axis = 0; axis < 2; ++axis) {
        // A tile of a page has a row with a share of `ahead`, which moves the tile beside the page's middle.
        const glm::dvec3 row(rows[axis]);
        const glm::dvec3 across = row - glm::dot(row, ahead) / glm::dot(ahead, ahead) * ahead;
        const double pixels = static_cast<double>(size_px[axis]) * glm::length(across);
        eye.margin = std::max(eye.margin, glm::length(ahead) / pixels);
        for (const double sign : {1.0, -1.0}) {
            eye.sides.push_back(glm::normalize(glm::dvec3(rows[3] + sign * rows[axis])));
        }
    }
    return eye;
}

void check_cells(const Scene& scene)
{
    const auto is_finite = [](const glm::dvec3& place) {
        return std::isfinite(place.x) && std::isfinite(place.y) && std::isfinite(place.z);
    };
    for (size_t i = 0; i < scene.cells.size(); ++i) {
        const SceneCell& cell = scene.cells[i];
        if (!is_finite(cell.low_m) || !is_finite(cell.high_m) ||
            !glm::all(glm::lessThan(cell.low_m, cell.high_m))) {
            fail("cell", i, "is not a box: each coordinate of its low corner must be the smaller one");
        }
    }
    for (size_t i = 0; i < scene.portals.size(); ++i) {
        const ScenePortal& portal = scene.portals[i];
        const std::vector<glm::dvec3>& corners = portal.corners_m;
        if (corners.size() < 3 || corners.size() > most_corners) {
            fail("portal", i, fmt::format("has {} corners, not 3 to {}", corners.size(), most_corners));
        }
        for (const Index cell : {portal.from, portal.to}) {
            if (cell != no_index && cell >= scene.cells.size()) {
                fail("portal", i, fmt::format("leads to cell {}, which the scene does not have", cell));
            }
        }
        if (portal.from == portal.to) {
            fail("portal", i, "leads from a cell to the same cell");
        }
        const double area = glm::length(normal_of(corners));
        if (!std::ranges::all_of(corners, is_finite) || !(area > 0.0)) {
            fail("portal", i, "has no area");
        }
        const glm::dvec3 normal = normal_of(corners) / area;
        for (const glm::dvec3& corner : corners) {
            if (std::abs(glm::dot(corner - corners[0], normal)) > 1e-3 * std::sqrt(area)) {
                fail("portal", i, "is not flat");
            }
        }
    }
}

void SeenCells::find(std::span<const SceneCell> cells, std::span<const ScenePortal> portals, const Eye& eye)
{
    cells_ = cells;
    portals_ = portals;
    eye_ = eye;
    steps_ = 0;
    beams_.clear();
    on_path_.assign(cells.size(), false);
    const Bounds around = grown({eye.place_m, eye.place_m}, eye.near_m + slack_m);
    for (Index cell = 0; cell < cells.size(); ++cell) {
        if (touches(cells[cell], around)) {
            enter(cell, eye.sides, nullptr);
        }
    }
    if (reaches_outdoors(cells, around)) {
        enter(no_index, eye.sides, nullptr);
    }
    if (steps_ > most_steps || beams_.size() >= most_beams) {
        beams_.clear();
        beams_.push_back({.cell = no_index, .sides = eye.sides});
        for (Index cell = 0; cell < cells.size(); ++cell) {
            beams_.push_back({.cell = cell, .sides = eye.sides});
        }
    }
}

void SeenCells::enter(Index cell, const Sides& sides, const ScenePortal* through)
{
    if (++steps_ > most_steps || beams_.size() >= most_beams) {
        return;
    }
    beams_.push_back({.cell = cell, .sides = sides});
    // A line of sight enters a convex cell once. Outdoors is not convex, and may be entered again.
    if (cell != no_index) {
        on_path_[cell] = true;
    }
    for (const ScenePortal& portal : portals_) {
        const Index next = portal.from == cell ? portal.to : portal.from;
        const bool is_passed = next != no_index && on_path_[next];
        if ((portal.from != cell && portal.to != cell) || &portal == through || is_passed) {
            continue;
        }
        Polygon seen;
        for (const glm::dvec3& corner : portal.corners_m) {
            seen.push_back(corner - eye_.place_m);
        }
        const std::span<const glm::dvec3> corners(seen.data(), seen.size());
        if (distance_of(corners) <= eye_.near_m + slack_m) {
            enter(next, sides, &portal);
            continue;
        }
        // The eye must be on the side of the portal from which its line of sight comes.
        const Index indoors = cell != no_index ? cell : next;
        const glm::dvec3 room = 0.5 * (cells_[indoors].low_m + cells_[indoors].high_m) - eye_.place_m;
        const glm::dvec3 normal = glm::normalize(normal_of(corners));
        const double side_of_room = glm::dot(room - seen[0], normal) * (cell != no_index ? 1.0 : -1.0);
        const double side_of_eye = glm::dot(-seen[0], normal);
        if ((side_of_room > 0.0 ? side_of_eye : -side_of_eye) < -slack_m) {
            continue;
        }
        for (const glm::dvec3& side : sides) {
            seen = clipped(seen, side, eye_.margin);
        }
        if (seen.size() >= 3) {
            enter(next, sides_of(seen, eye_.margin), &portal);
        }
    }
    if (cell != no_index) {
        on_path_[cell] = false;
    }
}

bool SeenCells::is_seen(Index cell) const
{
    return std::ranges::any_of(beams_, [&](const Beam& beam) { return beam.cell == cell; });
}

bool may_show(const Eye& eye, const Beam& beam, const Bounds& box)
{
    const glm::dvec3 middle = box.center() - eye.place_m;
    const glm::dvec3 half = 0.5 * (box.max - box.min);
    const double margin = eye.margin * (glm::length(middle) + glm::length(half)) + slack_m;
    return std::ranges::all_of(beam.sides, [&](const glm::dvec3& side) {
        return glm::dot(side, middle) + glm::dot(glm::abs(side), half) + margin >= 0.0;
    });
}

CellsOfClusters::CellsOfClusters(std::span<const SceneCell> cells, std::vector<std::optional<Bounds>> boxes)
    : boxes_(std::move(boxes)), clusters_(cells.size() + 1), always_((boxes_.size() + 31) / 32, 0U)
{
    for (uint32_t cluster = 0; cluster < boxes_.size(); ++cluster) {
        if (!boxes_[cluster]) {
            always_[cluster / 32] |= 1U << cluster % 32;
            continue;
        }
        const Bounds box = grown(*boxes_[cluster], slack_m);
        for (size_t cell = 0; cell < cells.size(); ++cell) {
            if (touches(cells[cell], box)) {
                clusters_[cell].push_back(cluster);
            }
        }
        if (reaches_outdoors(cells, box)) {
            clusters_.back().push_back(cluster);
        }
    }
}

void CellsOfClusters::find_seen(const Eye& eye, const SeenCells& seen, std::vector<uint32_t>& bits) const
{
    bits = always_;
    for (const Beam& beam : seen.beams()) {
        const size_t cell = beam.cell == no_index ? clusters_.size() - 1 : beam.cell;
        for (const uint32_t cluster : clusters_[cell]) {
            const uint32_t bit = 1U << cluster % 32;
            uint32_t& word = bits[cluster / 32];
            if ((word & bit) == 0 && may_show(eye, beam, *boxes_[cluster])) {
                word |= bit;
            }
        }
    }
}

} // namespace estampe::cells
