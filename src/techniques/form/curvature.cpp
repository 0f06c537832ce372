// SPDX-License-Identifier: MIT
#include "techniques/form/curvature.hpp"

#include <algorithm>
#include <array>
#include <future>
#include <numbers>

#include "scene/second_form.hpp"
#include "techniques/form/bundle.hpp"

namespace estampe::form {
namespace {

/// Second fundamental form of a triangle in its own plane, x along its first edge: xx, xy, yy.
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

} // namespace

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

} // namespace estampe::form
