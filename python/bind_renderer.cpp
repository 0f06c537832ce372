// SPDX-License-Identifier: MIT
// estampe.Renderer: draws scenes without Python's global lock (GIL), one call after another.
#include <algorithm>
#include <cmath>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <unistd.h>

#include <fmt/format.h>
#include <glm/gtc/quaternion.hpp>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <estampe/error.hpp>
#include <estampe/renderer.hpp>

#include "arrays.hpp"
#include "bindings.hpp"

namespace estampe::python {
namespace {

/// A renderer of the library with the scene that it draws. Calls from several threads wait for each other.
class SharedRenderer {
public:
    explicit SharedRenderer(const RendererOptions& options)
        : renderer_(std::make_unique<Renderer>(options)), process_(getpid())
    {
    }

    ~SharedRenderer()
    {
        if (getpid() != process_) {
            // The threads and the device stay with the parent process, so a forked one cannot close them.
            static_cast<void>(renderer_.release());
        }
    }

    SharedRenderer(const SharedRenderer&) = delete;
    SharedRenderer& operator=(const SharedRenderer&) = delete;

    /// Calls `use` with the renderer, its scene and its lock held, without the GIL. The scene may be null.
    template <typename Use>
    auto with_renderer(Use use)
    {
        check_process();
        const Unlocked unlocked; // before the lock, so that no thread holds the GIL and waits
        const std::scoped_lock lock(mutex_);
        return use(*renderer_, scene_);
    }

    void set_scene(std::shared_ptr<const LitScene> scene)
    {
        check_process();
        const Unlocked unlocked;
        const std::scoped_lock lock(mutex_);
        renderer_->set_scene(scene->scene, scene->lightmap ? &*scene->lightmap : nullptr);
        scene_ = std::move(scene);
    }

private:
    /// Throws Error in a forked process, where another thread may hold the lock for ever, and where the
    /// driver's threads are missing.
    void check_process() const
    {
        if (getpid() != process_) {
            throw Error(
                "the renderer belongs to another process", {},
                "use the start method \"spawn\" of multiprocessing, and make a Renderer in each process");
        }
    }

