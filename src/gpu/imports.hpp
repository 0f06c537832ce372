// SPDX-License-Identifier: MIT
#pragma once

// What a graph takes in from outside, whole.

#include <string_view>

#include "gpu/graph/graph.hpp"
#include "gpu/resources.hpp"

namespace estampe::gpu {

/// All of `buffer`, which must outlive the run of `graph`.
[[nodiscard]] inline BufferId import_whole(Graph& graph, std::string_view name, Buffer& buffer)
{
    return graph.import_buffer(name, buffer, {.size_bytes = buffer.size_bytes()});
}

/// All of `image`, in the layout that uploads leave it in; it must outlive the run of `graph`.
[[nodiscard]] inline ImageId import_uploaded(Graph& graph, std::string_view name, Image& image)
{
    return graph.import_image(name, image, image.desc(), Layout::shader_read);
}

} // namespace estampe::gpu
