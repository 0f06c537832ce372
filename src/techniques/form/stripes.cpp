// SPDX-License-Identifier: MIT
// Knoeppel, Crane, Pinkall and Schroeder, "Stripe Patterns on Surfaces", SIGGRAPH 2015. The code implements
// the unit-length variant: the vector field z that minimises the energy has length 1 everywhere. So the field
// does not vanish in any part of a mesh.
//
// Spacing of the stripes: the gradient of the stripes' phase is a unit field n times e^s, where s is the
// logarithm of the stripes' density. A phase with this gradient exists if the curl of e^s n is zero. The curl
// is zero if the log density s increases along the stripes (perpendicular to n) as the field turns: Jn . grad
// s = n . grad theta, where n is the unit field, J a quarter turn and theta the angle of n. The equation for
// the log density s is solved by least squares, with a smaller penalty on change across the stripes.
#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include "techniques/form/bundle.hpp"
#include "techniques/form/form_mesh.hpp"

namespace estampe::form {
namespace {

constexpr double price_across = 0.2;
constexpr double most_closeness = 4.0;

/// A triangle in 2D coordinates of the triangle's plane, with the first edge along x.
struct Flat {
    /// Gradients of the three barycentric coordinates in the triangle's plane.
    std::array<glm::dvec2, 3> gradients;
    double area = 0.0;
    glm::dvec2 turning{0.0}; ///< gradient of the angle of the line field
    glm::dvec2 along{0.0};   ///< unit direction of the lines of the stripes
};

glm::dvec2 quarter_turn(glm::dvec2 v)
{
    return {-v.y, v.x};
}

/// Change of the line field's angle along a half-edge, relative to parallel transport.
double change_along(const Mesh& mesh, const Directions& directions, uint32_t half_edge)
{
    const Edge& edge = mesh.edges[mesh.edge_of[half_edge]];
    const double turn = edge.angle_at_to + std::numbers::pi - edge.angle_at_from;
    const double difference = directions.angles[edge.to] - directions.angles[edge.from] - turn;
    const double change = difference - std::numbers::pi * std::round(difference / std::numbers::pi);
    return edge.half_edge == half_edge ? change : -change;
}

Flat lay_flat(const Mesh& mesh, const Directions& directions, double turn_rad, uint32_t t)
{
    const auto& c = mesh.triangles[t];
    const glm::dvec3 first = mesh.points[c[1]] - mesh.points[c[0]];
    const glm::dvec3 last = mesh.points[c[2]] - mesh.points[c[0]];
    const double twice_area = glm::length(mesh.triangle_normal(t));
    const double length = glm::length(first);
    const std::array<glm::dvec2, 3> p{glm::dvec2(0.0), glm::dvec2(length, 0.0),
                                      glm::dvec2(glm::dot(first, last), twice_area) / length};
    Flat flat;
    flat.area = 0.5 * twice_area;
    std::array<double, 3> changes{};
    std::complex<double> doubled = 0.0;
    for (uint32_t k = 0; k < 3; ++k) {
        flat.gradients[k] = quarter_turn(p[(k + 2) % 3] - p[(k + 1) % 3]) / twice_area;
        changes[k] = change_along(mesh, directions, 3 * t + k);
        doubled += std::polar(1.0, 2.0 * (directions.angles[c[k]] - mesh.vertex_from_triangle(t, k)));
    }
    const double excess = (changes[0] + changes[1] + changes[2]) / 3.0;
    flat.turning = flat.gradients[1] * (changes[0] - excess) - flat.gradients[2] * (changes[2] - excess);
    const double angle = 0.5 * std::arg(doubled) + turn_rad - 0.5 * std::numbers::pi;
    flat.along = {std::cos(angle), std::sin(angle)};
    return flat;
}

/// Returns the relative density of stripes at each vertex, from 1/4 to 4. The stripes are perpendicular to
/// the line field rotated by `turn_rad`. Stripes are denser where the stripes' lines converge. Cost: linear.
std::vector<double> find_closeness(const Mesh& mesh, const Directions& directions, double turn_rad)
{
    const size_t count = mesh.points.size();
    std::vector<double> weights(mesh.edges.size(), 0.0);
    Vectors right(count, glm::dvec2(0.0));
    for (uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        const Flat flat = lay_flat(mesh, directions, turn_rad, t);
        const glm::dvec2 across = quarter_turn(flat.along);
        const bool is_singular = singularity(mesh, directions, t) != 0.0;
        const double wanted = is_singular ? 0.0 : glm::dot(flat.along, quarter_turn(flat.turning));
        for (uint32_t k = 0; k < 3; ++k) {
            const glm::dvec2 g = flat.gradients[k];
            const glm::dvec2 h = flat.gradients[(k + 1) % 3];
            const double stiffness = glm::dot(g, flat.along) * glm::dot(h, flat.along) +
                                     price_across * glm::dot(g, across) * glm::dot(h, across);
            weights[mesh.edge_of[3 * t + k]] -= flat.area * stiffness;
            right[mesh.triangles[t][k]].x += flat.area * glm::dot(g, flat.along) * wanted;
        }
    }
    std::vector<Link> links;
    for (size_t e = 0; e < mesh.edges.size(); ++e) {
        links.push_back({mesh.edges[e].from, mesh.edges[e].to, std::clamp(weights[e], 0.01, 10.0)});
    }
    for (const CreaseLink& link : mesh.crease_links) {
        if (link.from != link.to) {
            links.push_back({link.from, link.to, 0.5});
        }
    }
    std::vector<double> pulls(count);
    std::transform(mesh.areas.begin(), mesh.areas.end(), pulls.begin(),
                   [](double area) { return 1e-3 * area; });
    Bundle bundle(static_cast<uint32_t>(count), links, mesh.areas);
    std::vector<double> closeness;
    closeness.reserve(count);
    for (const glm::dvec2& logarithm : bundle.solve(pulls, right, 1e-2)) {
        closeness.push_back(std::clamp(std::exp(logarithm.x), 1.0 / most_closeness, most_closeness));
    }
    return closeness;
}

/// Weight of equal phases on both sides of a crease; an ordinary edge has a weight of about 0.6.
constexpr double agreement_weight = 0.6;

/// Increase of the stripes' phase along an edge, in periods. The sign is relative to the sense of the line at
/// the start of the edge.
struct Gain {
    double wanted = 0.0;
    double real = 0.0;
};

class Painter {
public:
    Painter(const Mesh& mesh, const Directions& directions, double turn, double period, uint32_t seed)
        : mesh_(mesh), directions_(directions)
    {
        want_gains(turn, period);
        solve(period, seed);
    }

