// SPDX-License-Identifier: MIT
#include "empty_view.hpp"

#include <fmt/format.h>

#include "drawing.hpp"
#include "scene/in_view.hpp"
#include "text.hpp"

namespace estampe::app {
namespace {

std::string name_of_camera(const DrawOptions& draw, const Scene& scene)
{
    if (draw.camera.kind == CameraChoice::Kind::named)
        return fmt::format("camera {}", in_quotes(draw.camera.name));
    if (draw.camera.kind == CameraChoice::Kind::placed)
        return "the camera given by --camera";
    Index first = no_index;
    for (const Node& node : scene.nodes)
        first = std::min(first, node.camera);
    const std::string& name = scene.cameras[first].name;
    return fmt::format("camera {} of the file", name.empty() ? std::to_string(first) : in_quotes(name));
}

} // namespace

void warn_of_empty_view(const DrawOptions& draw, const Scene& scene, Index animation, const Camera& camera)
{
    const Moment moment{camera, draw.time_s};
    warn_of_empty_film(draw, scene, animation, {&moment, 1});
}

void warn_of_empty_film(const DrawOptions& draw, const Scene& scene, Index animation,
                        std::span<const Moment> moments)
{
    if (draw.camera.kind != CameraChoice::Kind::placed && !has_camera_of_file(draw, scene))
        return;
    const double aspect = draw.style.window_aspect(draw.page.width, draw.page.height);
    for (const Moment& moment : moments)
        if (may_see_anything(scene, pose_scene(scene, moment.time_s, animation), moment.camera, aspect))
            return;
    print_warnings({fmt::format("{}: {} sees nothing of the scene; --camera auto frames all of it",
                                draw.scene, name_of_camera(draw, scene))});
}

} // namespace estampe::app
