// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <ranges>
#include <span>

#include "gpu/resources.hpp"

namespace estampe::frame {

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

} // namespace estampe::frame
