// SPDX-License-Identifier: MIT
#include "scene_options.hpp"

#include <CLI/CLI.hpp>

#include "option_values.hpp"

namespace estampe::app {

void SceneOptions::add_to(CLI::App& command)
{
    command
        .add_option("--up", up_,
                    "Axis of the file that points up: x, y, z, -x, -y or -z; the scene is\n"
                    "turned so that it becomes y [what the file says, else y]")
        ->type_name("AXIS");
    command
        .add_option("--input-format", format_,
                    "Format of a scene that comes through a pipe: glb, gltf, obj, ply, stl,\n"
                    "fbx or dae [recognised by its content where that can be]")
        ->type_name("NAME");
}

std::optional<UpAxis> SceneOptions::up() const
{
    return up_.empty() ? std::nullopt : std::optional(parse_up_axis(up_));
}

std::string SceneOptions::format() const
{
    check_input_format(format_);
    return format_;
}

} // namespace estampe::app