    std::mutex mutex_;
    std::unique_ptr<Renderer> renderer_;
    pid_t process_;
    std::shared_ptr<const LitScene> scene_;
};

/// What a picture is drawn of: a copy of every argument, so that other threads may change theirs meanwhile.
struct DrawRequest {
    CameraChoice camera;
    Style style;
    RenderSettings settings;
    AnimationChoice animation = py::ssize_t{0}; ///< Found in the scene that the renderer draws
    /// Camera and time that motion is measured from; the time alone means the picture's own camera choice.
    std::optional<std::pair<CameraChoice, double>> motion_since;
};

void assign_transparency(Style& style, const py::object& transparent)
{
    if (transparent.is_none()) {
        return;
    }
    if (PyBool_Check(transparent.ptr())) {
        style.set(transparent.cast<bool>() ? "paper.transparent=background" : "paper.transparent=none");
        return;
    }
    if (!py::isinstance<py::str>(transparent)) {
        throw py::type_error("transparent: is not None, True, False, \"background\", \"paper\" or \"none\"");
    }
    style.set("paper.transparent=" + transparent.cast<std::string>());
}

uint32_t side_of(py::ssize_t length_px, const char* argument)
{
    constexpr double most_px = 65535.0;
    return static_cast<uint32_t>(number_within(static_cast<double>(length_px), argument, 1.0, most_px));
}

/// Applies a Page: its size in pixels, and the height in millimetres to which the style's lengths refer.
void apply_page(const py::object& page, DrawRequest& request)
{
    const py::object type = py::module_::import("estampe._page").attr("Page");
    if (!py::isinstance(page, type)) {
        throw py::type_error("page: is not a Page");
    }
    // Page._replace() sets fields without a check.
    constexpr double least_mm = 10.0;
    constexpr double most_mm = 5000.0;
    double height_mm = 0.0;
    try {
        request.settings.width = side_of(page.attr("width").cast<py::ssize_t>(), "page.width");
        request.settings.height = side_of(page.attr("height").cast<py::ssize_t>(), "page.height");
        height_mm = page.attr("height_mm").cast<double>();
    } catch (const py::cast_error&) {
        throw py::value_error("page: a side is not a number");
    }
    number_within(height_mm, "page.height_mm", least_mm, most_mm);
    request.style.set(fmt::format("paper.height_mm={}", height_mm));
}

/// Reads the keywords that all drawing methods share. Throws TypeError for a keyword that is unknown.
DrawRequest request_of(const py::object& camera, const py::object& style, const py::kwargs& keywords)
{
    DrawRequest request{.camera = camera_of(camera, "camera"), .style = style_of(style)};
    RenderSettings& settings = request.settings;
    py::object page = py::none();
    py::object transparent = py::none();
    std::optional<double> max_memory;
    std::optional<double> max_seconds;
    bool has_size = false;
    for (const auto& keyword : keywords) {
        const auto name = keyword.first.cast<std::string>();
        const py::handle value = keyword.second;
        const auto read = [&](auto& target) {
            try {
                target = value.template cast<std::remove_reference_t<decltype(target)>>();
            } catch (const py::cast_error&) {
                throw py::type_error(fmt::format("{}: has the wrong type {}", name,
                                                 std::string(py::str(py::type::of(value)))));
            }
        };
        if (name == "width" || name == "height") {
            py::ssize_t length_px = 0;
            read(length_px);
            (name == "width" ? settings.width : settings.height) = side_of(length_px, name.c_str());
            has_size = true;
        } else if (name == "time_s") {
            read(settings.time_s);
            number_within(settings.time_s, "time_s", -1e9, 1e9);
        } else if (name == "samples") {
            py::ssize_t samples = 0;
            read(samples);
            settings.samples =
                static_cast<uint32_t>(number_within(static_cast<double>(samples), "samples", 1.0, 4096.0));
        } else if (name == "animation") {
            request.animation = animation_choice_of(py::reinterpret_borrow<py::object>(value));
        } else if (name == "transparent") {
            transparent = py::reinterpret_borrow<py::object>(value);
        } else if (name == "page") {
            page = py::reinterpret_borrow<py::object>(value);
        } else if (name == "follows") {
            std::optional<bool> follows;
            read(follows);
            settings.continuity = !follows   ? Continuity::still
                                  : *follows ? Continuity::follows
                                             : Continuity::starts;
        } else if (name == "max_memory") {
            read(max_memory);
        } else if (name == "max_seconds") {
            read(max_seconds);
        } else {
            throw py::type_error(fmt::format("{}: is not an argument of this method", name));
        }
    }
    settings.limits = limits_of(max_memory, max_seconds);
    assign_transparency(request.style, transparent);
    if (!page.is_none()) {
        if (has_size) {
            throw py::value_error("page: is not valid together with width or height");
        }
        apply_page(page, request);
    }
    return request;
}

/// Calls `draw` with the renderer, the placed camera and the settings of a request, without the GIL.
template <typename Draw>
auto draw_request(SharedRenderer& self, DrawRequest& request, Draw draw)
{
    return self.with_renderer([&](Renderer& renderer, const std::shared_ptr<const LitScene>& lit) {
        if (!lit) {
            throw Error("there is no scene to draw", {}, "call set_scene first");
        }
        RenderSettings& settings = request.settings;
        settings.animation = find_animation(request.animation, lit->scene);
        CameraPage page{settings.width, settings.height, settings.time_s, settings.animation};
        const Camera camera = resolve_camera(request.camera, lit->scene, request.style, page);
        if (request.motion_since) {
            page.time_s = request.motion_since->second;
            settings.motion_since = {
                .camera = resolve_camera(request.motion_since->first, lit->scene, request.style, page),
                .time_s = page.time_s};
        }
        return draw(renderer, camera, request.style, settings);
    });
}

py::object render(SharedRenderer& self, const py::object& camera, const py::object& style,
                  const py::kwargs& keywords)
{
    DrawRequest request = request_of(camera, style, keywords);
    Image image = draw_request(
        self, request, [](Renderer& renderer, const auto&... how) { return renderer.render(how...); });
    return as_picture(array_owning<uint8_t>(std::move(image.rgba), {image.height, image.width, 4}));
}

py::object render_linear(SharedRenderer& self, const py::object& camera, const py::object& style,
                         const py::kwargs& keywords)
{
    DrawRequest request = request_of(camera, style, keywords);
    LinearImage image = draw_request(
        self, request, [](Renderer& renderer, const auto&... how) { return renderer.render_linear(how...); });
    const py::object paper = image.paper
                                 ? py::object(py::make_tuple(image.paper->x, image.paper->y, image.paper->z))
                                 : py::object(py::none());
    return as_picture(array_owning<float>(std::move(image.pixels), {image.height, image.width, 4}), paper);
}

std::shared_ptr<LayeredImage> layers(SharedRenderer& self, const py::object& camera, const py::object& style,
                                     const py::kwargs& keywords)
{
    DrawRequest request = request_of(camera, style, keywords);
    return std::make_shared<LayeredImage>(
        draw_request(self, request,
                     [](Renderer& renderer, const auto&... how) { return renderer.render_layers(how...); }));
}

std::shared_ptr<VectorDrawing> strokes(SharedRenderer& self, const py::object& camera,
                                       const py::object& style, bool hidden, const py::kwargs& keywords)
{
    DrawRequest request = request_of(camera, style, keywords);
    const HiddenLines lines = hidden ? HiddenLines::kept : HiddenLines::left_out;
    return std::make_shared<VectorDrawing>(
        draw_request(self, request, [&](Renderer& renderer, const auto&... how) {
            return renderer.draw_strokes(how..., lines);
        }));
}

py::object motion(SharedRenderer& self, const py::object& camera, const py::object& style,
                  double since_time_s, const py::object& since_camera, const py::kwargs& keywords)
{
    DrawRequest request = request_of(camera, style, keywords);
    request.motion_since.emplace(since_camera.is_none() ? request.camera
                                                        : camera_of(since_camera, "since_camera"),
                                 number_within(since_time_s, "since_time_s", -1e9, 1e9));
    Motion motion = draw_request(self, request, [](Renderer& renderer, const auto&... how) {
        return renderer.render_buffers(how...).motion;
    });
    return array_owning<float>(std::move(motion.pixels), {motion.height, motion.width, 4});
}

py::object buffers(SharedRenderer& self, const py::object& camera, const py::object& style,
                   const py::kwargs& keywords)
{
    DrawRequest request = request_of(camera, style, keywords);
    SurfaceBuffers found = draw_request(self, request, [](Renderer& renderer, const auto&... how) {
        return renderer.render_buffers(how...);
    });
    const py::ssize_t height = found.height;
    const py::ssize_t width = found.width;
    static_assert(static_cast<int32_t>(no_index) == -1); // the number that stands for nothing in Python
    return py::module_::import("estampe._picture")
        .attr("Buffers")(array_owning<float>(std::move(found.depth_m), {height, width}),
                         array_owning<float>(std::move(found.normals), {height, width, 3}),
                         array_owning<int32_t>(std::move(found.objects), {height, width}),
                         array_owning<int32_t>(std::move(found.materials), {height, width}));
}

/// Takes a matrix apart. Throws ValueError if its axes are not at right angles or have no length.
Transform transform_of(const glm::dmat4& matrix, const char* argument)
{
    glm::dvec3 scale(0.0);
    glm::dmat3 axes(matrix);
    for (int axis = 0; axis < 3; ++axis) {
        scale[axis] = glm::length(axes[axis]);
        if (!(scale[axis] > 0.0)) {
            throw py::value_error(fmt::format("{}: is scaled to nothing", argument));
        }
        axes[axis] /= scale[axis];
    }
    constexpr double sheared = 1e-4; // cosine of the angle between two axes
    if (std::max({std::abs(glm::dot(axes[0], axes[1])), std::abs(glm::dot(axes[0], axes[2])),
                  std::abs(glm::dot(axes[1], axes[2]))}) > sheared) {
        throw py::value_error(
            fmt::format("{}: is sheared; only moved, turned and scaled places are allowed", argument));
    }
    if (glm::determinant(axes) < 0.0) {
        scale.x = -scale.x;
        axes[0] = -axes[0];
    }
    return {.translation = glm::dvec3(matrix[3]), .rotation = glm::quat_cast(axes), .scale = scale};
}

/// Returns the keys of a dict as indices below `count`, with their values.
std::vector<std::pair<Index, py::object>> indexed_values(const py::dict& values, const char* argument,
                                                         size_t count)
{
    std::vector<std::pair<Index, py::object>> indexed;
    for (const auto& [key, value] : values) {
        indexed.emplace_back(optional_index(integer_of(key, argument), argument, count),
                             py::reinterpret_borrow<py::object>(value));
    }
    return indexed;
}

/// Returns the scene that the renderer draws. Throws Error if there is none.
std::shared_ptr<const LitScene> scene_of(SharedRenderer& self)
{
    std::shared_ptr<const LitScene> scene =
        self.with_renderer([](Renderer&, const std::shared_ptr<const LitScene>& lit) { return lit; });
    if (!scene) {
        throw Error("there is no scene", {}, "call set_scene first");
    }
    return scene;
}

void place(SharedRenderer& self, const py::dict& matrices, double time_s)
{
    number_within(time_s, "time_s", -1e9, 1e9);
    std::vector<NodePlace> places;
    for (const auto& [node, matrix] :
         indexed_values(matrices, "matrices", scene_of(self)->scene.nodes.size())) {
        places.push_back(
            {.node = node, .transform = transform_of(placement_of(matrix, "matrices"), "matrices")});
    }
    self.with_renderer([&](Renderer& renderer, const auto&) { renderer.place(places, time_s); });
}

void set_brightness(SharedRenderer& self, const py::dict& intensities)
{
    std::vector<LightBrightness> lights;
    for (const auto& [light, value] :
         indexed_values(intensities, "intensities", scene_of(self)->scene.lights.size())) {
        if (!PyNumber_Check(value.ptr()) || py::isinstance<py::array>(value)) {
            throw py::type_error("intensities: a value is not a number");
        }
        const double intensity = number_within(py::float_(value), "intensities", 0.0, 1e12);
        lights.push_back({.light = light, .intensity = static_cast<float>(intensity)});
    }
    self.with_renderer([&](Renderer& renderer, const auto&) { renderer.set_brightness(lights); });
}

std::unique_ptr<SharedRenderer> make_renderer(const py::object& device)
{
    if (!py::isinstance<py::str>(device) && (!PyIndex_Check(device.ptr()) || PyBool_Check(device.ptr()))) {
        throw py::type_error("device: is not \"auto\", \"cpu\" or a number of devices()");
    }
    const RendererOptions options{.device = std::string(py::str(device))};
    const Unlocked unlocked;
    return std::make_unique<SharedRenderer>(options);
}

constexpr const char* renderer_doc =
    R"(Draws scenes on one Vulkan device, and keeps its shaders and its scene from picture to picture.

device is "auto" (a GPU if there is one, else the CPU), "cpu", or a number of devices(). Raises Error if no device
can draw. All drawing methods release Python's global lock; a Renderer that several threads use draws one picture
after another. Cost: about 0.1 s, and shaders are compiled with the first picture.

All drawing methods take these arguments:

camera       None (the first camera of the scene, or else "auto"), a text or a Camera
style        None (the default style), the name of a style or a Style
width        width of the picture in pixels, 1 to 65535 [1280]
height       height of the picture in pixels, 1 to 65535 [720]
page         a Page instead of width and height
time_s       time of the scene's animation in seconds [0]
animation    name or number of the animation [0]
samples      number of drawings with sub-pixel jitter that are averaged [1]
transparent  True or "background" leaves the paper behind the scene transparent, "paper" all bare paper
follows      None: a single picture; False: the first frame of a film; True: the next frame of a film, whose
             lines continue those of the frame before
max_memory   limit of the memory in bytes [what is free]
max_seconds  limit of the time in seconds [none]

A drawing that has begun cannot be interrupted: Ctrl-C takes effect when it is complete, or when max_seconds are over.
A program that ends waits for the pictures that daemon threads draw. A Renderer cannot be used in a forked process.

They raise Error if there is no scene, memory runs out or the device is lost, and TypeError, ValueError or IndexError,
which name the argument, for wrong arguments.)";

} // namespace

