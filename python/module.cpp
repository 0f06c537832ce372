// SPDX-License-Identifier: MIT
// The extension estampe._estampe: its errors, and functions that belong to no class.
#include <algorithm>
#include <exception>
#include <limits>
#include <string>
#include <utility>

#include <fmt/format.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <estampe/error.hpp>
#include <estampe/renderer.hpp>

#include "arrays.hpp"
#include "bindings.hpp"

namespace estampe::python {

WorkLimits limits_of(const std::optional<double>& max_memory_bytes, const std::optional<double>& max_seconds)
{
    constexpr double infinite = std::numeric_limits<double>::infinity();
    WorkLimits limits;
    if (max_memory_bytes) {
        constexpr double most_bytes = 9e18; // below 2^63
        limits.max_memory_bytes = static_cast<uint64_t>(
            std::min(number_within(*max_memory_bytes, "max_memory", 1.0, infinite), most_bytes));
    }
    if (max_seconds) {
        limits.max_seconds = number_within(*max_seconds, "max_seconds", 1e-9, infinite);
    }
    return limits;
}

std::filesystem::path path_of(const py::object& value, const char* argument)
{
    // os.fsencode knows texts, bytes and path objects, and keeps names that are no valid UTF-8.
    try {
        return std::string(py::bytes(py::module_::import("os").attr("fsencode")(value)));
    } catch (const py::error_already_set& error) {
        if (!error.matches(PyExc_TypeError)) {
            throw;
        }
        throw py::type_error(fmt::format("{}: is not a text or a path", argument));
    }
}

std::string lower_ending_of(const std::filesystem::path& file)
{
    std::string ending = file.extension().string();
    for (char& letter : ending) {
        letter = letter >= 'A' && letter <= 'Z' ? static_cast<char>(letter - 'A' + 'a') : letter;
    }
    return ending;
}

namespace {

/// The exception types of the module. They live as long as the interpreter.
PyObject* error_type = nullptr;
PyObject* device_lost_type = nullptr;

PyObject* add_exception(py::module_& module, const char* name, PyObject* base, const char* doc)
{
    const std::string full_name = std::string("estampe.") + name;
    PyObject* const type = PyErr_NewExceptionWithDoc(full_name.c_str(), doc, base, nullptr);
    if (type == nullptr) {
        throw py::error_already_set();
    }
    module.attr(name) = py::handle(type);
    return type;
}

void raise(PyObject* type, const Error& error)
{
    const auto text = [](const std::string& line) {
        return py::reinterpret_steal<py::object>(
            PyUnicode_DecodeUTF8(line.data(), static_cast<py::ssize_t>(line.size()), "replace"));
    };
    const py::object instance = py::handle(type)(text(error.what()));
    instance.attr("where") = text(error.where());
    instance.attr("remedy") = text(error.remedy());
    PyErr_SetObject(type, instance.ptr());
}

void translate(std::exception_ptr thrown)
{
    try {
        if (thrown) {
            std::rethrow_exception(std::move(thrown));
        }
    } catch (const DeviceLost& error) {
        raise(device_lost_type, error);
    } catch (const Error& error) {
        raise(error_type, error);
    }
}

} // namespace

void bind_errors(py::module_& module)
{
    error_type =
        add_exception(module, "Error", PyExc_RuntimeError,
                      "Failure of the library: bad input, a missing file, an unavailable device.\n\n"
                      "The message is one line. `where` is a file, `file:line:column` or\n"
                      "`file#/json/pointer`, and `remedy` is what the user can do; both may be empty.");
    py::handle(error_type).attr("where") = "";
    py::handle(error_type).attr("remedy") = "";
    device_lost_type =
        add_exception(module, "DeviceLost", error_type,
                      "The graphics device was lost: all further work of its Renderer fails, but a\n"
                      "Renderer that is made afterwards may succeed.");
    py::register_exception_translator(translate);
}

namespace {

void bind_devices(py::module_& module)
{
    py::class_<DeviceInfo>(module, "Device", "A Vulkan device of this machine, see devices().")
        .def_readonly("index", &DeviceInfo::index, "Number of the device, for Renderer(device=...).")
        .def_readonly("name", &DeviceInfo::name, "Name of the device.")
        .def_readonly("driver", &DeviceInfo::driver, "Name and version of the driver.")
        .def_readonly("software", &DeviceInfo::software,
                      "Whether the device is software that runs on the CPU.")
        .def_readonly("usable", &DeviceInfo::usable, "Whether a Renderer can draw on the device.")
        .def_readonly("why_not", &DeviceInfo::why_not,
                      "Reason why the device is not usable, or an empty text.")
        .def("__repr__", [](const DeviceInfo& device) {
            return fmt::format("<estampe.Device {}: {}>", device.index, device.name);
        });
    module.def("devices", &list_devices, py::call_guard<Unlocked>(),
               "Return the Vulkan devices of this machine, as a list of Device.\n\n"
               "The list is empty if no Vulkan driver is installed. Cost: some milliseconds.");
}

} // namespace
} // namespace estampe::python

PYBIND11_MODULE(_estampe, module)
{
    using namespace estampe::python;
    module.doc() = "Extension of the package estampe; see estampe.";
    module.attr("__version__") = ESTAMPE_VERSION;
    bind_errors(module);
    bind_devices(module);
    bind_pictures(module);
    bind_style(module);
    bind_camera(module);
    bind_part(module);
    bind_scene(module);
    bind_layers(module);
    bind_strokes(module);
    bind_renderer(module);
    py::module_::import("atexit").attr("register")(py::cpp_function(&finish_threads));
}