    Stripes paint()
    {
        const size_t count = mesh_.triangles.size();
        stripes_.corners.resize(count);
        stripes_.branches.resize(count);
        senses_.resize(count);
        for (uint32_t t = 0; t < count; ++t) {
            paint_triangle(t);
        }
        unwrap();
        return std::move(stripes_);
    }

private:
    void want_gains(double turn, double period)
    {
        const std::vector<double> closeness = find_closeness(mesh_, directions_, turn);
        gains_.reserve(mesh_.edges.size());
        for (size_t e = 0; e < mesh_.edges.size(); ++e) {
            const Edge& edge = mesh_.edges[e];
            const double at_from = std::cos(directions_.angles[edge.from] + turn - edge.angle_at_from);
            const double at_to =
                std::cos(directions_.angles[edge.to] + turn - edge.angle_at_to - std::numbers::pi);
            const double sign = directions_.turns[e] != 0 ? -1.0 : 1.0;
            const double mean = 0.5 * (closeness[edge.from] + closeness[edge.to]);
            gains_.push_back({.wanted = 0.5 * mean * edge.length / period * (at_from + sign * at_to)});
        }
    }

    void solve(double period, uint32_t seed)
    {
        std::vector<Link> links;
        for (size_t e = 0; e < mesh_.edges.size(); ++e) {
            const Edge& edge = mesh_.edges[e];
            links.push_back({edge.from, edge.to, edge.weight, 2.0 * std::numbers::pi * gains_[e].wanted,
                             directions_.turns[e] != 0});
        }
        for (size_t l = 0; l < mesh_.crease_links.size(); ++l) {
            const CreaseLink& link = mesh_.crease_links[l];
            if (link.from != link.to) {
                const double agreement =
                    std::cos(directions_.angles[link.to] - directions_.angles[link.from] - link.turn);
                links.push_back({link.from, link.to, agreement_weight * std::pow(agreement, 8.0), 0.0,
                                 directions_.link_turns[l] != 0});
            }
        }
        Bundle bundle(static_cast<uint32_t>(mesh_.points.size()), links, mesh_.areas);
        for (const glm::dvec2 z : bundle.relax(period, seed)) {
            phases_.push_back(std::atan2(z.y, z.x) / (2.0 * std::numbers::pi));
        }
        for (size_t e = 0; e < mesh_.edges.size(); ++e) {
            const Edge& edge = mesh_.edges[e];
            const double sign = directions_.turns[e] != 0 ? -1.0 : 1.0;
            const double rest = sign * phases_[edge.to] - phases_[edge.from] - gains_[e].wanted;
            gains_[e].real = gains_[e].wanted + rest - std::round(rest);
        }
    }

    /// Increase of the stripes' phase along a half-edge, relative to the sense of the line at the start of
    /// the half-edge.
    double gain(uint32_t half_edge) const
    {
        const uint32_t e = mesh_.edge_of[half_edge];
        if (mesh_.edges[e].half_edge == half_edge) {
            return gains_[e].real;
        }
        return directions_.turns[e] != 0 ? gains_[e].real : -gains_[e].real;
    }

