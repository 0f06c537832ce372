// SPDX-License-Identifier: MIT
// estampe.Layers: a picture separated into its layers and masks, which behaves as a mapping of names to
// arrays.
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <estampe/layers.hpp>

#include "arrays.hpp"
#include "bindings.hpp"

namespace estampe::python {
namespace {

const LayeredImage& image_in(const py::object& self)
{
    return self.cast<const LayeredImage&>();
}

py::array_t<float> pixels_of(const PictureLayer& layer, const py::object& self)
{
    return pixels_within(reinterpret_cast<const float*>(layer.image.pixels.data()), layer.image.width,
                         layer.image.height, self);
}

std::vector<std::string> layer_names(const LayeredImage& layers)
{
    std::vector<std::string> names;
    for (const PictureLayer& layer : layers.layers) {
        names.push_back(layer.name);
    }
    return names;
}

const PictureLayer* find_layer(const LayeredImage& layers, const std::string& name)
{
    for (const PictureLayer& layer : layers.layers) {
        if (layer.name == name) {
            return &layer;
        }
    }
    return nullptr;
}

const PictureLayer& layer_named(const LayeredImage& layers, const std::string& name)
{
    const PictureLayer* const layer = find_layer(layers, name);
    if (layer == nullptr) {
        throw py::key_error(name);
    }
    return *layer;
}

py::list masks_of(const py::object& self)
{
    py::list masks;
    for (const PictureMask& mask : image_in(self).masks) {
        const py::array_t<float> cover(
            {static_cast<py::ssize_t>(mask.height), static_cast<py::ssize_t>(mask.width)}, mask.cover.data(),
            self);
        masks.append(py::module_::import("estampe._picture")
                         .attr("Mask")(mask.name, mask.is_object, mask.x, mask.y, cover));
    }
    return masks;
}

py::object flatten(const LayeredImage& layers)
{
    LinearImage flat;
    {
        const Unlocked unlocked;
        flat = flattened(layers);
    }
    const py::object paper = flat.paper
                                 ? py::object(py::make_tuple(flat.paper->x, flat.paper->y, flat.paper->z))
                                 : py::object(py::none());
    return as_picture(array_owning<float>(std::move(flat.pixels), {flat.height, flat.width, 4}), paper);
}

void save(const LayeredImage& layers, const py::object& path)
{
    const std::filesystem::path file = path_of(path, "path");
    const std::string ending = lower_ending_of(file);
    if (!ending.empty() && ending != ".ora" && ending != ".exr") {
        throw py::value_error(
            fmt::format("path: layers are not written as \"{}\", but as .ora, .exr or a folder, "
                        "whose name has no ending, or a / after it",
                        ending));
    }
    const Unlocked unlocked;
    if (ending == ".ora") {
        save_openraster(layers, file);
    } else if (ending == ".exr") {
        save_layers_exr(layers, file);
    } else {
        save_layers(layers, file.has_filename() ? file : file.parent_path());
    }
}

py::list items_of(const py::object& self)
{
    py::list items;
    for (const PictureLayer& layer : image_in(self).layers) {
        items.append(py::make_tuple(layer.name, pixels_of(layer, self)));
    }
    return items;
}

py::list values_of(const py::object& self)
{
    py::list values;
    for (const PictureLayer& layer : image_in(self).layers) {
        values.append(pixels_of(layer, self));
    }
    return values;
}

} // namespace

void bind_layers(py::module_& module)
{
    py::class_<LayeredImage, std::shared_ptr<LayeredImage>>(
        module, "Layers",
        "A picture separated into its layers: a mapping of names, from bottom to top, to arrays.\n\n"
        "The layers are \"paper\", \"wash\", flowing ink if the style has any, \"hatch\" and \"lines\". Each "
        "is a\n"
        "(h, w, 4) float32 array of linear colour, premultiplied by alpha. An array shares its memory with "
        "the\n"
        "Layers, so a change of it is a change of what flattened() and save() take.")
        .def("__len__", [](const LayeredImage& self) { return self.layers.size(); })
        .def("__iter__", [](const LayeredImage& self) { return py::iter(py::cast(layer_names(self))); })
        .def("__contains__",
             [](const LayeredImage& self, const py::object& name) {
                 return py::isinstance<py::str>(name) &&
                        find_layer(self, name.cast<std::string>()) != nullptr;
             })
        .def(
            "__getitem__",
            [](const py::object& self, const std::string& name) {
                return pixels_of(layer_named(image_in(self), name), self);
            },
            py::arg("name"), "Return the (h, w, 4) float32 array of a layer. Raises KeyError.")
        .def(
            "get",
            [](const py::object& self, const py::object& name, const py::object& missing) {
                const PictureLayer* const layer = py::isinstance<py::str>(name)
                                                      ? find_layer(image_in(self), name.cast<std::string>())
                                                      : nullptr;
                return layer == nullptr ? missing : py::object(pixels_of(*layer, self));
            },
            py::arg("name"), py::arg("default") = py::none(),
            "Return the array of a layer, or `default` if there is none of this name.")
        .def("keys", &layer_names, "Return the names of the layers, from bottom to top, as a list.")
        .def("values", &values_of, "Return the arrays of the layers, from bottom to top, as a list.")
        .def("items", &items_of, "Return (name, array) of each layer, from bottom to top, as a list.")
        .def_property_readonly(
            "picture",
            [](const py::object& self) {
                const Image& picture = image_in(self).picture;
                return as_picture(pixels_within(picture.rgba.data(), picture.width, picture.height, self));
            },
            "The whole picture, (h, w, 4) uint8, with the same bytes as from Renderer.render().")
        .def_property_readonly("masks", &masks_of,
                               "Coverage of each object and effect, a list of Mask from bottom to top.")
        .def(
            "blend",
            [](const LayeredImage& self, const std::string& name) {
                return layer_named(self, name).blend == LayerBlend::multiply ? "multiply" : "normal";
            },
            py::arg("name"),
            "Return how a layer is blended over the layers below it: \"normal\" or \"multiply\".")
        .def(
            "is_visible",
            [](const LayeredImage& self, const std::string& name) {
                return layer_named(self, name).is_visible;
            },
            py::arg("name"),
            "Return whether a layer is part of the picture; the paper of a transparent picture is not.")
        .def("flattened", &flatten,
             "Composite the visible layers in linear light, and return a (h, w, 4) float32 Picture.\n\n"
             "Cost: about 10 ms per megapixel and layer.")
        .def("save", &save, py::arg("path"),
             "Write layers and masks as .ora (OpenRaster), .exr (OpenEXR), or as PNG files into a new "
             "folder.\n\n"
             "The ending of `path` decides; a name without an ending, or with a / after it, is a folder. "
             "Another\n"
             "ending raises ValueError. Raises Error if the file cannot be written, or the folder exists and "
             "is not empty. Cost: about "
             "2 s\n"
             "per megapixel as OpenRaster.")
        .def(
            "_repr_png_", [](const py::object& self) { return self.attr("picture").attr("_repr_png_")(); },
            "Return the whole picture as the bytes of a PNG file, for notebooks.")
        .def("__repr__", [](const LayeredImage& self) {
            return fmt::format("<estampe.Layers {}, {} x {} pixels>", fmt::join(layer_names(self), ", "),
                               self.picture.width, self.picture.height);
        });
}

} // namespace estampe::python
