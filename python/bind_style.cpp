// SPDX-License-Identifier: MIT
// estampe._estampe.Style: the part of estampe.Style that the library does; estampe/_style.py makes it a
// mapping.
#include <filesystem>
#include <string>
#include <vector>

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <estampe/style.hpp>

#include "bindings.hpp"

namespace estampe::python {

Style style_of(const py::object& value)
{
    if (value.is_none()) {
        return {};
    }
    if (py::isinstance<py::str>(value)) {
        return py::module_::import("estampe").attr("Style")(value).cast<const Style&>();
    }
    if (!py::isinstance<Style>(value)) {
        throw py::type_error("style: is not None, the name of a style or a Style");
    }
    return value.cast<const Style&>();
}

namespace {

/// Reads a style, whose files are limited to `folders` unless there are none.
Style load_style(const py::object& name, const std::vector<std::string>& folders)
{
    const std::string text = path_of(name, "name").string();
    const ReadScope scope{{folders.begin(), folders.end()}};
    const Unlocked unlocked;
    return Style::load(text, scope);
}

/// Returns the folders to which the style of a name is confined, at least one.
py::list folders_of(const py::object& name)
{
    ReadScope scope = Style::scope_of(path_of(name, "name").string());
    if (!scope.is_limited()) {
        // Presets read no file, and a scope without folders has no limit. The null device is no folder, so it
        // holds no file.
        scope.folders.emplace_back("/dev/null");
    }
    py::list folders;
    for (const std::filesystem::path& folder : scope.folders) {
        folders.append(py::bytes(folder.string()));
    }
    return folders;
}

} // namespace

void bind_style(py::module_& module)
{
    py::class_<Style>(module, "Style", "Parameters of a picture; estampe.Style adds the mapping.")
        .def(py::init<const Style&>(), py::arg("other"), "Copy a style.")
        .def(py::init(&load_style), py::arg("name") = "default",
             py::arg("folders") = std::vector<std::string>(),
             "Read a preset, a file, or several joined by '+'. Files are read in `folders` alone, if there "
             "are "
             "any.")
        .def_static("_folders_of", &folders_of, py::arg("name"),
                    "Return the folders to which a style of this name is confined, a list of bytes.")
        .def(
            "_limit_files",
            [](Style& self, const std::vector<std::string>& folders) {
                self.limit_files({{folders.begin(), folders.end()}});
            },
            py::arg("folders"), "Limit the files that parameters name to folders.")
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
