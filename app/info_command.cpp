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
    const Scene scene = load_scene_of({.scene = command.scene});
    print_warnings(scene.warnings);
    fmt::print("{}", report_scene(scene, command.scene, command.json));
}

} // namespace estampe::app
