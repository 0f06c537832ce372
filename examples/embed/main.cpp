// SPDX-License-Identifier: MIT
// Draws a scene and saves the picture, using only the public headers: embed SCENE PICTURE.png

#include <cstdio>

#include <estampe/error.hpp>
#include <estampe/image.hpp>
#include <estampe/renderer.hpp>
#include <estampe/scene.hpp>
#include <estampe/style.hpp>

int main(int argc, char** argv)
{
    if (argc != 3) {
        std::fputs("usage: embed SCENE PICTURE.png\n", stderr);
        return 2;
    }
    try {
        const estampe::Scene scene = estampe::load_scene(argv[1]);
        estampe::Renderer renderer;
        renderer.set_scene(scene);

        estampe::Style style = estampe::Style::load("pencil");
        style.set("paper.height_mm=150");
        const estampe::RenderSettings settings{.width = 320, .height = 180};
        const double aspect = static_cast<double>(settings.width) / settings.height;
        const estampe::Camera camera =
            estampe::framing_camera(scene, estampe::pose_scene(scene, settings.time_s), aspect);
        estampe::save_png(renderer.render(camera, style, settings), argv[2]);
    } catch (const estampe::Error& error) {
        std::fprintf(stderr, "embed: %s\n", error.what());
        return 1;
    }
    return 0;
}
