// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "gpu/vulkan.hpp"

namespace estampe::gpu {

enum class MemoryUse : uint8_t {
    device,   ///< only the GPU touches it
    upload,   ///< written by the processor, read by the GPU; mapped
    readback, ///< written by the GPU, read by the processor; mapped, cached where offered
};

/// A piece of device memory. `mapped` is null for MemoryUse::device.
struct Allocation {
    VkDeviceMemory memory = VK_NULL_HANDLE;
    VkDeviceSize offset = 0;
    VkDeviceSize size = 0;
    void* mapped = nullptr;
    uint32_t block = UINT32_MAX;
};

/// Hands out device memory from 64 MiB blocks, first fit; anything of 16 MiB or more gets memory of its own.
///
/// Images and buffers live in separate blocks, so bufferImageGranularity never matters. Not thread-safe.
class MemoryAllocator {
public:
    MemoryAllocator(VkPhysicalDevice physical, VkDevice device);
    ~MemoryAllocator();
    MemoryAllocator(const MemoryAllocator&) = delete;
    MemoryAllocator& operator=(const MemoryAllocator&) = delete;

    /// Throws Error when the device has no such memory left.
    [[nodiscard]] Allocation allocate(const VkMemoryRequirements& needs, MemoryUse use, bool for_image);
    void free(const Allocation& allocation);

    /// Throws Error unless as many bytes that only the device touches can still be allocated. To be asked
    /// before a lot is: drivers on the processor promise more than the machine has.
    void require(VkDeviceSize bytes) const;
    [[nodiscard]] bool has(VkDeviceSize bytes) const;

    /// All that was allocated and not freed.
    [[nodiscard]] VkDeviceSize used_bytes() const;

    /// All that the device has for itself, taken or not.
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
        std::vector<Range> free_ranges; ///< sorted by offset, never touching one another
    };

    [[nodiscard]] uint32_t pick_type(uint32_t allowed_types, MemoryUse use) const;
    [[nodiscard]] VkDeviceSize left_of_type(uint32_t memory_type) const;
    void require_of_type(VkDeviceSize bytes, uint32_t memory_type) const;
    [[nodiscard]] uint32_t new_block(VkDeviceSize size, uint32_t memory_type, bool mapped, bool for_images);
    [[nodiscard]] bool take(Block& block, const VkMemoryRequirements& needs, VkDeviceSize& offset) const;

    VkDevice device_;
    VkPhysicalDeviceMemoryProperties properties_{}; ///< heaps as large as the machine really has them
    std::vector<Block> blocks_;
};

} // namespace estampe::gpu
