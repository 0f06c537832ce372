// SPDX-License-Identifier: MIT
// Draws cloth that a program made, using only the public headers: cloth SET-UP PICTURE.png [FRAMES]
// With FRAMES, writes that many pictures, 24 per second of scene time: PICTURE.png-0000.png and so on.

#include <cstdio>
#include <cstdlib>

#include <estampe/error.hpp>
#include <estampe/image.hpp>
#include <estampe/renderer.hpp>
#include <estampe/style.hpp>

#include "set_ups.hpp"

namespace {

void draw(const std::string& name, const std::string& path, uint32_t frames)
{
    const ClothScene set_up = make_set_up(name);
    estampe::Style style = estampe::Style::load("chirico");
    for (const std::string& assignment : set_up.style) {
        style.set(assignment);
    }
    estampe::Renderer renderer;
    renderer.set_scene(set_up.scene);
    estampe::RenderSettings settings{.width = 640, .height = 480};
    if (frames == 0) {
        estampe::save_png(renderer.render(set_up.camera, style, settings), path);
    }
    for (uint32_t i = 0; i < frames; ++i) {
        settings.time_s = i / 24.0;
        settings.continuity = i == 0 ? estampe::Continuity::starts : estampe::Continuity::follows;
        char number[16];
        std::snprintf(number, sizeof number, "-%04u.png", i);
        estampe::save_png(renderer.render(set_up.camera, style, settings), path + number);
    }
}

} // namespace

int main(int argc, char** argv)
{
    if (argc != 3 && argc != 4) {
        std::fputs("usage: cloth SET-UP PICTURE.png [FRAMES]; set-ups:", stderr);
        for (const std::string& name : set_up_names()) {
            std::fprintf(stderr, " %s", name.c_str());
        }
        std::fputs("\n", stderr);
        return 2;
    }
    try {
        draw(argv[1], argv[2], argc == 4 ? static_cast<uint32_t>(std::strtoul(argv[3], nullptr, 10)) : 0);
    } catch (const estampe::Error& error) {
        std::fprintf(stderr, "cloth: %s\n", error.what());
        return 1;
    }
    return 0;
}
