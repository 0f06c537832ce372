// SPDX-License-Identifier: MIT
// estampe.Part: a drawable part of a mesh, made of numpy arrays.
#include <algorithm>
#include <limits>
#include <numeric>
#include <optional>
#include <string>

#include <fmt/format.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include "arrays.hpp"
#include "bindings.hpp"

namespace estampe::python {
namespace {

constexpr const char* part_doc = R"(Drawable part of a mesh, made of arrays, with one material.

positions    (n, 3) floats, metres, y up, right-handed
indices      (m, 3) integers for triangles, (m, 2) for lines, (m,) for points; None: the elements take the
             vertices in order. Triangles are counter-clockwise seen from their front
material     number of a material, as Scene.add_material() returns it
normals      (n, 3) floats; None: normals are computed, see crease_deg
uvs, uvs1    (n, 2) floats: first and second texture coordinates; (0, 0) is the upper left corner of an image
colors       (n, 3) or (n, 4) floats: linear colours that are multiplied by the material's, with straight alpha
tangents     (n, 4) floats: direction in which u grows, and the sign of the bitangent; only needed for
             materials with a normal map
edge_marks   (m,) integers from 0 to 7: bit k marks the edge from corner k of a triangle to the next corner,
             which is then drawn as a line. Without marks the style decides by the shape which edges are drawn
crease_deg   angle in degrees between two faces above which computed normals have a sharp edge; 0 shades all
             faces flat, 180 shades the surface smoothly
topology     "triangles", "lines" or "points"

All arrays are copied. Wrong numbers, shapes and indices raise TypeError, ValueError and IndexError with the
name of the argument. Cost: linear; about 1 s per million triangles if normals are computed.)";

Topology topology_of(const std::string& name)
{
    return choice_of<Topology>(
        name, "topology",
        {{"triangles", Topology::triangles}, {"lines", Topology::lines}, {"points", Topology::points}});
}

py::ssize_t vertices_of(Topology topology)
{
    switch (topology) {
    case Topology::points:
        return 1;
    case Topology::lines:
        return 2;
    default:
        return 3;
    }
}

std::vector<glm::vec4> colors_of(const py::object& value, py::ssize_t vertex_count)
{
    const py::array array = numbers_of(value, "colors", "f");
    if (array.ndim() == 2 && array.shape(1) == 4) {
        return rows_of<glm::vec4>(array, "colors", vertex_count);
    }
    std::vector<glm::vec4> colors;
    for (const glm::vec3& color : rows_of<glm::vec3>(array, "colors", vertex_count)) {
        colors.emplace_back(color, 1.0F);
    }
    return colors;
}

std::vector<uint8_t> edge_marks_of(const py::object& value, size_t triangle_count)
{
    constexpr uint64_t mark_count = 8; // three bits
    const std::vector<uint32_t> marks = indices_below(value, "edge_marks", 1, mark_count);
    if (marks.size() != triangle_count) {
        throw py::value_error(
            fmt::format("edge_marks: has {} values for {} triangles", marks.size(), triangle_count));
    }
    std::vector<uint8_t> bytes(marks.size());
    std::transform(marks.begin(), marks.end(), bytes.begin(),
                   [](uint32_t mark) { return static_cast<uint8_t>(mark); });
    return bytes;
}

/// Scales given normals to unit length. Throws ValueError for a normal without a direction.
void normalise_normals(std::vector<glm::vec3>& normals)
{
    for (size_t i = 0; i < normals.size(); ++i) {
        const double length = glm::length(glm::dvec3(normals[i]));
        if (!(length > 0.0)) {
            throw py::value_error(fmt::format("normals: normal {} has no direction", i));
        }
        normals[i] = glm::vec3(glm::dvec3(normals[i]) / length);
    }
}

Part make_part(const py::object& positions, const py::object& indices, const py::object& material,
               const py::object& normals, const py::object& uvs, const py::object& uvs1,
               const py::object& colors, const py::object& tangents, const py::object& edge_marks,
               double crease_deg, const std::string& topology)
{
    Primitive primitive;
    primitive.topology = topology_of(topology);
    primitive.material = optional_index(integer_of(material, "material"), "material", no_index);
    primitive.positions = rows_of<glm::vec3>(positions, "positions");
    const size_t vertex_count = primitive.positions.size();
    if (vertex_count == 0 || vertex_count >= std::numeric_limits<uint32_t>::max()) {
        throw py::value_error(fmt::format("positions: has {} vertices", vertex_count));
    }
    const auto rows = static_cast<py::ssize_t>(vertex_count);
    const py::ssize_t width = vertices_of(primitive.topology);
    if (!indices.is_none()) {
        primitive.indices = indices_below(indices, "indices", width, vertex_count);
    } else {
        if (rows % width != 0) {
            throw py::value_error(
                fmt::format("positions: without indices the number of vertices, {}, must be a multiple of {}",
                            rows, width));
        }
        primitive.indices.resize(vertex_count);
        std::iota(primitive.indices.begin(), primitive.indices.end(), 0U);
    }
    if (primitive.indices.empty()) {
        throw py::value_error("indices: the part has no elements");
    }
    if (!uvs.is_none()) {
        primitive.uvs[0] = rows_of<glm::vec2>(uvs, "uvs", rows);
    }
    if (!uvs1.is_none()) {
        primitive.uvs[1] = rows_of<glm::vec2>(uvs1, "uvs1", rows);
    }
    if (!colors.is_none()) {
        primitive.colors = colors_of(colors, rows);
    }
    if (!tangents.is_none()) {
        if (normals.is_none()) {
            throw py::value_error("tangents: are only valid together with normals");
        }
        primitive.tangents = rows_of<glm::vec4>(tangents, "tangents", rows);
    }
    number_within(crease_deg, "crease_deg", 0.0, 180.0);
    const bool has_triangles = primitive.topology == Topology::triangles;
    if (!edge_marks.is_none()) {
        if (!has_triangles) {
            throw py::value_error("edge_marks: are only valid with triangles");
        }
        primitive.edge_marks = edge_marks_of(edge_marks, primitive.indices.size() / 3);
    }
    if (!normals.is_none()) {
        primitive.normals = rows_of<glm::vec3>(normals, "normals", rows);
        normalise_normals(primitive.normals);
    } else if (has_triangles) {
        const Unlocked unlocked;
        compute_normals(primitive, static_cast<float>(glm::radians(crease_deg)));
    }
    return {std::move(primitive)};
}

/// Returns a read-only array of a part's vectors, which stay in the part.
template <typename Vector>
py::object rows_within(const std::vector<Vector>& rows, const py::object& owner)
{
    constexpr auto width = static_cast<py::ssize_t>(sizeof(Vector) / sizeof(float));
    if (rows.empty()) {
        return py::none();
    }
    py::array_t<float> array({static_cast<py::ssize_t>(rows.size()), width},
                             reinterpret_cast<const float*>(rows.data()), owner);
    array.attr("setflags")(py::arg("write") = false);
    return array;
}

} // namespace

