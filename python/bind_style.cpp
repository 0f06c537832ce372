// SPDX-License-Identifier: MIT
// estampe._estampe.Style: the part of estampe.Style that the library does; estampe/_style.py makes it a
// mapping.
#include <algorithm>
#include <string>
#include <vector>

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <estampe/style.hpp>

#include "bindings.hpp"

namespace estampe::python {
namespace {

/// Splits a name that joins several styles by '+'. The part "default" is left out: it changes no parameter.
std::vector<std::string> parts_of_name(const std::string& name)
{
    std::vector<std::string> parts;
    size_t begin = 0;
    while (begin <= name.size()) {
        const size_t end = std::min(name.find('+', begin), name.size());
        if (const std::string part = name.substr(begin, end - begin); part != "default") {
            parts.push_back(part);
        }
        begin = end + 1;
    }
    return parts;
}

Style load_style(const py::object& name, bool confine)
{
    const std::vector<std::string> parts = parts_of_name(path_of(name, "name").string());
    std::string joined;
    ReadScope scope; // with `confine` the folders of all parts; a preset has no folder and reads no file
    for (const std::string& part : parts) {
        joined += (joined.empty() ? "" : "+") + part;
        if (confine) {
            scope.folders.push_back(ReadScope::beside(part).folders.front());
        }
    }
    const py::gil_scoped_release unlocked;
    Style style = parts.empty() ? Style() : Style::load(joined, scope);
    if (confine && parts.empty()) {
        style.limit_files({{"."}});
    }
    return style;
}

} // namespace

void bind_style(py::module_& module)
{
    py::class_<Style>(module, "Style", "Parameters of a picture; estampe.Style adds the mapping.")
        .def(py::init<const Style&>(), py::arg("other"), "Copy a style.")
        .def(py::init(&load_style), py::arg("name") = "default", py::arg("confine") = false,
             "Read a preset, a file, or several joined by '+'.")
        .def("set", &Style::set, py::arg("assignment"),
             "Apply one assignment, such as \"hatch.contrast=12\".\n\n"
             "Raises Error for an unknown key, with the nearest known one, and for a value out of range.")
        .def("to_toml", &Style::to_toml,
             "Return all parameters as TOML, which Style.load() reads back to an equal style.")
        .def_static("_json_schema", &Style::json_schema, "JSON schema of all parameters, as text.")
        .def_static("presets", &Style::presets, "Return the names of the presets, a list of texts.")
        .def_static("additions", &Style::additions,
                    "Return the names of the additions, such as \"no-color\" in \"comic+no-color\".")
        .def_static(
            "about", &Style::about, py::arg("name"),
            "Return one line that describes a preset or an addition. Raises Error for an unknown name.")
        .def_static("help", &Style::help, py::arg("section") = "",
                    "Return the manual of a section of parameters, such as \"hatch\", or of all sections.");
}

} // namespace estampe::python
