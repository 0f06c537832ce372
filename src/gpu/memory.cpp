// SPDX-License-Identifier: MIT
#include "gpu/memory.hpp"

#include <algorithm>

#include <fmt/format.h>

#include <estampe/error.hpp>

#include "core/free_memory.hpp"

namespace estampe::gpu {
namespace {

constexpr VkDeviceSize block_bytes = 64ULL << 20;
constexpr VkDeviceSize dedicated_bytes = 16ULL << 20;

} // namespace

MemoryAllocator::MemoryAllocator(VkPhysicalDevice physical, VkDevice device) : device_(device)
{
    vkGetPhysicalDeviceMemoryProperties(physical, &properties_);
    VkPhysicalDeviceProperties device_properties{};
    vkGetPhysicalDeviceProperties(physical, &device_properties);
    if (device_properties.deviceType == VK_PHYSICAL_DEVICE_TYPE_CPU) {
        for (uint32_t heap = 0; heap < properties_.memoryHeapCount; ++heap) {
            properties_.memoryHeaps[heap].size = free_memory_bytes();
        }
    }
}

MemoryAllocator::~MemoryAllocator()
{
    for (const Block& block : blocks_) {
        vkFreeMemory(device_, block.memory, nullptr);
    }
}

uint32_t MemoryAllocator::pick_type(uint32_t allowed_types, MemoryUse use) const
{
    const auto find = [&](VkMemoryPropertyFlags wanted) {
        for (uint32_t type = 0; type < properties_.memoryTypeCount; ++type) {
            if ((allowed_types >> type & 1U) != 0 &&
                (properties_.memoryTypes[type].propertyFlags & wanted) == wanted) {
                return type;
            }
        }
        return UINT32_MAX;
    };
    constexpr VkMemoryPropertyFlags visible =
        VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
    uint32_t type = UINT32_MAX;
    if (use == MemoryUse::device) {
        type = find(VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT);
    } else if (use == MemoryUse::readback) {
        type = find(visible | VK_MEMORY_PROPERTY_HOST_CACHED_BIT);
    }
    if (type == UINT32_MAX) {
        type = find(use == MemoryUse::device ? 0 : visible);
    }
    if (type == UINT32_MAX) {
        throw Error("the graphics device offers no fitting kind of memory");
    }
    return type;
}

VkDeviceSize MemoryAllocator::left_of_type(uint32_t memory_type) const
{
    const uint32_t heap = properties_.memoryTypes[memory_type].heapIndex;
    VkDeviceSize taken = 0;
    for (const Block& block : blocks_) {
        const bool is_there = properties_.memoryTypes[block.memory_type].heapIndex == heap;
        taken += block.memory != VK_NULL_HANDLE && is_there ? block.size : 0;
    }
    const VkDeviceSize whole = properties_.memoryHeaps[heap].size;
    return whole - std::min(taken, whole);
}

bool MemoryAllocator::has(VkDeviceSize bytes) const
{
    return bytes <= left_of_type(pick_type(UINT32_MAX, MemoryUse::device));
}

void MemoryAllocator::require_of_type(VkDeviceSize bytes, uint32_t memory_type) const
{
    const VkDeviceSize left = left_of_type(memory_type);
    if (bytes > left) {
        throw Error(
            fmt::format(
                "out of graphics memory: {} more are needed, {} of {} are free", in_bytes(bytes),
                in_bytes(left),
                in_bytes(properties_.memoryHeaps[properties_.memoryTypes[memory_type].heapIndex].size)),
            {}, "try a smaller --size, fewer smoke.cells, or a lighter scene");
    }
}

VkDeviceSize MemoryAllocator::used_bytes() const
{
    VkDeviceSize used = 0;
    for (const Block& block : blocks_) {
        used += block.memory != VK_NULL_HANDLE ? block.size : 0;
        for (const Range& range : block.free_ranges) {
            used -= range.size;
        }
    }
    return used;
}

VkDeviceSize MemoryAllocator::whole_bytes() const
{
    const uint32_t type = pick_type(UINT32_MAX, MemoryUse::device);
    return properties_.memoryHeaps[properties_.memoryTypes[type].heapIndex].size;
}

void MemoryAllocator::require(VkDeviceSize bytes) const
{
    require_of_type(bytes, pick_type(UINT32_MAX, MemoryUse::device));
}

uint32_t MemoryAllocator::new_block(VkDeviceSize size, uint32_t memory_type, bool mapped, bool for_images)
{
    require_of_type(size, memory_type);
    blocks_.reserve(blocks_.size() + 1); // Nothing may fail once the device's memory is allocated
    Block block{
        .size = size, .memory_type = memory_type, .for_images = for_images, .free_ranges = {{0, size}}};
    const VkMemoryAllocateInfo info{.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO,
                                    .allocationSize = size,
                                    .memoryTypeIndex = memory_type};
    vk_check(vkAllocateMemory(device_, &info, nullptr, &block.memory), "vkAllocateMemory");
    const VkResult result =
        mapped ? vkMapMemory(device_, block.memory, 0, VK_WHOLE_SIZE, 0, &block.mapped) : VK_SUCCESS;
    if (result != VK_SUCCESS) {
        vkFreeMemory(device_, block.memory, nullptr);
        vk_check(result, "vkMapMemory");
    }
    const auto vacant = std::find_if(blocks_.begin(), blocks_.end(),
                                     [](const Block& other) { return other.memory == VK_NULL_HANDLE; });
    if (vacant != blocks_.end()) {
        *vacant = std::move(block);
        return static_cast<uint32_t>(vacant - blocks_.begin());
    }
    blocks_.push_back(std::move(block));
    return static_cast<uint32_t>(blocks_.size() - 1);
}

bool MemoryAllocator::take(Block& block, const VkMemoryRequirements& needs, VkDeviceSize& offset) const
{
    for (auto range = block.free_ranges.begin(); range != block.free_ranges.end(); ++range) {
        const VkDeviceSize aligned =
            (range->offset + needs.alignment - 1) / needs.alignment * needs.alignment;
        const VkDeviceSize end = range->offset + range->size;
        if (aligned + needs.size > end) {
            continue;
        }
        // Between n allocations lie at most n + 1 free ranges, and free() adds one before it joins them.
        const size_t most_ranges = size_t{block.allocations} + 3;
        if (block.free_ranges.capacity() < most_ranges) {
            const auto at = range - block.free_ranges.begin();
            block.free_ranges.reserve(2 * most_ranges);
            range = block.free_ranges.begin() + at;
        }
        ++block.allocations;
        const Range before{range->offset, aligned - range->offset};
        const Range after{aligned + needs.size, end - aligned - needs.size};
        auto place = block.free_ranges.erase(range);
        if (after.size > 0) {
            place = block.free_ranges.insert(place, after);
        }
        if (before.size > 0) {
            block.free_ranges.insert(place, before);
        }
        offset = aligned;
        return true;
    }
    return false;
}

Allocation MemoryAllocator::allocate(const VkMemoryRequirements& needs, MemoryUse use, bool for_image)
{
    const uint32_t type = pick_type(needs.memoryTypeBits, use);
    const bool mapped = use != MemoryUse::device;
    VkDeviceSize offset = 0;
    uint32_t index = UINT32_MAX;
    if (needs.size < dedicated_bytes) {
        for (uint32_t i = 0; i < blocks_.size() && index == UINT32_MAX; ++i) {
            Block& block = blocks_[i];
            const bool fits = block.memory != VK_NULL_HANDLE && block.memory_type == type &&
                              block.for_images == for_image && (block.mapped != nullptr) == mapped;
            if (fits && take(block, needs, offset)) {
                index = i;
            }
        }
    }
    if (index == UINT32_MAX) {
        index = new_block(needs.size < dedicated_bytes ? block_bytes : needs.size, type, mapped, for_image);
        if (!take(blocks_[index], needs, offset)) {
            throw Error("a fresh block of graphics memory is too small");
        }
    }
    const Block& block = blocks_[index];
    return {.memory = block.memory,
            .offset = offset,
            .size = needs.size,
            .mapped = mapped ? static_cast<std::byte*>(block.mapped) + offset : nullptr,
            .block = index};
}

void MemoryAllocator::free(const Allocation& allocation) noexcept
{
    if (allocation.block == UINT32_MAX) {
        return;
    }
    Block& block = blocks_[allocation.block];
    --block.allocations;
    auto& ranges = block.free_ranges;
    auto place =
        std::lower_bound(ranges.begin(), ranges.end(), allocation.offset,
                         [](const Range& range, VkDeviceSize offset) { return range.offset < offset; });
    place = ranges.insert(place, {allocation.offset, allocation.size});
    if (const auto next = place + 1; next != ranges.end() && place->offset + place->size == next->offset) {
        place->size += next->size;
        ranges.erase(next);
    }
    if (place != ranges.begin()) {
        const auto previous = place - 1;
        if (previous->offset + previous->size == place->offset) {
            previous->size += place->size;
            ranges.erase(place);
        }
    }
    if (ranges.size() == 1 && ranges.front().size == block.size) {
        vkFreeMemory(device_, block.memory, nullptr);
        block = {};
    }
}

} // namespace estampe::gpu
