// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <ranges>
#include <span>

#include "gpu/resources.hpp"

namespace estampe::gpu {

/// A host-visible buffer that holds `items`. Without items it has room for one, which is not set.
template <std::ranges::contiguous_range Items>
[[nodiscard]] Buffer mapped_buffer(Device& device, const char* name, const Items& items)
{
    const auto bytes = std::as_bytes(std::span(std::ranges::data(items), std::ranges::size(items)));
    const size_t least_bytes = sizeof(std::ranges::range_value_t<Items>);
    Buffer buffer(device, name, std::max(bytes.size(), least_bytes), MemoryUse::upload);
    std::ranges::copy(bytes, buffer.mapped().begin());
    return buffer;
}

/// Copies `items` into `buffer`, which no running frame may read. Allocates a new buffer only if the size
/// differs.
template <std::ranges::contiguous_range Items>
void upload_items(Device& device, const char* name, const Items& items, Buffer& buffer)
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
