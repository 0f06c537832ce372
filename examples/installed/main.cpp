// SPDX-License-Identifier: MIT
// Draws a file to an image in five lines: installed SCENE PICTURE.png

#include <estampe/renderer.hpp>

int main(int /*argc*/, char** argv)
{
    const estampe::Scene scene = estampe::load_scene(argv[1]);
    estampe::Renderer renderer;
    renderer.set_scene(scene);
    const auto camera = estampe::framing_camera(scene, estampe::pose_scene(scene, 0.0), 16.0 / 9.0);
    estampe::save_png(renderer.render(camera, estampe::Style::load("pencil"), {.width = 320, .height = 180}),
                      argv[2]);
}
