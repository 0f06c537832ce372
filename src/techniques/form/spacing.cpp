// SPDX-License-Identifier: MIT
// A unit field n is the gradient of a function after stretching by e^s when the curl of e^s n is nothing,
// that is, when along the stripes, square to n, s grows as the field turns: with J a quarter turn and theta
// the angle of n,
//     Jn . grad s = n . grad theta.
// This is solved in the sense of least squares, with a smaller price on change across the stripes.
#include "techniques/form/spacing.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "techniques/form/bundle.hpp"

namespace estampe::form {
namespace {

constexpr double price_across = 0.2;
constexpr double most_closeness = 4.0;

/// A triangle in its own plane, the first edge along x.
struct Flat {
    std::array<glm::dvec2, 3> gradients; ///< of the three barycentric weights
    double area = 0.0;
    glm::dvec2 turning{0.0}; ///< gradient of the line field's angle
    glm::dvec2 along{0.0};   ///< unit direction of the stripes' lines
};

glm::dvec2 quarter_turn(glm::dvec2 v)
{
    return {-v.y, v.x};
}

/// Change of the line field's angle along a half-edge, against parallel transport.
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

} // namespace

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

} // namespace estampe::form
