// SPDX-License-Identifier: MIT
#include "scene/input/finish.hpp"

#include "scene/mending/mend_scene.hpp"
#include "scene/mending/turn_outside.hpp"

namespace estampe {

void finish_import(Scene& scene, const std::string& where)
{
    mend_meshes(scene, where);
    make_sound(scene, where);
    make_needed_tangents(scene);
}

} // namespace estampe
