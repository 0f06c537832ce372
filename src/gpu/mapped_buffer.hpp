// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <ranges>
#include <span>

#include "gpu/resources.hpp"

namespace estampe::gpu {

/// A buffer of these items that the device reads; of one that is not set where there are none.
template <std::ranges::contiguous_range Items>
[[nodiscard]] gpu::Buffer mapped_buffer(gpu::Device& device, const char* name, const Items& items)
{
    const auto bytes = std::as_bytes(std::span(std::ranges::data(items), std::ranges::size(items)));
    const size_t least_bytes = sizeof(std::ranges::range_value_t<Items>);
    gpu::Buffer buffer(device, name, std::max(bytes.size(), least_bytes), gpu::MemoryUse::upload);
    std::ranges::copy(bytes, buffer.mapped().begin());
    return buffer;
}

/// Puts such items into `buffer`, of a frame that is over: it is made anew only where their number is
/// another.
template <std::ranges::contiguous_range Items>
void upload_items(gpu::Device& device, const char* name, const Items& items, gpu::Buffer& buffer)
{
    const auto bytes = std::as_bytes(std::span(std::ranges::data(items), std::ranges::size(items)));
    const size_t least_bytes = sizeof(std::ranges::range_value_t<Items>);
    if (buffer.empty() || buffer.size_bytes() != std::max(bytes.size(), least_bytes)) {
        buffer = mapped_buffer(device, name, items);
        return;
    }
    std::ranges::copy(bytes, buffer.mapped().begin());
}

} // namespace estampe::gpu
