// SPDX-License-Identifier: MIT
#include "scene/input/finish.hpp"

#include "scene/mending/mend.hpp"
#include "scene/mending/mend_scene.hpp"

namespace estampe {

void finish_import(Scene& scene, const std::string& where)
{
    mend_meshes(scene, where);
    check_structure(scene, where);
    make_needed_tangents(scene);
}

} // namespace estampe