void bind_part(py::module_& module)
{
    py::class_<Part>(module, "Part", part_doc)
        .def(py::init(&make_part), py::arg("positions"), py::arg("indices") = py::none(), py::kw_only(),
             py::arg("material") = 0, py::arg("normals") = py::none(), py::arg("uvs") = py::none(),
             py::arg("uvs1") = py::none(), py::arg("colors") = py::none(), py::arg("tangents") = py::none(),
             py::arg("edge_marks") = py::none(), py::arg("crease_deg") = 47.0,
             py::arg("topology") = "triangles", "Make a part of arrays; see the class.")
        .def_property_readonly(
            "positions",
            [](const py::object& self) {
                return rows_within(self.cast<const Part&>().primitive.positions, self);
            },
            "(n, 3) float32, read-only: positions of the vertices in metres, after computed normals have\n"
            "repeated vertices at sharp edges.")
        .def_property_readonly(
            "normals",
            [](const py::object& self) {
                return rows_within(self.cast<const Part&>().primitive.normals, self);
            },
            "(n, 3) float32, read-only: unit normals of the vertices; None for lines and points without any.")
        .def_property_readonly(
            "indices",
            [](const py::object& self) {
                const Primitive& primitive = self.cast<const Part&>().primitive;
                const py::ssize_t width = vertices_of(primitive.topology);
                py::array_t<uint32_t> array(
                    {static_cast<py::ssize_t>(primitive.indices.size()) / width, width},
                    primitive.indices.data(), self);
                array.attr("setflags")(py::arg("write") = false);
                return array;
            },
            "(m, 1 to 3) uint32, read-only: vertices of each point, line or triangle.")
        .def_property_readonly(
            "material", [](const Part& part) { return part.primitive.material; },
            "Number of the part's material.")
        .def("__repr__", [](const Part& part) {
            const Primitive& primitive = part.primitive;
            return fmt::format("<estampe.Part of {} vertices, {} elements>", primitive.positions.size(),
                               primitive.indices.size() /
                                   static_cast<size_t>(vertices_of(primitive.topology)));
        });
}

} // namespace estampe::python
