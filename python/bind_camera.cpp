// SPDX-License-Identifier: MIT
// estampe.Camera: cameras as the command line has them, and cameras of numbers.
#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <estampe/error.hpp>

#include "arrays.hpp"
#include "bindings.hpp"

namespace estampe::python {
namespace {

constexpr double largest_view_m = 1e12;

bool has_any(const std::string& text, std::initializer_list<const char*> words)
{
    return std::any_of(words.begin(), words.end(),
                       [&](const char* word) { return text.find(word) != std::string::npos; });
}

/// Returns the first node of the scene that has a camera; no_index if there is none.
Index first_placed_camera(const Scene& scene)
{
    Index first = no_index;
    for (const Node& node : scene.nodes) {
        first = std::min(first, node.camera);
    }
    return first;
}

/// Returns the direction from which a camera sees its target.
ViewDirection direction_of_camera(const Camera& camera)
{
    const glm::dvec3 back = glm::normalize(camera.eye - camera.target);
    return {.azimuth_deg = glm::degrees(std::atan2(back.x, back.z)),
            .elevation_deg = glm::degrees(std::asin(std::clamp(back.y, -1.0, 1.0)))};
}

bool has_camera_named(const Scene& scene, const std::string& name)
{
    return std::any_of(scene.cameras.begin(), scene.cameras.end(),
                       [&](const SceneCamera& camera) { return camera.name == name; });
}

Camera seen_from(const Scene& scene, const ScenePose& pose, double aspect, ViewDirection direction,
                 bool parallel)
{
    if (scene.meshes.empty()) {
        throw Error("the scene has no objects to frame from a side", {},
                    "give the camera an eye and a target");
    }
    direction.parallel = direction.parallel || parallel;
    return view_camera(scene, pose, aspect, direction);
}

} // namespace

CameraChoice parse_camera_choice(const std::string& text)
{
    CameraChoice choice;
    if (text == "auto") {
        choice.kind = CameraKind::framed;
    } else if (has_any(text, {"azimuth=", "elevation=", "distance="})) {
        choice.kind = CameraKind::directed;
        choice.direction = parse_view_direction(text);
    } else if (has_any(text, {"eye=", "target=", "fov="})) {
        choice.kind = CameraKind::placed;
        // Without a target the camera looks at the origin.
        choice.placed = parse_camera(has_any(text, {"target="}) ? text : text + " target=0,0,0");
    } else if (text.empty()) {
        throw py::value_error("camera: the text is empty");
    } else {
        choice.kind = CameraKind::named;
        choice.name = text;
    }
    return choice;
}

CameraChoice camera_of(const py::object& value, const char* argument)
{
    if (value.is_none()) {
        return {};
    }
    if (py::isinstance<py::str>(value)) {
        return parse_camera_choice(value.cast<std::string>());
    }
    if (py::isinstance<CameraChoice>(value)) {
        return value.cast<CameraChoice>();
    }
    throw py::type_error(fmt::format("{}: is not None, a text or a Camera", argument));
}

Camera resolve_camera(const CameraChoice& choice, const Scene& scene, const Style& style,
                      const CameraPage& page)
{
    if (choice.kind == CameraKind::placed) {
        return choice.parallel ? with_parallel_projection(choice.placed, choice.placed.target)
                               : choice.placed;
    }
    const double aspect = style.window_aspect(page.width, page.height);
    const ScenePose pose = pose_scene(scene, page.time_s, page.animation);
    if (choice.kind == CameraKind::directed) {
        return seen_from(scene, pose, aspect, choice.direction, choice.parallel);
    }
    if (choice.kind == CameraKind::named && !has_camera_named(scene, choice.name)) {
        if (const std::optional<NamedView> view = named_view(choice.name)) {
            return seen_from(scene, pose, aspect, direction_of(*view), choice.parallel);
        }
    }
    const Index first = first_placed_camera(scene);
    if (choice.kind == CameraKind::named || (choice.kind == CameraKind::automatic && first != no_index)) {
        const Camera camera =
            scene_camera(scene, pose, choice.kind == CameraKind::named ? choice.name : std::to_string(first));
        return choice.parallel ? with_parallel_projection(camera, scene_bounds(scene, pose).center())
                               : camera;
    }
    const Camera framed = framing_camera(scene, pose, aspect, style.sun_bearing());
    return choice.parallel ? seen_from(scene, pose, aspect, direction_of_camera(framed), true) : framed;
}

namespace {

/// Checks that a placed camera has a direction, as the library requires it.
void check_direction(const Camera& camera)
{
    const glm::dvec3 forward = camera.target - camera.eye;
    if (!(glm::length(forward) > 0.0)) {
        throw py::value_error("target: is the same point as eye");
    }
    if (!(glm::length(glm::cross(glm::normalize(forward), camera.up)) > 1e-9)) {
        throw py::value_error("up: points along the line of sight, or has no length");
    }
}

Camera camera_of_matrix(const py::object& matrix)
{
    const glm::dmat4 world_from_camera = placement_of(matrix, "matrix");
    const glm::dvec3 back(world_from_camera[2]);
    const glm::dvec3 up(world_from_camera[1]);
    if (!(glm::length(back) > 0.0) || !(glm::length(up) > 0.0)) {
        throw py::value_error("matrix: is scaled to nothing");
    }
    Camera camera;
    camera.eye = glm::dvec3(world_from_camera[3]);
    camera.target = camera.eye - glm::normalize(back);
    camera.up = glm::normalize(up);
    return camera;
}

CameraChoice make_camera(const std::optional<std::string>& text, const py::object& eye,
                         const py::object& target, const py::object& up, const py::object& matrix,
                         const std::optional<double>& fov_deg, const std::optional<double>& half_height_m,
                         const std::optional<double>& near_m, bool ortho, const py::object& shift)
{
    const bool has_numbers = !eye.is_none() || !target.is_none() || !up.is_none() || !matrix.is_none() ||
                             fov_deg || half_height_m || near_m || !shift.is_none();
    CameraChoice choice;
    if (text) {
        if (has_numbers) {
            throw py::value_error(
                "text: is not valid together with eye, target, up, matrix, fov_deg, half_height_m, near_m "
                "or shift");
        }
        choice = parse_camera_choice(*text);
    } else if (has_numbers) {
        choice.kind = CameraKind::placed;
        if (!matrix.is_none()) {
            if (!eye.is_none() || !target.is_none() || !up.is_none()) {
                throw py::value_error("matrix: is not valid together with eye, target or up");
            }
            choice.placed = camera_of_matrix(matrix);
        } else {
            if (eye.is_none()) {
                throw py::value_error("eye: is missing; give eye and target, or a matrix");
            }
            choice.placed.eye = three_numbers(eye, "eye");
            choice.placed.target = target.is_none() ? glm::dvec3(0.0) : three_numbers(target, "target");
            choice.placed.up = up.is_none() ? glm::dvec3(0.0, 1.0, 0.0) : three_numbers(up, "up");
        }
        check_direction(choice.placed);
        if (fov_deg) {
            choice.placed.vertical_fov_rad = glm::radians(number_within(*fov_deg, "fov_deg", 1.0, 170.0));
        }
        if (half_height_m) {
            choice.placed.orthographic_half_height_m =
                number_within(*half_height_m, "half_height_m", 1e-9, largest_view_m);
        }
        if (matrix.is_none()) { // as parse_camera() places the near plane
            choice.placed.near_m =
                std::max(1e-6, 1e-3 * glm::length(choice.placed.target - choice.placed.eye));
        }
        if (near_m) {
            choice.placed.near_m = number_within(*near_m, "near_m", 1e-9, largest_view_m);
        }
    }
    choice.parallel = ortho;
    if (!shift.is_none()) {
        const Dense<double> numbers = finite_doubles(shift, "shift", {2});
        constexpr double most_shift = 100.0;
        choice.placed.shift = {number_within(numbers.at(0), "shift", -most_shift, most_shift),
                               number_within(numbers.at(1), "shift", -most_shift, most_shift)};
    }
    return choice;
}

py::object numbers_or_none(const CameraChoice& choice, const glm::dvec3& vector)
{
    if (choice.kind != CameraKind::placed) {
        return py::none();
    }
    py::array_t<double> numbers(3);
    for (int i = 0; i < 3; ++i) {
        numbers.mutable_at(i) = vector[i];
    }
    return numbers;
}

std::string text_of(const CameraChoice& choice)
{
    const Camera& camera = choice.placed;
    switch (choice.kind) {
    case CameraKind::framed:
        return "auto";
    case CameraKind::named:
        return choice.name;
    case CameraKind::directed:
        return fmt::format("azimuth={:g} elevation={:g}", choice.direction.azimuth_deg,
                           choice.direction.elevation_deg);
    case CameraKind::placed:
        return fmt::format("eye={:g},{:g},{:g} target={:g},{:g},{:g}{}{}", camera.eye.x, camera.eye.y,
                           camera.eye.z, camera.target.x, camera.target.y, camera.target.z,
                           camera.orthographic_half_height_m
                               ? fmt::format(" ortho={:g}", *camera.orthographic_half_height_m)
                               : fmt::format(" fov={:g}", glm::degrees(camera.vertical_fov_rad)),
                           camera.shift == decltype(camera.shift)(0.0)
                               ? std::string()
                               : fmt::format(" shift={:g},{:g}", camera.shift.x, camera.shift.y));
    default:
        return "the first camera of the scene, or auto";
    }
}

/// Places a camera without the GIL. The caller passes copies, because other threads may change what they were
/// copied from meanwhile.
CameraChoice placed_on(const CameraChoice& choice, const std::shared_ptr<const LitScene>& lit,
                       const Style& style, CameraPage page, const AnimationChoice& animation)
{
    const Unlocked unlocked;
    page.animation = find_animation(animation, lit->scene);
    return {.kind = CameraKind::placed, .placed = resolve_camera(choice, lit->scene, style, page)};
}

CameraChoice placed_in(const CameraChoice& choice_now, const py::object& scene, const py::object& style_now,
                       const py::object& width, const py::object& height, double time_s,
                       const py::object& animation)
{
    constexpr double most_px = 65535.0;
    const auto side_of = [](const py::object& length_px, const char* argument) {
        const auto number = static_cast<double>(integer_of(length_px, argument));
        return static_cast<uint32_t>(number_within(number, argument, 1.0, most_px));
    };
    const CameraPage page{.width = side_of(width, "width"),
                          .height = side_of(height, "height"),
                          .time_s = number_within(time_s, "time_s", -1e9, 1e9)};
    return placed_on(CameraChoice(choice_now), scene_argument(scene).snapshot(), style_of(style_now), page,
                     animation_choice_of(animation));
}

constexpr const char* camera_doc = R"(Viewpoint and projection of a picture.

Camera()                                       the first camera of the scene, or else "auto"
Camera("auto")                                 frames the whole scene in a three-quarter view
Camera("front"), Camera("isometric"), ...      frames the whole scene from a side, see Camera.views
Camera("azimuth=30 elevation=20")              frames the whole scene from a direction
Camera("eye=2,1,3 target=0,0.5,0 fov=40")      stands at a point
Camera("Camera.001")                           a camera of the scene, by name or number
Camera(eye=(2, 1, 3), target=(0, 0.5, 0))      stands at a point, of numbers
Camera(matrix=world_from_camera)               (4, 4): looks along -z of the matrix, with y up

fov_deg is the vertical angle of view, 1 to 170 degrees. half_height_m is half the height of a parallel projection in
metres. near_m is the distance of the near plane. ortho makes any camera one of parallel projection. shift is the lens
shift: two numbers, how far the middle of the picture lies to the right of and above the axis of view, in shares of the
picture's width and height; it needs a camera of numbers, or stands in the text as shift=right,up. A text that is not
valid raises Error; whether the scene has a named camera is only known when a picture is drawn.)";

} // namespace

