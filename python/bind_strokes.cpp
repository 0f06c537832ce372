// SPDX-License-Identifier: MIT
// estampe.Drawing and estampe.Stroke: a drawing as pen strokes.
#include <memory>
#include <string>
#include <utility>

#include <fmt/format.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <estampe/vector_drawing.hpp>

#include "arrays.hpp"
#include "bindings.hpp"

namespace estampe::python {
namespace {

// The points of a stroke are shown as an array with three columns.
static_assert(sizeof(VectorPoint) == 3 * sizeof(float));

/// One stroke of a drawing. It holds the whole drawing, which is never changed.
struct HeldStroke {
    std::shared_ptr<const VectorDrawing> drawing;
    size_t number = 0;

    [[nodiscard]] const VectorStroke& stroke() const { return drawing->strokes[number]; }
};

py::tuple tuple_of(const glm::vec3& color)
{
    return py::make_tuple(color.x, color.y, color.z);
}

py::list strokes_of(const std::shared_ptr<VectorDrawing>& drawing)
{
    py::list strokes;
    for (size_t i = 0; i < drawing->strokes.size(); ++i) {
        strokes.append(HeldStroke{drawing, i});
    }
    return strokes;
}

/// Numbers that Python's indexing allows: -1 is the last stroke.
py::object stroke_at(const std::shared_ptr<VectorDrawing>& drawing, const py::object& which)
{
    if (py::isinstance<py::slice>(which)) {
        return strokes_of(drawing)[which];
    }
    const py::ssize_t number = integer_of(which, "number");
    const auto count = static_cast<py::ssize_t>(drawing->strokes.size());
    const py::ssize_t positive = number < 0 ? number + count : number;
    if (positive < 0 || positive >= count) {
        throw py::index_error(fmt::format("stroke {} of {}", number, count));
    }
    return py::cast(HeldStroke{drawing, static_cast<size_t>(positive)});
}

void save_drawing(const VectorDrawing& drawing, const py::object& path, double tolerance_mm, bool plotter)
{
    const std::filesystem::path file = path_of(path, "path");
    if (const std::string ending = lower_ending_of(file); ending != ".svg") {
        throw py::value_error(fmt::format("path: strokes are not written as \"{}\", but as .svg", ending));
    }
    const SvgSettings settings{
        .tolerance_mm = static_cast<float>(number_within(tolerance_mm, "tolerance_mm", 0.001, 10.0)),
        .is_for_plotter = plotter};
    const Unlocked unlocked;
    save_svg(drawing, file, settings);
}

std::shared_ptr<VectorDrawing> for_plotter(const VectorDrawing& drawing)
{
    auto prepared = std::make_shared<VectorDrawing>(drawing);
    const Unlocked unlocked;
    prepare_for_plotter(*prepared);
    return prepared;
}

void bind_stroke(py::module_& module)
{
    py::class_<HeldStroke>(module, "Stroke", "One pen stroke: a centre line with a width at each point.")
        .def_property_readonly(
            "kind", [](const HeldStroke& self) { return name_of(self.stroke().kind); },
            "Kind of the stroke: \"hatch\", \"outline\", \"crease\" and so on.")
        .def_property_readonly(
            "object", [](const HeldStroke& self) { return self.drawing->objects[self.stroke().object]; },
            "Name of the object that the stroke belongs to.")
        .def_property_readonly(
            "ink",
            [](const HeldStroke& self) { return tuple_of(self.drawing->inks_srgb[self.stroke().ink]); },
            "Colour of the stroke: sRGB components from 0 to 1, a tuple of three floats.")
        .def_property_readonly(
            "is_hidden", [](const HeldStroke& self) { return self.stroke().is_hidden; },
            "Whether a surface hides the stroke.")
        .def_property_readonly(
            "is_closed", [](const HeldStroke& self) { return self.stroke().is_closed; },
            "Whether the stroke is a loop, whose last point equals its first.")
        .def_property_readonly(
            "points",
            [](const py::object& self) {
                const VectorStroke& stroke = self.cast<const HeldStroke&>().stroke();
                py::array_t<float> points({static_cast<py::ssize_t>(stroke.points.size()), py::ssize_t{3}},
                                          reinterpret_cast<const float*>(stroke.points.data()), self);
                points.attr("setflags")(py::arg("write") = false);
                return points;
            },
            "(n, 3) float32, read-only: x_mm, y_mm and width_mm of each point, on the page from its upper "
            "left\n"
            "corner, y down. The array shares the drawing's memory.")
        .def("__repr__", [](const HeldStroke& self) {
            const VectorStroke& stroke = self.stroke();
            return fmt::format("<estampe.Stroke {} of {}, {} points>", name_of(stroke.kind),
                               self.drawing->objects[stroke.object], stroke.points.size());
        });
}

} // namespace

void bind_strokes(py::module_& module)
{
    bind_stroke(module);
    py::class_<VectorDrawing, std::shared_ptr<VectorDrawing>>(
        module, "Drawing",
        "A drawing as pen strokes: a sequence of Stroke, in drawing order.\n\n"
        "The same scene and style always give the same order of strokes. Lengths are in millimetres of the "
        "page.")
        .def(
            "__len__", [](const VectorDrawing& self) { return self.strokes.size(); },
            "Return the number of strokes.")
        .def("__getitem__", &stroke_at, py::arg("number"),
             "Return a Stroke by its number; negative numbers count from the end. Raises IndexError.\n\n"
             "A slice returns a list of Stroke.")
        .def(
            "__iter__", [](const std::shared_ptr<VectorDrawing>& self) { return py::iter(strokes_of(self)); },
            "Iterate over all strokes.")
        .def_property_readonly("strokes", &strokes_of, "All strokes, a list of Stroke.")
        .def_property_readonly(
            "width_mm", [](const VectorDrawing& self) { return self.width_mm; }, "Width of the page.")
        .def_property_readonly(
            "height_mm", [](const VectorDrawing& self) { return self.height_mm; }, "Height of the page.")
        .def_property_readonly(
            "paper", [](const VectorDrawing& self) { return tuple_of(self.paper_srgb); },
            "Colour of the paper: sRGB components from 0 to 1, a tuple of three floats.")
        .def_property_readonly(
            "objects", [](const VectorDrawing& self) { return self.objects; },
            "Names of the drawn objects, a list.")
        .def("save", &save_drawing, py::arg("path"), py::kw_only(), py::arg("tolerance_mm") = 0.02,
             py::arg("plotter") = false,
             "Write the drawing as SVG in millimetres. Another ending of `path` than .svg raises "
             "ValueError.\n\n"
             "`tolerance_mm` is the largest distance of curves from the points. With `plotter` the file has "
             "centre\n"
             "lines only, one layer per pen. Raises Error if the file cannot be written. Cost: 2 us per "
             "point.")
        .def("for_plotter", &for_plotter,
             "Return a copy for a plotter, whose pens have one width each.\n\n"
             "Thin hatching is removed, hidden strokes are cut into dashes, strokes that continue each other "
             "are\n"
             "joined, and strokes are ordered for short ways. Cost: about 1 s for 20 000 strokes.")
        .def(
            "_repr_svg_",
            [](const py::object& self) {
                return py::module_::import("estampe._picture").attr("svg_text_of")(self);
            },
            "Return the text of the SVG file, for notebooks.")
        .def("__repr__", [](const VectorDrawing& self) {
            return fmt::format("<estampe.Drawing of {} strokes, {:.4g} x {:.4g} mm>", self.strokes.size(),
                               self.width_mm, self.height_mm);
        });
}

} // namespace estampe::python
