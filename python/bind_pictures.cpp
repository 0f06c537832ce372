// SPDX-License-Identifier: MIT
// Functions that write pictures; estampe.Picture and the layers use them.
#include <optional>
#include <string>

#include <fmt/format.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <estampe/image.hpp>
#include <estampe/linear_image.hpp>

#include "arrays.hpp"
#include "bindings.hpp"

namespace estampe::python {

Image image_of(const py::object& pixels, const char* argument)
{
    const py::array array = numbers_of(pixels, argument, "u");
    if (array.dtype().itemsize() != 1) {
        throw py::type_error(fmt::format("{}: has the type {}, which is not uint8", argument,
                                         std::string(py::str(array.dtype()))));
    }
    const bool has_alpha = array.ndim() == 3 && array.shape(2) == 4;
    check_shape(array, argument, {any_length, any_length, has_alpha ? 4 : 3});
    constexpr py::ssize_t most_px = 65535;
    if (array.size() == 0 || array.shape(0) > most_px || array.shape(1) > most_px) {
        throw py::value_error(fmt::format("{}: each side must have 1 to {} pixels", argument, most_px));
    }
    const Dense<uint8_t> dense = Dense<uint8_t>::ensure(array);
    Image image{.width = static_cast<uint32_t>(dense.shape(1)),
                .height = static_cast<uint32_t>(dense.shape(0))};
    const size_t pixel_count = size_t{image.width} * image.height;
    if (has_alpha) {
        image.rgba.assign(dense.data(), dense.data() + dense.size());
        return image;
    }
    image.rgba.reserve(4 * pixel_count);
    for (size_t i = 0; i < pixel_count; ++i) {
        const uint8_t* const rgb = dense.data() + 3 * i;
        image.rgba.insert(image.rgba.end(), {rgb[0], rgb[1], rgb[2], uint8_t{255}});
    }
    return image;
}

py::object as_picture(const py::array& pixels, const py::object& paper)
{
    py::object picture = pixels.attr("view")(py::module_::import("estampe._picture").attr("Picture"));
    picture.attr("paper") = paper;
    return picture;
}

namespace {

LinearImage linear_image_of(const py::object& pixels, const py::object& paper)
{
    const Dense<float> array = finite_floats(pixels, "pixels", {any_length, any_length, 4});
    LinearImage image{.width = static_cast<uint32_t>(array.shape(1)),
                      .height = static_cast<uint32_t>(array.shape(0))};
    image.pixels.resize(static_cast<size_t>(array.size()) / 4);
    if (!image.pixels.empty()) {
        std::memcpy(static_cast<void*>(image.pixels.data()), array.data(),
                    sizeof(glm::vec4) * image.pixels.size());
    }
    if (!paper.is_none()) {
        image.paper = glm::vec3(three_numbers(paper, "paper"));
    }
    return image;
}

void write_png(const py::object& pixels, const py::object& path)
{
    const Image image = image_of(pixels, "pixels");
    const std::filesystem::path file = path_of(path, "path");
    const Unlocked unlocked;
    save_png(image, file);
}

void write_jpeg(const py::object& pixels, const py::object& path, int quality)
{
    number_within(quality, "quality", 1.0, 100.0);
    const Image image = image_of(pixels, "pixels");
    const std::filesystem::path file = path_of(path, "path");
    const Unlocked unlocked;
    save_jpeg(image, file, quality);
}

void write_webp(const py::object& pixels, const py::object& path, std::optional<int> quality)
{
    if (quality) {
        number_within(*quality, "quality", 0.0, 100.0);
    }
    const Image image = image_of(pixels, "pixels");
    const std::filesystem::path file = path_of(path, "path");
    const Unlocked unlocked;
    save_webp(image, file, quality);
}

void write_linear(const py::object& pixels, const py::object& path, const py::object& paper, bool is_exr)
{
    const LinearImage image = linear_image_of(pixels, paper);
    const std::filesystem::path file = path_of(path, "path");
    const Unlocked unlocked;
    if (is_exr) {
        save_exr(image, file);
    } else {
        save_png(image, file);
    }
}

py::object read_picture(const py::object& path)
{
    const std::filesystem::path file = path_of(path, "path");
    Image image;
    {
        const Unlocked unlocked;
        image = load_image(file);
    }
    return as_picture(array_owning<uint8_t>(std::move(image.rgba), {image.height, image.width, 4}));
}

} // namespace

void bind_pictures(py::module_& module)
{
    module.def("_save_png", &write_png, py::arg("pixels"), py::arg("path"),
               "Write (h, w, 3 or 4) uint8 as PNG.");
    module.def("_save_jpeg", &write_jpeg, py::arg("pixels"), py::arg("path"), py::arg("quality"),
               "Write (h, w, 3 or 4) uint8 as JPEG.");
    module.def("_save_webp", &write_webp, py::arg("pixels"), py::arg("path"), py::arg("quality"),
               "Write (h, w, 3 or 4) uint8 as WebP.");
    module.def("_save_linear", &write_linear, py::arg("pixels"), py::arg("path"), py::arg("paper"),
               py::arg("is_exr"), "Write (h, w, 4) linear floats as OpenEXR or 16-bit PNG.");
    module.def("load_image", &read_picture, py::arg("path"),
               "Read a PNG, JPEG, WebP, TIFF, TGA, BMP, GIF or PSD file as a Picture, (h, w, 4) uint8.\n\n"
               "Raises Error if the file is missing, truncated or too large.");
}

} // namespace estampe::python
