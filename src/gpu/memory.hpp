// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "gpu/vulkan.hpp"

namespace estampe::gpu {

enum class MemoryUse : uint8_t {
    device,   ///< Only the GPU accesses it
    upload,   ///< Written by the processor, read by the GPU; mapped
    readback, ///< Written by the GPU, read by the processor; mapped, and cached if the device supports that
};

/// A range of device memory. `mapped` is null for MemoryUse::device.
struct Allocation {
    VkDeviceMemory memory = VK_NULL_HANDLE;
    VkDeviceSize offset = 0;
    VkDeviceSize size = 0;
    void* mapped = nullptr;
    uint32_t block = UINT32_MAX;
};

/// Allocates device memory from 64 MiB blocks, first fit; allocations of 16 MiB or more get their own
/// memory.
///
/// Images and buffers use separate blocks, so bufferImageGranularity does not apply. Not thread-safe.
class MemoryAllocator {
public:
    MemoryAllocator(VkPhysicalDevice physical, VkDevice device);
    ~MemoryAllocator();
    MemoryAllocator(const MemoryAllocator&) = delete;
    MemoryAllocator& operator=(const MemoryAllocator&) = delete;

    /// Throws Error if the device has too little memory of this kind left.
    [[nodiscard]] Allocation allocate(const VkMemoryRequirements& needs, MemoryUse use, bool for_image);
    void free(const Allocation& allocation);

    /// Throws Error unless `bytes` of MemoryUse::device can still be allocated. Call this before large
    /// allocations: drivers on the processor promise more memory than the machine has.
    void require(VkDeviceSize bytes) const;
    [[nodiscard]] bool has(VkDeviceSize bytes) const;

    /// Bytes that are allocated at present.
    [[nodiscard]] VkDeviceSize used_bytes() const;

    /// Total size of the device's own memory, used or not.
    [[nodiscard]] VkDeviceSize whole_bytes() const;

private:
    struct Range {
        VkDeviceSize offset, size;
    };

    struct Block {
        VkDeviceMemory memory = VK_NULL_HANDLE;
        VkDeviceSize size = 0;
        void* mapped = nullptr;
        uint32_t memory_type = 0;
        bool for_images = false;
        std::vector<Range> free_ranges; ///< Sorted by offset; no two are adjacent
    };

    [[nodiscard]] uint32_t pick_type(uint32_t allowed_types, MemoryUse use) const;
    [[nodiscard]] VkDeviceSize left_of_type(uint32_t memory_type) const;
    void require_of_type(VkDeviceSize bytes, uint32_t memory_type) const;
    [[nodiscard]] uint32_t new_block(VkDeviceSize size, uint32_t memory_type, bool mapped, bool for_images);
    [[nodiscard]] bool take(Block& block, const VkMemoryRequirements& needs, VkDeviceSize& offset) const;

    VkDevice device_;
    /// On a processor, heap sizes are the free memory of the machine.
    VkPhysicalDeviceMemoryProperties properties_{};
    std::vector<Block> blocks_;
};

} // namespace estampe::gpu
