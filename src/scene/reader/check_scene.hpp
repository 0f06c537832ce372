// SPDX-License-Identifier: MIT
#pragma once

// load_scene() decodes files in a child process (core/child/child.hpp), because the files come from
// strangers. The scene then crosses to this process as bytes: members.hpp lists what crosses, and
// check_received_scene() checks what arrived.

#include <string>

#include <estampe/scene.hpp>

namespace estampe {

/// Checks a scene that another process sent, so that code that draws the scene need not check it again: all
/// indices are in range, the lengths of arrays agree, nodes form a forest. Throws Error with `where` as its
/// place if the scene is damaged. Replaces control characters in texts that are printed. Cost: linear in
/// indices and nodes, about 1 ms for a million triangles.
void check_received_scene(Scene& scene, const std::string& where);

} // namespace estampe
