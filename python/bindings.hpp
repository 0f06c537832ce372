// SPDX-License-Identifier: MIT
#pragma once

// The classes of the module, and the functions that add them to it. Each bind_*.cpp has one of these
// functions.

#include <atomic>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <variant>

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <estampe/image.hpp>
#include <estampe/lightmap.hpp>
#include <estampe/scene.hpp>
#include <estampe/style.hpp>
#include <estampe/views.hpp>
#include <estampe/work_limits.hpp>

namespace estampe::python {

namespace py = pybind11;

/// Releases Python's global lock (GIL) until this object is destroyed, as py::gil_scoped_release does. At the
/// end of the program Python ends each thread that asks for the GIL by unwinding its stack, which C++ answers
/// with std::terminate. So finish_threads() waits for the objects of all other threads, and these threads
/// sleep from then on instead of asking for the GIL.
class Unlocked {
public:
    Unlocked();
    ~Unlocked();
    Unlocked(const Unlocked&) = delete;
    Unlocked& operator=(const Unlocked&) = delete;

private:
    PyThreadState* state_ = nullptr;
};

/// Lets the threads that draw come to an end, see Unlocked. Called at the end of the program, with the GIL.
void finish_threads();

/// A scene together with its lightmap.
struct LitScene {
    Scene scene;
    std::optional<Lightmap> lightmap;
};

/// A scene as Python holds it. A renderer reads the scene without Python's global lock (GIL), so a scene that
/// others hold is never changed: edit() copies it first.
class SharedScene {
public:
    SharedScene() : lit_(std::make_shared<LitScene>()) {}

    explicit SharedScene(LitScene lit) : lit_(std::make_shared<LitScene>(std::move(lit))) {}

    [[nodiscard]] const Scene& scene() const { return lit_->scene; }

    /// Returns the scene for readers that keep it, or that read it without the GIL.
    [[nodiscard]] std::shared_ptr<const LitScene> snapshot() const { return lit_; }

    /// Returns the scene for a change, which no snapshot sees. Only called with the GIL.
    [[nodiscard]] LitScene& edit()
    {
        if (lit_.use_count() > 1) {
            lit_ = std::make_shared<LitScene>(*lit_);
        }
        // The last reader has released its share, perhaps in another thread: its reads come before the
        // change.
        std::atomic_thread_fence(std::memory_order_acquire);
        return *lit_;
    }

private:
    std::shared_ptr<LitScene> lit_;
};

/// Drawable part of a mesh, whose material is checked when the part becomes part of a scene.
struct Part {
    Primitive primitive;
};

/// What decides where a camera stands. Automatic: the first camera of the scene's file, or else framed.
enum class CameraKind { automatic, framed, named, directed, placed };

/// A camera as Python holds it; only a placed one is independent of the scene, the style and the page.
struct CameraChoice {
    CameraKind kind = CameraKind::automatic;
    std::string name;        ///< Only for CameraKind::named: a camera of the scene, or else a view
    ViewDirection direction; ///< Only for CameraKind::directed
    Camera placed;           ///< Only for CameraKind::placed
    bool parallel = false;   ///< Parallel projection, whatever the camera has
};

/// The page and the time that a camera is chosen for.
struct CameraPage {
    uint32_t width = 1280;
    uint32_t height = 720;
    double time_s = 0.0;
    Index animation = 0;
};

/// Reads a camera as the command line has it: "auto", "eye=... target=...", "azimuth=... elevation=...", or
/// the name of a camera or view.
[[nodiscard]] CameraChoice parse_camera_choice(const std::string& text);

/// Converts a Python argument to a camera: None, a text or a Camera. Throws TypeError for anything else.
[[nodiscard]] CameraChoice camera_of(const py::object& value, const char* argument);

/// Places a camera in a scene, exactly as `estampe render` does. Throws Error if the scene has no such
/// camera.
[[nodiscard]] Camera resolve_camera(const CameraChoice& choice, const Scene& scene, const Style& style,
                                    const CameraPage& page);

/// Number or name of an animation.
using AnimationChoice = std::variant<py::ssize_t, std::string>;

/// Converts a Python argument to the choice of an animation. Throws TypeError for anything but a text or an
/// integer.
[[nodiscard]] AnimationChoice animation_choice_of(const py::object& value);

/// Returns the chosen animation of a scene; needs no GIL. Throws ValueError that lists the names, and
/// IndexError.
[[nodiscard]] Index find_animation(const AnimationChoice& choice, const Scene& scene);

/// Converts a Python argument to a style: None (the default style), the name of a style or a Style. Throws
/// TypeError for anything else.
[[nodiscard]] Style style_of(const py::object& value);

/// Converts a Python argument to a scene. Throws TypeError for anything but a Scene.
[[nodiscard]] SharedScene& scene_argument(const py::object& value);

/// Converts limits; None is no limit. Throws ValueError for a limit that is not positive.
[[nodiscard]] WorkLimits limits_of(const std::optional<double>& max_memory_bytes,
                                   const std::optional<double>& max_seconds);

/// Converts a text or a path object of Python. Throws TypeError for anything else.
[[nodiscard]] std::filesystem::path path_of(const py::object& value, const char* argument);

/// Returns the ending of a file's name in lower case, such as ".svg"; empty if there is none.
[[nodiscard]] std::string lower_ending_of(const std::filesystem::path& file);

/// Converts a (h, w, 3) or (h, w, 4) uint8 array to an image. Throws TypeError and ValueError.
[[nodiscard]] Image image_of(const py::object& pixels, const char* argument);

/// Views a (height, width, 4) array as estampe.Picture, without a copy.
[[nodiscard]] py::object as_picture(const py::array& pixels, const py::object& paper = py::none());

void bind_errors(py::module_& module);
void bind_part(py::module_& module);
void bind_scene(py::module_& module);
void bind_style(py::module_& module);
void bind_camera(py::module_& module);
void bind_pictures(py::module_& module);
void bind_layers(py::module_& module);
void bind_strokes(py::module_& module);
void bind_renderer(py::module_& module);

} // namespace estampe::python
