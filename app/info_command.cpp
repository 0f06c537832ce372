// SPDX-License-Identifier: MIT
#include <cstdio>

#include <fmt/format.h>

#include "commands.hpp"
#include "drawing.hpp"
#include "report.hpp"
#include "warnings.hpp"
#include "world_options.hpp"
#include "world_report.hpp"

namespace estampe::app {

void run(const InfoCommand& command)
{
    if (command.scene.empty()) {
        fmt::print("{}", report_worlds(command.json));
        return;
    }
    DrawOptions draw;
    draw.scene = command.scene;
    draw.input_format = command.input_format;
    draw.load.up = command.up;
    draw.world = command.world;
    const Scene scene = load_scene_of(draw);
    print_warnings(scene.warnings);
    fmt::print("{}", report_scene(scene, command.scene, command.json, world_of(command.scene)));
}

} // namespace estampe::app
