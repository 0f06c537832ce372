// SPDX-License-Identifier: MIT
// Draws a scene into an image of this application's own Vulkan device, and saves the image: host_device SCENE
// PICTURE.png

#include <cstdio>
#include <exception>

#include <estampe/image.hpp>
#include <estampe/scene.hpp>
#include <estampe/style.hpp>

#include "host.hpp"

int main(int argc, char** argv)
{
    if (argc != 3) {
        std::fputs("usage: host_device SCENE PICTURE.png\n", stderr);
        return 2;
    }
    try {
        const Host host;
        const estampe::RenderSettings settings{.width = 320, .height = 180};
        const Texture texture(host, settings.width, settings.height);

        const estampe::Scene scene = estampe::load_scene(argv[1]);
        estampe::Renderer renderer(host.vulkan());
        renderer.set_scene(scene);
        const estampe::Style style = estampe::Style::load("comic");
        const estampe::Camera camera = estampe::framing_camera(
            scene, estampe::pose_scene(scene, settings.time_s),
            style.window_aspect(settings.width, settings.height), style.sun_bearing());
        const estampe::VulkanPicture picture{.image = texture.image(),
                                             .layout_after = VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL};
        for (int frame = 0; frame < 2; ++frame) {
            renderer.render_to(picture, camera, style, settings);
        }
        estampe::Image image{.width = settings.width, .height = settings.height};
        image.rgba = texture.read();
        estampe::save_png(image, argv[2]);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "host_device: %s\n", error.what());
        return 1;
    }
    return 0;
}
