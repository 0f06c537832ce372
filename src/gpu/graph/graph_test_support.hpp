// SPDX-License-Identifier: MIT
#pragma once

// Helpers for the frame graph tests. They make fake imported resources that are never accessed, print
// readable test failures, and return the message of a thrown error.

#include <array>
#include <cstddef>
#include <ostream>
#include <stdexcept>
#include <string>
#include <vector>

#include "gpu/graph/compile.hpp"

namespace estampe::gpu {

inline constexpr size_t fake_count = 16;

/// Returns a reference that is not an image. Building and compiling a graph never access the image, so any
/// address is valid. Each number has its own address.
inline Image& fake_image(size_t number = 0)
{
    static std::array<std::max_align_t, fake_count> storage;
    return reinterpret_cast<Image&>(storage.at(number));
}

inline Buffer& fake_buffer(size_t number = 0)
{
    static std::array<std::max_align_t, fake_count> storage;
    return reinterpret_cast<Buffer&>(storage.at(number));
}

inline constexpr Shader fake_shader{"fake.comp", {}};
inline constexpr BufferDesc small_buffer{.size_bytes = 64};
inline constexpr ImageDesc small_image{.width = 32, .height = 16};

using Barriers = std::vector<Barrier>;
using Names = std::vector<std::string>;

inline std::ostream& operator<<(std::ostream& out, AccessSet set)
{
    out << '{';
    set.for_each([&](Access access) { out << ' ' << name_of(access); });
    return out << " }";
}

inline std::ostream& operator<<(std::ostream& out, const Barrier& barrier)
{
    return out << "resource " << barrier.resource << ": " << barrier.before << " -> " << barrier.after
               << ", layout " << static_cast<int>(barrier.old_layout) << " -> "
               << static_cast<int>(barrier.new_layout);
}

/// Returns the barriers before the pass named `name`, which must not be culled.
inline std::vector<Barrier> barriers_of(const Graph& graph, const CompiledGraph& compiled,
                                        const std::string& name)
{
    for (const CompiledPass& pass : compiled.passes) {
        if (graph.passes()[pass.pass].name == name)
            return pass.barriers;
    }
    throw std::runtime_error("no kept pass " + name);
}

inline std::vector<std::string> kept_names(const Graph& graph, const CompiledGraph& compiled)
{
    std::vector<std::string> names;
    for (const CompiledPass& pass : compiled.passes)
        names.push_back(graph.passes()[pass.pass].name);
    return names;
}

template <class Action>
std::string logic_error_of(Action&& action)
{
    try {
        action();
    } catch (const std::logic_error& error) {
        return error.what();
    }
    return "(nothing was thrown)";
}

} // namespace estampe::gpu
