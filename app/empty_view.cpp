// SPDX-License-Identifier: MIT
#include "empty_view.hpp"

#include <algorithm>
#include <optional>

#include <fmt/format.h>

#include "core/text.hpp"
#include "drawing.hpp"
#include "scene/in_view.hpp"
#include "warnings.hpp"

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

std::string name_of_node(const Scene& scene, Index node)
{
    const std::string& own = scene.nodes[node].name;
    const std::string& name = own.empty() ? scene.meshes[scene.nodes[node].mesh].name : own;
    return name.empty() ? fmt::format("node {}", node) : in_quotes(name);
}

/// What is wrong with a view in which nothing is drawn, and what to do.
std::string problem_with(const InView& view, const Scene& scene)
{
    if (view.content == ViewContent::nothing)
        return "sees nothing of the scene; --camera auto frames all of it";
    const std::string name = name_of_node(scene, view.backs_of);
    if (view.holds_eye)
        return fmt::format("stands inside {}, whose one-sided surface is drawn from outside alone, and sees "
                           "nothing else; move it out, or make the material double-sided",
                           name);
    return fmt::format("sees nothing but backs of one-sided surfaces, such as {}, which are not drawn; look "
                       "from their front, or make the material double-sided",
                       name);
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
    std::optional<InView> first;
    for (const Moment& moment : moments) {
        const InView view =
            find_in_view(scene, pose_scene(scene, moment.time_s, animation), moment.camera, aspect);
        if (view.content == ViewContent::something)
            return;
        first = first.value_or(view);
    }
    if (first)
        print_warnings(
            {fmt::format("{}: {} {}", draw.scene, name_of_camera(draw, scene), problem_with(*first, scene))});
}

} // namespace estampe::app