    double sign(uint32_t half_edge) const
    {
        return directions_.turns[mesh_.edge_of[half_edge]] != 0 ? -1.0 : 1.0;
    }

    /// Computes the phases at a triangle's corners from one corner along two edges. On the triangle's third
    /// edge, the phases may then not agree with the neighbouring triangle. Chooses the corner with the least
    /// change of phase over the triangle. At a singularity, chooses the corner whose opposite edge is
    /// shortest, so that the signs are equal for both coordinates.
    void paint_triangle(uint32_t t)
    {
        const uint32_t h = 3 * t;
        const bool is_singular = sign(h) * sign(h + 1) * sign(h + 2) < 0.0;
        const double round_trip = gain(h) + sign(h) * gain(h + 1) + sign(h) * sign(h + 1) * gain(h + 2);
        stripes_.branches[t] = is_singular ? 0 : static_cast<int32_t>(std::lround(round_trip));
        double least = 1e300;
        const uint32_t ways = is_singular || stripes_.branches[t] != 0 ? 3 : 1;
        for (uint32_t k = 0; k < ways; ++k) {
            const uint32_t onward = h + k;
            const uint32_t back = previous_corner(onward);
            std::array<double, 3> corner{};
            std::array<double, 3> sense{};
            corner[k] = phases_[mesh_.triangles[t][k]];
            sense[k] = 1.0;
            corner[next_corner(onward) % 3] = corner[k] + gain(onward);
            sense[next_corner(onward) % 3] = sign(onward);
            // The half-edge `back` leads into the corner. In the opposite direction, the increase of the
            // phase along the half-edge has the opposite sign.
            corner[back % 3] = corner[k] - sign(back) * gain(back);
            sense[back % 3] = sign(back);
            const double change = std::abs(corner[0] - corner[1]) + std::abs(corner[1] - corner[2]) +
                                  std::abs(corner[2] - corner[0]);
            const uint32_t opposite = next_corner(onward);
            const double length = mesh_.edges[mesh_.edge_of[opposite]].length;
            const double cost = mesh_.twins[opposite] == none ? -1.0 : is_singular ? length : change;
            if (cost < least) {
                least = cost;
                stripes_.corners[t] = corner;
                senses_[t] = sense;
            }
        }
        if (senses_[t][0] < 0.0) {
            turn_round(t);
        }
    }

    void turn_round(uint32_t t)
    {
        for (size_t k = 0; k < 3; ++k) {
            stripes_.corners[t][k] = -stripes_.corners[t][k];
            senses_[t][k] = -senses_[t][k];
        }
    }

    /// Visits the triangles breadth first, so that whole numbers and signs of phases change across few edges.
    void unwrap()
    {
        std::vector<uint8_t> is_reached(mesh_.triangles.size(), 0);
        std::vector<uint32_t> queue;
        for (uint32_t seed = 0; seed < mesh_.triangles.size(); ++seed) {
            if (is_reached[seed] != 0) {
                continue;
            }
            is_reached[seed] = 1;
            queue.assign(1, seed);
            for (size_t head = 0; head < queue.size(); ++head) {
                for (uint32_t h = 3 * queue[head]; h < 3 * queue[head] + 3; ++h) {
                    const uint32_t twin = mesh_.twins[h];
                    if (twin != none && is_reached[twin / 3] == 0) {
                        is_reached[twin / 3] = 1;
                        fit(h, twin);
                        queue.push_back(twin / 3);
                    }
                }
            }
        }
    }

    void fit(uint32_t half_edge, uint32_t twin)
    {
        std::array<double, 3>& corner = stripes_.corners[twin / 3];
        const uint32_t start = next_corner(twin);
        if (senses_[half_edge / 3][half_edge % 3] * senses_[twin / 3][start % 3] < 0.0) {
            turn_round(twin / 3);
        }
        const double whole = std::round(stripes_.corners[half_edge / 3][half_edge % 3] - corner[start % 3]);
        for (double& value : corner) {
            value += whole;
        }
    }

    const Mesh& mesh_;
    const Directions& directions_;
    std::vector<Gain> gains_;    ///< increase of the stripes' phase along each edge
    std::vector<double> phases_; ///< phase at each vertex, in periods
    Stripes stripes_;
    /// For each corner of a triangle: sign of the triangle's phases relative to the vertex's phases.
    std::vector<std::array<double, 3>> senses_;
};

} // namespace

Stripes find_stripes(const Mesh& mesh, const Directions& directions, double turn_rad, double period,
                     uint32_t seed)
{
    return Painter(mesh, directions, turn_rad, period, seed).paint();
}

} // namespace estampe::form