void bind_renderer(py::module_& module)
{
    py::class_<SharedRenderer> renderer(module, "Renderer", renderer_doc);
    renderer.def(py::init(&make_renderer), py::arg("device") = "auto", "Open a device; see the class.")
        .def_property_readonly(
            "device",
            [](SharedRenderer& self) {
                return self.with_renderer([](Renderer& opened, const auto&) { return opened.device(); });
            },
            "The device that the renderer draws on, a Device.")
        .def_property_readonly(
            "notes",
            [](SharedRenderer& self) {
                return self.with_renderer([](Renderer& opened, const auto&) { return opened.notes(); });
            },
            "Automatic decisions for the last picture, a list of one line of text each.")
        .def(
            "set_scene",
            [](SharedRenderer& self, const py::object& scene) {
                self.set_scene(scene_argument(scene).snapshot());
            },
            py::arg("scene"),
            "Upload a scene, which replaces the previous one.\n\n"
            "Later changes of the Scene are drawn after another call. Raises Error if the scene exceeds the\n"
            "memory or the limits of the device.")
        .def("place", &place, py::arg("matrices"), py::arg("time_s") = 0.0,
             "Place nodes from a time of the scene on, without another set_scene().\n\n"
             "`matrices` is a dict of node numbers and (4, 4) matrices that transform column vectors from "
             "the node's\n"
             "space to its parent's; they move, turn and scale. Between two calls the places are "
             "interpolated by\n"
             "time. A placed node is no longer animated. Automatic cameras still frame the scene as it was "
             "set.\n"
             "Cost: linear in nodes.")
        .def("set_brightness", &set_brightness, py::arg("intensities"),
             "Set the brightness of lights from the next picture on, without another set_scene().\n\n"
             "`intensities` is a dict of light numbers and intensities, in the units of Scene.add_light().")
        .def("render", &render, py::arg("camera") = py::none(), py::arg("style") = py::none(),
             "Draw the scene, and return a Picture: (h, w, 4) uint8, sRGB with straight alpha.\n\n"
             "Keywords are those of the class. Equal arguments give equal bytes on one device.")
        .def("render_linear", &render_linear, py::arg("camera") = py::none(), py::arg("style") = py::none(),
             "Draw the scene, and return a Picture: (h, w, 4) float32, linear light, premultiplied alpha.\n\n"
             "Keywords are those of the class. Picture.paper is the colour that a transparent picture leaves "
             "out.")
        .def("layers", &layers, py::arg("camera") = py::none(), py::arg("style") = py::none(),
             "Draw the scene, and return its Layers: a mapping of names to (h, w, 4) float32.\n\n"
             "Keywords are those of the class. Cost: as render(), and four more passes over the page.")
        .def("strokes", &strokes, py::arg("camera") = py::none(), py::arg("style") = py::none(),
             py::arg("hidden") = false,
             "Return the strokes of render() as a Drawing, a sequence of Stroke.\n\n"
             "With `hidden` the strokes that surfaces hide are included. Keywords are those of the class; "
             "samples\n"
             "is ignored. A larger size gives finer paths. Raises Error if the style draws strokes without "
             "paths.")
        .def(
            "buffers", &buffers, py::arg("camera") = py::none(), py::arg("style") = py::none(),
            "Return what each pixel of render() shows of the scene, as Buffers: distance, normal, node and\n"
            "material.\n\n"
            "No picture is drawn. The style matters for its margin and for the parts of transparent surfaces "
            "that\n"
            "it draws as solid. Keywords are those of the class; samples is ignored. Cost: a small part of "
            "render().")
        .def("motion", &motion, py::arg("camera") = py::none(), py::arg("style") = py::none(), py::kw_only(),
             py::arg("since_time_s"), py::arg("since_camera") = py::none(),
             "Return how far each point has moved on the page: (h, w, 4) float32. No picture is drawn.\n\n"
             "The columns are pixels to the right, pixels down, reversed depth at the other moment, and 1 (0 "
             "if the\n"
             "point was behind the camera). The other moment is `since_time_s`, seen from `since_camera` "
             "(None: the\n"
             "same camera). Keywords are those of the class; samples is ignored.")
        .def("__repr__", [](SharedRenderer& self) {
            return self.with_renderer([](Renderer& opened, const std::shared_ptr<const LitScene>& lit) {
                return fmt::format("<estampe.Renderer on {}, {}>", opened.device().name,
                                   lit ? fmt::format("with a scene of {} nodes", lit->scene.nodes.size())
                                       : "without a scene");
            });
        });
}

} // namespace estampe::python