void bind_camera(py::module_& module)
{
    py::class_<CameraChoice> camera(module, "Camera", camera_doc);
    camera
        .def(py::init(&make_camera), py::arg("text") = py::none(), py::kw_only(), py::arg("eye") = py::none(),
             py::arg("target") = py::none(), py::arg("up") = py::none(), py::arg("matrix") = py::none(),
             py::arg("fov_deg") = py::none(), py::arg("half_height_m") = py::none(),
             py::arg("near_m") = py::none(), py::arg("ortho") = false, py::arg("shift") = py::none(),
             "Make a camera of a text or of numbers; see the class.")
        .def_property_readonly(
            "eye", [](const CameraChoice& choice) { return numbers_or_none(choice, choice.placed.eye); },
            "Place of the camera in metres, (3,) float64; None if it depends on the scene.")
        .def_property_readonly(
            "target",
            [](const CameraChoice& choice) { return numbers_or_none(choice, choice.placed.target); },
            "Point that the camera looks at in metres, (3,) float64; None if it depends on the scene.\n\n"
            "The point is in the middle of the picture if the camera has no lens shift.")
        .def_property_readonly(
            "up", [](const CameraChoice& choice) { return numbers_or_none(choice, choice.placed.up); },
            "Direction that points up in the picture, (3,) float64; None if it depends on the scene.")
        .def_property_readonly(
            "fov_deg",
            [](const CameraChoice& choice) -> std::optional<double> {
                return choice.kind == CameraKind::placed
                           ? std::optional(glm::degrees(choice.placed.vertical_fov_rad))
                           : std::nullopt;
            },
            "Vertical angle of view in degrees; None if it depends on the scene.")
        .def_property_readonly(
            "half_height_m",
            [](const CameraChoice& choice) -> std::optional<double> {
                return choice.kind == CameraKind::placed ? choice.placed.orthographic_half_height_m
                                                         : std::nullopt;
            },
            "Half the height of a parallel projection in metres; None for perspective projection.")
        .def_property_readonly(
            "near_m",
            [](const CameraChoice& choice) -> std::optional<double> {
                return choice.kind == CameraKind::placed ? std::optional(choice.placed.near_m) : std::nullopt;
            },
            "Distance of the near plane in metres; None if it depends on the scene.")
        .def_property_readonly(
            "shift",
            [](const CameraChoice& choice) -> std::optional<std::pair<double, double>> {
                return choice.kind == CameraKind::placed
                           ? std::optional(std::pair(choice.placed.shift.x, choice.placed.shift.y))
                           : std::nullopt;
            },
            "Lens shift, to the right and up, in shares of the picture; None if it depends on the scene.")
        .def("placed", &placed_in, py::arg("scene"), py::arg("style") = py::none(), py::kw_only(),
             py::arg("width") = 1280, py::arg("height") = 720, py::arg("time_s") = 0.0,
             py::arg("animation") = 0,
             "Return the camera as numbers, as it sees a scene on a page of this size at this time.\n\n"
             "`style` is a Style, the name of a style, or None for the default style; its margin matters.\n"
             "Raises Error if the scene has no such camera. Cost: linear in vertices and triangles.")
        .def("__repr__",
             [](const CameraChoice& choice) { return fmt::format("<estampe.Camera {}>", text_of(choice)); });
    std::vector<std::string> views;
    for (const char* const name : view_names()) {
        views.emplace_back(name);
    }
    camera.attr("views") = py::tuple(py::cast(views));
}

} // namespace estampe::python
