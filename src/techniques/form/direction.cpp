// SPDX-License-Identifier: MIT
// Computes the direction field of strokes. Direction fields with n-fold symmetry are represented by the n-th
// power of complex numbers, and are aligned with the surface's curvature: Knoeppel, Crane, Pinkall and
// Schroeder, "Globally Optimal Direction Fields", SIGGRAPH 2013. First finds a cross at each vertex (both
// principal directions), then selects one of the cross's two lines. Palacios and Zhang, "Rotational Symmetry
// Field Design on Surfaces", SIGGRAPH 2007, found that fields smoothed as crosses have fewer unwanted
// singularities.
#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <future>
#include <numbers>
#include <vector>

#include "scene/smooth_surface.hpp"
#include "techniques/form/bundle.hpp"
#include "techniques/form/form_mesh.hpp"

namespace estampe::form {
namespace {

using Complex = std::complex<double>;

/// Curvature of the surface at a vertex, in 1 / radius of the mesh; positive on a sphere.
struct Curvature {
    double mean = 0.0; ///< mean curvature (k1 + k2) / 2
    /// Difference of the principal curvatures k1 and k2, as a complex number. The number's absolute value is
    /// half the difference of the principal curvatures k1 and k2. The number's angle is twice the angle of
    /// k1's direction in the tangent plane.
    Complex deviator = 0.0;
};

/// Second fundamental form of a triangle as (xx, xy, yy), in the triangle's plane with x along its first
/// edge.
glm::dvec3 bending(const Mesh& mesh, uint32_t triangle)
{
    const auto& c = mesh.triangles[triangle];
    const glm::dvec3 normal = glm::normalize(mesh.triangle_normal(triangle));
    const glm::dvec3 x = glm::normalize(mesh.points[c[1]] - mesh.points[c[0]]);
    const glm::dvec3 y = glm::cross(normal, x);
    std::array<SideChange, 3> sides;
    for (size_t k = 0; k < 3; ++k) {
        const glm::dvec3 edge = mesh.points[c[(k + 1) % 3]] - mesh.points[c[k]];
        const glm::dvec3 change = mesh.normals[c[(k + 1) % 3]] - mesh.normals[c[k]];
        sides.at(k) = {{glm::dot(edge, x), glm::dot(edge, y)}, {glm::dot(change, x), glm::dot(change, y)}};
    }
    return second_form(sides, 1e-12);
}

/// Computes the curvature at each vertex. The curvature of each triangle follows from the differences of its
/// vertex normals. The curvature is transferred to the vertices and averaged over about `reach` (in radii of
/// the mesh), so that bumps smaller than `reach` cancel. Cost: linear.
std::vector<Curvature> find_curvature(const Mesh& mesh, double reach)
{
    const auto count = static_cast<uint32_t>(mesh.points.size());
    Vectors deviators(count, glm::dvec2(0.0));
    Vectors means(count, glm::dvec2(0.0));
    for (uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        const glm::dvec3 form = bending(mesh, t);
        const double share = glm::length(mesh.triangle_normal(t)) / 6.0;
        for (uint32_t k = 0; k < 3; ++k) {
            const uint32_t vertex = mesh.triangles[t][k];
            const double part = share / mesh.areas[vertex];
            const Complex turned = Complex(0.5 * (form.x - form.z), form.y) *
                                   std::polar(part, 2.0 * mesh.vertex_from_triangle(t, k));
            deviators[vertex] += glm::dvec2(turned.real(), turned.imag());
            means[vertex].x += 0.5 * part * (form.x + form.z);
        }
    }
    std::vector<Link> turning;
    std::vector<Link> plain;
    for (const Edge& edge : mesh.edges) {
        const double turn = edge.angle_at_to + std::numbers::pi - edge.angle_at_from;
        turning.push_back({edge.from, edge.to, edge.weight, 2.0 * turn});
        plain.push_back({edge.from, edge.to, edge.weight, 0.0});
    }
    std::vector<double> pulls(count);
    std::transform(mesh.areas.begin(), mesh.areas.end(), pulls.begin(),
                   [&](double area) { return area / (reach * reach); });
    constexpr double tolerance = 1e-2;
    auto means_later =
        std::async([&] { return Bundle(count, plain, mesh.areas).attract(pulls, means, tolerance); });
    deviators = Bundle(count, turning, mesh.areas).attract(pulls, deviators, tolerance);
    means = means_later.get();
    std::vector<Curvature> result(count);
    for (uint32_t i = 0; i < count; ++i) {
        result[i] = {means[i].x, {deviators[i].x, deviators[i].y}};
    }
    return result;
}

/// Tolerance of the solver's residuals; directions need no higher accuracy.
constexpr double tolerance = 1e-2;
/// Weight of horizontal strokes per area of the surface, in 1 / radius^2 of the mesh.
constexpr double level_pull = 0.05;
/// Weight of strokes that follow a crease, per length of the crease, in 1 / radius of the mesh.
constexpr double crease_pull = 0.2;
/// Weight of equal crosses (pairs of principal directions) on both sides of a crease; an ordinary edge has a
/// weight of about 0.6.
constexpr double cross_weight = 0.005;
/// Weight for choosing equal lines of the cross (pair of principal directions) on both sides of a crease.
constexpr double crease_vote = 0.002;
/// Curvature in 1 / radius of the mesh; a surface with less curvature counts as flat.
constexpr double flat_below = 0.15;

struct Pull {
    std::vector<double> strengths;
    Vectors targets;

