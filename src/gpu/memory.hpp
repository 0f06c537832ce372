// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "gpu/vulkan.hpp"

namespace estampe::gpu {

enum class MemoryUse : uint8_t {
    device,   ///< Only the GPU accesses the memory
    upload,   ///< The CPU writes the memory, the GPU reads it; mapped
    readback, ///< The GPU writes the memory, the CPU reads it; mapped, and cached if supported
};

/// A range of device memory. `mapped` is null for MemoryUse::device.
struct Allocation {
    VkDeviceMemory memory = VK_NULL_HANDLE;
    VkDeviceSize offset = 0;
    VkDeviceSize size = 0;
    void* mapped = nullptr;
    uint32_t block = UINT32_MAX;
};

/// Allocates device memory from blocks of 64 MiB, with the first-fit strategy. Each allocation of 16 MiB or
/// more gets its own device memory.
///
/// Images and buffers use separate blocks, so bufferImageGranularity does not apply. Not thread-safe.
class MemoryAllocator {
public:
    MemoryAllocator(VkPhysicalDevice physical, VkDevice device);
    ~MemoryAllocator();
    MemoryAllocator(const MemoryAllocator&) = delete;
    MemoryAllocator& operator=(const MemoryAllocator&) = delete;

    /// Allocates memory. Throws Error if the device has too little free memory of the kind that `use` needs.
    [[nodiscard]] Allocation allocate(const VkMemoryRequirements& needs, MemoryUse use, bool for_image);
    /// Frees the memory of an allocation. Does not allocate, because objects are also destroyed after memory
    /// has run out.
    void free(const Allocation& allocation) noexcept;

    /// Throws Error unless `bytes` of MemoryUse::device can still be allocated. Call this before large
    /// allocations, because CPU drivers report more memory than the machine has.
    void require(VkDeviceSize bytes) const;
    [[nodiscard]] bool has(VkDeviceSize bytes) const;

    /// Number of bytes that are allocated now.
    [[nodiscard]] VkDeviceSize used_bytes() const;

    /// Total size of the device's own memory, both used and free.
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
        uint32_t allocations = 0;       ///< Number of allocations in the block
        std::vector<Range> free_ranges; ///< Unused ranges of the block, sorted by offset; no two are adjacent
    };

    [[nodiscard]] uint32_t pick_type(uint32_t allowed_types, MemoryUse use) const;
    [[nodiscard]] VkDeviceSize left_of_type(uint32_t memory_type) const;
    void require_of_type(VkDeviceSize bytes, uint32_t memory_type) const;
    [[nodiscard]] uint32_t new_block(VkDeviceSize size, uint32_t memory_type, bool mapped, bool for_images);
    [[nodiscard]] bool take(Block& block, const VkMemoryRequirements& needs, VkDeviceSize& offset) const;

    VkDevice device_;
    /// Memory types and heaps of the device. For CPU devices, the heap sizes are set to the machine's free
    /// memory.
    VkPhysicalDeviceMemoryProperties properties_{};
    std::vector<Block> blocks_;
};

} // namespace estampe::gpu
