// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <span>

#include "gpu/resources.hpp"

namespace estampe::frame {

/// A buffer of these items that the device reads; of one that is not set where there are none.
template <class T>
[[nodiscard]] gpu::Buffer mapped_buffer(gpu::Device& device, const char* name, std::span<const T> items)
{
    gpu::Buffer buffer(device, name, std::max<size_t>(items.size(), 1) * sizeof(T), gpu::MemoryUse::upload);
    std::ranges::copy(std::as_bytes(items), buffer.mapped().begin());
    return buffer;
}

} // namespace estampe::frame
