// SPDX-License-Identifier: MIT
#include <span>
#include <string>

#include "commands.hpp"
#include "core/file.hpp"
#include "drawing.hpp"
#include "warnings.hpp"

namespace estampe::app {

void run(const GraphCommand& command)
{
    const DrawOptions& draw = command.draw;
    check_output(draw.output, {draw.scene, draw.lightmap});
    const Scene scene = load_scene_of(draw);
    print_warnings(scene.warnings);
    const Index animation = choose_animation(draw, scene);
    const Camera camera = choose_camera(draw, scene, animation);
    Renderer renderer(draw.device);
    set_scene(renderer, scene, draw);
    static_cast<void>(renderer.render(camera, draw.style, settings_of(draw, animation)));
    const std::string dot = renderer.graph_dot();
    write_file_atomically(draw.output, std::as_bytes(std::span(dot)));
}

} // namespace estampe::app
