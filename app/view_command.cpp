// SPDX-License-Identifier: MIT
#include <cstdio>
#include <cstdlib>

#include "commands.hpp"
#include "piped_scene.hpp"
#include "viewer/viewer.hpp"

namespace estampe::app {

void run(const ViewCommand& command)
{
    if (command.warm_up) {
        viewer::warm_up(command);
        return;
    }
    bool is_reading = false;
    {
        viewer::Viewer viewer(command);
        viewer.run();
        is_reading = viewer.is_reading();
        if (is_reading) {
            // A large file that nobody waits for: threads end with the program.
            std::fflush(nullptr);
            remove_piped_scenes();
            std::_Exit(0);
        }
    }
}

} // namespace estampe::app
