// SPDX-License-Identifier: MIT
#include "scene/reader/crossing.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include <estampe/error.hpp>

#include "scene/faults.hpp"

namespace estampe {
namespace {

void make_printable(std::vector<std::string>& texts)
{
    for (std::string& text : texts)
        std::ranges::replace_if(
            text, [](char letter) { return static_cast<unsigned char>(letter) < 0x20 || letter == 0x7f; },
            ' ');
}

} // namespace

void check_received_scene(Scene& scene, const std::string& where)
{
    if (!structural_faults(scene).empty())
        throw Error("what was read from it came back damaged", where);
    make_printable(scene.warnings);
}

} // namespace estampe
