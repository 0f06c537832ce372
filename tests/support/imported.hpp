// SPDX-License-Identifier: MIT
#pragma once

// Functions for tests of importers, which inspect the imported scene.

#include <string>

#include <estampe/scene.hpp>

namespace estampe::test {

/// All warnings of the scene, one per line.
inline std::string all_warnings(const Scene& scene)
{
    std::string all;
    for (const std::string& warning : scene.warnings)
        all += warning + '\n';
    return all;
}

inline const Primitive& first_primitive(const Scene& scene)
{
    return scene.meshes.at(0).primitives.at(0);
}

} // namespace estampe::test
