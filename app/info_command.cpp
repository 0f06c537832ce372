// SPDX-License-Identifier: MIT
#include <cstdio>

#include <fmt/format.h>

#include "commands.hpp"
#include "drawing.hpp"
#include "report.hpp"
#include "text.hpp"

namespace estampe::app {

void run(const InfoCommand& command)
{
    DrawOptions draw;
    draw.scene = command.scene;
    draw.input_format = command.input_format;
    draw.load.up = command.up;
    const Scene scene = load_scene_of(draw);
    print_warnings(scene.warnings);
    fmt::print("{}", report_scene(scene, command.scene, command.json));
}

} // namespace estampe::app
