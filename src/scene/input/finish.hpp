// SPDX-License-Identifier: MIT
#pragma once

#include <new>
#include <stdexcept>
#include <string>

#include <estampe/error.hpp>
#include <estampe/scene.hpp>

namespace estampe {

/// What every reader does in the end: mends the meshes, turns what is inside out, computes the tangents that
/// materials need. Throws Error with `where` as its place when there is nothing to draw.
void finish_import(Scene& scene, const std::string& where);

/// Calls `read`, and throws Error where it runs out of memory.
template <typename Read>
Scene within_memory(const std::string& where, Read read)
{
    try {
        return read();
    } catch (const std::bad_alloc&) {
        throw Error("does not fit into memory", where);
    } catch (const std::length_error&) {
        throw Error("does not fit into memory", where);
    }
}

} // namespace estampe
