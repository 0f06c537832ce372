// SPDX-License-Identifier: MIT
#pragma once

// Pipelines that a driver has compiled, kept on disk from one run to the next.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "gpu/vulkan.hpp"

namespace estampe::gpu {

class Device;

/// Whether devices opened from now on keep pipelines on disk, and use those that are there: they do, until
/// this says otherwise. Any thread may call it.
void keep_pipelines(bool are_kept);

/// What pipelines are kept for: another device, driver or version of the program has a file of its own.
struct PipelineOwner {
    uint32_t vendor = 0;
    uint32_t device = 0;
    uint32_t driver_version = 0;
    uint8_t uuid[VK_UUID_SIZE]{}; ///< of the driver's compiler
};

[[nodiscard]] PipelineOwner owner_of(VkPhysicalDevice physical);

/// Where they are kept: in `estampe` under $XDG_CACHE_HOME, or ~/.cache. Empty where neither is a place.
[[nodiscard]] std::filesystem::path pipeline_file(const PipelineOwner& owner);

/// What the file holds; empty when there is none, or it is cut off, changed, or of another owner.
[[nodiscard]] std::vector<std::byte> read_pipelines(const std::filesystem::path& file,
                                                    const PipelineOwner& owner);

/// Makes the folder and writes the file whole, or leaves the one before: no error, it is a cache.
void write_pipelines(const std::filesystem::path& file, std::span<const std::byte> pipelines);

/// Vulkan's cache of a device's pipelines, read from disk when it is made and written back at its end where
/// it has grown. Drivers that keep nothing in it, as lavapipe's, have no file.
class PipelineStore {
public:
    explicit PipelineStore(Device& device);
    ~PipelineStore();
    PipelineStore(const PipelineStore&) = delete;
    PipelineStore& operator=(const PipelineStore&) = delete;

    [[nodiscard]] VkPipelineCache handle() const { return cache_; }

private:
    void write_back() const;

    VkDevice device_;
    VkPipelineCache cache_ = VK_NULL_HANDLE;
    std::filesystem::path file_; ///< empty: not kept
    size_t size_read_ = 0;
};

} // namespace estampe::gpu