    explicit Pull(size_t count) : strengths(count, 0.0), targets(count, glm::dvec2(0.0)) {}

    void add(size_t i, double strength, Complex target)
    {
        const double sum = strengths[i] + strength;
        if (sum > 0.0) {
            targets[i] =
                (strengths[i] * targets[i] + strength * glm::dvec2(target.real(), target.imag())) / sum;
            strengths[i] = sum;
        }
    }
};

Bundle make_bundle(const Mesh& mesh, double symmetry, bool over_creases)
{
    std::vector<Link> links;
    links.reserve(mesh.edges.size() + mesh.crease_links.size());
    for (const Edge& edge : mesh.edges) {
        links.push_back({edge.from, edge.to, edge.weight,
                         symmetry * (edge.angle_at_to + std::numbers::pi - edge.angle_at_from)});
    }
    for (const CreaseLink& link : mesh.crease_links) {
        if (over_creases && link.from != link.to) {
            links.push_back({link.from, link.to, cross_weight, symmetry * link.turn});
        }
    }
    return {static_cast<uint32_t>(mesh.points.size()), links, mesh.areas};
}

Complex unit(Complex z)
{
    const double length = std::abs(z);
    return length > 1e-200 ? z / length : Complex(1.0);
}

/// The direction of the horizontal line at each vertex, as a unit complex number at twice the direction's
/// angle. On horizontal ground all level lines have one common direction.
std::vector<Complex> level_lines(const Mesh& mesh, const glm::dvec3& up)
{
    const glm::dvec3 aside = std::abs(up.x) < 0.9 ? glm::dvec3(1.0, 0.0, 0.0) : glm::dvec3(0.0, 0.0, 1.0);
    const glm::dvec3 fallback = glm::normalize(aside - up * glm::dot(up, aside));
    constexpr double fallback_share = 0.05;
    std::vector<Complex> result(mesh.points.size(), 0.0);
    for (uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        const auto& c = mesh.triangles[t];
        const glm::dvec3 twice_area = mesh.triangle_normal(t);
        const glm::dvec3 normal = glm::normalize(twice_area);
        const glm::dvec3 x = glm::normalize(mesh.points[c[1]] - mesh.points[c[0]]);
        const glm::dvec3 y = glm::cross(normal, x);
        const glm::dvec3 level = glm::cross(up, normal);
        const Complex line(glm::dot(level, x), glm::dot(level, y));
        const Complex other(glm::dot(fallback, x), glm::dot(fallback, y));
        const Complex doubled = line * line + fallback_share * other * other;
        for (uint32_t k = 0; k < 3; ++k) {
            const double part = glm::length(twice_area) / (6.0 * mesh.areas[c[k]]);
            result[c[k]] += doubled * std::polar(part, 2.0 * mesh.vertex_from_triangle(t, k));
        }
    }
    for (Complex& line : result) {
        line = unit(line);
    }
    return result;
}

Complex complex_of(glm::dvec2 v)
{
    return {v.x, v.y};
}

/// Returns how clearly the two principal directions of a curved surface differ: from 0 (equal curvatures) to
/// 1.
double distinctness(const Curvature& k)
{
    const double deviation = std::abs(k.deviator);
    const double most = std::max(std::abs(k.mean), deviation);
    return most > 0.0 ? deviation / most *
                            (deviation * deviation / (deviation * deviation + flat_below * flat_below))
                      : 0.0;
}

/// Compares the absolute values of the principal curvatures k1 and k2. Returns 1 if that of the greater
/// curvature k1 is larger, -1 if that of k2 is larger, 0 if both are equal.
double preference(const Curvature& k)
{
    const double deviation = std::abs(k.deviator);
    return deviation > 0.0 ? std::clamp(k.mean / deviation, -1.0, 1.0) : 0.0;
}

/// Chooses for each vertex one of the two lines of its cross (the pair of principal directions). Returns 1
/// for the first line, -1 for the perpendicular line, and smaller absolute values where the choice is less
/// certain. Neighbours are linked to choose alike, so the most certain vertices decide.
Vectors choose_lines(const Mesh& mesh, const std::vector<Complex>& lines, const Pull& line_pull)
{
    std::vector<Link> links;
    links.reserve(mesh.edges.size() + mesh.crease_links.size());
    const auto add = [&](uint32_t from, uint32_t to, double weight, double turn) {
        const double alike = (lines[to] * std::conj(lines[from] * std::polar(1.0, 2.0 * turn))).real();
        links.push_back({from, to, weight * std::abs(alike), alike < 0.0 ? std::numbers::pi : 0.0});
    };
    for (const Edge& edge : mesh.edges) {
        add(edge.from, edge.to, edge.weight, edge.angle_at_to + std::numbers::pi - edge.angle_at_from);
    }
    for (const CreaseLink& link : mesh.crease_links) {
        if (link.from != link.to) {
            add(link.from, link.to, crease_vote, link.turn);
        }
    }
    Vectors votes(lines.size());
    for (size_t i = 0; i < lines.size(); ++i) {
        votes[i] = {(complex_of(line_pull.targets[i]) * std::conj(lines[i])).real(), 0.0};
    }
    return Bundle(static_cast<uint32_t>(lines.size()), links, mesh.areas)
        .attract(line_pull.strengths, votes, tolerance);
}

/// Computes the smoothed line at each vertex, as a squared complex number.
Vectors smooth_lines(const Mesh& mesh, const glm::dvec3& up, double reach)
{
    const size_t count = mesh.points.size();
    const std::vector<Curvature> curvature = find_curvature(mesh, 0.25 * reach);
    const std::vector<Complex> level = level_lines(mesh, up);
    Pull cross_pull(count);
    Pull line_pull(count);
    for (const CreaseLink& link : mesh.crease_links) {
        cross_pull.add(link.from, crease_pull * link.length, std::polar(1.0, 4.0 * link.angle_at_from));
        cross_pull.add(link.to, crease_pull * link.length,
                       std::polar(1.0, 4.0 * (link.angle_at_from + link.turn)));
    }
    for (size_t i = 0; i < count; ++i) {
        const bool is_on_crease = cross_pull.strengths[i] > 0.0;
        const double area = mesh.areas[i];
        const Complex line = unit(curvature[i].deviator);
        const double heard = distinctness(curvature[i]) * area / (reach * reach);
        const double preferred = preference(curvature[i]);
        cross_pull.add(i, heard, line * line);
        cross_pull.add(i, is_on_crease ? 0.0 : level_pull * area, level[i] * level[i]);
        line_pull.add(i, heard * std::abs(preferred), preferred < 0.0 ? -line : line);
        line_pull.add(i, level_pull * area, level[i]);
    }
    std::vector<Complex> lines;
    lines.reserve(count);
    for (const glm::dvec2& cross :
         make_bundle(mesh, 4.0, true).attract(cross_pull.strengths, cross_pull.targets, tolerance)) {
        lines.push_back(std::sqrt(unit(complex_of(cross))));
    }
    const Vectors choices = choose_lines(mesh, lines, line_pull);
    Pull along_cross(count);
    for (size_t i = 0; i < count; ++i) {
        const double sureness = std::abs(choices[i].x) + 1e-6;
        along_cross.add(i, sureness * mesh.areas[i] / (reach * reach),
                        choices[i].x < 0.0 ? -lines[i] : lines[i]);
    }
    return make_bundle(mesh, 2.0, false).attract(along_cross.strengths, along_cross.targets, tolerance);
}

/// Chooses one of two opposite directions for each line, so that neighbouring lines point in similar
/// directions as far as possible. Visits the vertices breadth first.
void agree_on_sense(const Mesh& mesh, Directions& directions)
{
    const size_t count = mesh.points.size();
    std::vector<std::vector<std::pair<uint32_t, double>>> around(count);
    for (const Edge& edge : mesh.edges) {
        const double turn = edge.angle_at_to + std::numbers::pi - edge.angle_at_from;
        around[edge.from].emplace_back(edge.to, turn);
        around[edge.to].emplace_back(edge.from, -turn);
    }
    for (const CreaseLink& link : mesh.crease_links) {
        around[link.from].emplace_back(link.to, link.turn);
        around[link.to].emplace_back(link.from, -link.turn);
    }
    std::vector<uint8_t> is_reached(count, 0);
    std::vector<uint32_t> queue;
    for (uint32_t seed = 0; seed < count; ++seed) {
        if (is_reached[seed] != 0) {
            continue;
        }
        is_reached[seed] = 1;
        queue.assign(1, seed);
        for (size_t head = 0; head < queue.size(); ++head) {
            const uint32_t i = queue[head];
            for (const auto& [j, turn] : around[i]) {
                if (is_reached[j] != 0) {
                    continue;
                }
                is_reached[j] = 1;
                queue.push_back(j);
                if (std::cos(directions.angles[j] - directions.angles[i] - turn) < 0.0) {
                    directions.angles[j] += std::numbers::pi;
                }
            }
        }
    }
}

} // namespace

Directions find_directions(const Mesh& mesh, const glm::dvec3& up, double reach)
{
    Directions result;
    for (const glm::dvec2 line : smooth_lines(mesh, up, reach)) {
        result.angles.push_back(0.5 * std::atan2(line.y, line.x));
    }
    agree_on_sense(mesh, result);
    for (const Edge& edge : mesh.edges) {
        const double turn = edge.angle_at_to + std::numbers::pi - edge.angle_at_from;
        result.turns.push_back(std::cos(result.angles[edge.to] - result.angles[edge.from] - turn) < 0.0 ? 1
                                                                                                        : 0);
    }
    for (const CreaseLink& link : mesh.crease_links) {
        result.link_turns.push_back(
            std::cos(result.angles[link.to] - result.angles[link.from] - link.turn) < 0.0 ? 1 : 0);
    }
    return result;
}

double singularity(const Mesh& mesh, const Directions& directions, uint32_t triangle)
{
    double sum = -std::numbers::pi;
    for (uint32_t h = 3 * triangle; h < 3 * triangle + 3; ++h) {
        const Edge& edge = mesh.edges[mesh.edge_of[h]];
        const double turn = edge.angle_at_to + std::numbers::pi - edge.angle_at_from;
        const double difference = directions.angles[edge.to] - directions.angles[edge.from] - turn;
        const double change = difference - std::numbers::pi * std::round(difference / std::numbers::pi);
        sum += edge.half_edge == h ? change : -change;
        sum += mesh.angle_scales[mesh.triangles[triangle][h % 3]] * mesh.corner_angles[h];
    }
    return 0.5 * std::round(sum / std::numbers::pi);
}

} // namespace estampe::form
