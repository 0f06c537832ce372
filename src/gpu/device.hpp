// SPDX-License-Identifier: MIT
#pragma once

// Lists the physical Vulkan devices with the features that each device lacks, and opens one device.

#include <memory>
#include <string>
#include <vector>

#include <estampe/renderer.hpp>

#include "gpu/execution_profile.hpp"
#include "gpu/memory.hpp"
#include "gpu/vulkan.hpp"

namespace estampe::gpu {

/// One Vulkan device with one queue for compute, transfer and graphics commands.
///
/// Requires Vulkan 1.3 with scalar block layout. The constructors throw an Error that names the missing
/// features. Devices without 64-bit buffer atomics cannot rasterise in compute shaders
/// (DeviceInfo::compute_raster).
class Device {
public:
    explicit Device(const RendererOptions& options);
    explicit Device(const VulkanHost& host);
    ~Device();
    Device(const Device&) = delete;
    Device& operator=(const Device&) = delete;

    [[nodiscard]] VkDevice handle() const { return device_; }

    [[nodiscard]] VkPhysicalDevice physical() const { return physical_; }

    [[nodiscard]] VkQueue queue() const { return queue_; }

    [[nodiscard]] uint32_t queue_family() const { return queue_family_; }

    [[nodiscard]] const DeviceInfo& info() const { return info_; }

    [[nodiscard]] ExecutionProfile execution() const { return {.is_processor = info_.software}; }

    [[nodiscard]] const VkPhysicalDeviceLimits& limits() const { return limits_; }

    [[nodiscard]] double timestamp_period_ns() const { return limits_.timestampPeriod; }

    [[nodiscard]] MemoryAllocator& memory() { return *memory_; }

    [[nodiscard]] const MemoryAllocator& memory() const { return *memory_; }

    /// Whether the device belongs to the host application.
    [[nodiscard]] bool is_borrowed() const { return is_borrowed_; }

    /// Runs `commands` and waits until the GPU has finished. Throws Error if the device is lost.
    void submit_and_wait(VkCommandBuffer commands);

    /// Names an object for debuggers and validation messages; does nothing without the validation layer.
    void name(VkObjectType type, uint64_t object, const std::string& name) const;

private:
    void create_instance(bool validation);
    void pick_physical(const std::string& choice);
    void create_device();
    void create_fence();
    void take_physical(VkPhysicalDevice physical, const DeviceInfo& info);
    /// Destroys what the constructor has created so far.
    void destroy() noexcept;

    VkInstance instance_ = VK_NULL_HANDLE;
    VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
    VkPhysicalDevice physical_ = VK_NULL_HANDLE;
    VkDevice device_ = VK_NULL_HANDLE;
    VkQueue queue_ = VK_NULL_HANDLE;
    VkFence fence_ = VK_NULL_HANDLE;
    uint32_t queue_family_ = 0;
    bool is_borrowed_ = false;
    DeviceInfo info_;
    VkPhysicalDeviceLimits limits_{};
    /// Allocated on the heap, because Vulkan's debug messenger stores the address of this function.
    std::unique_ptr<std::function<void(const std::string&)>> on_validation_message_;
    std::unique_ptr<MemoryAllocator> memory_;
};

/// A physical device, its properties, and whether this program can use it.
struct Candidate {
    VkPhysicalDevice physical = VK_NULL_HANDLE;
    DeviceInfo info;
    bool discrete = false;
};

/// Selects a device by "auto" (discrete GPU, else another GPU, else CPU), "cpu" or an index. If no device
/// matches, throws an Error that lists the devices.
[[nodiscard]] const Candidate& choose(const std::vector<Candidate>& candidates, const std::string& choice);

/// The linked chain (pNext) of Vulkan feature structures, for querying or enabling features of a device.
struct Features {
    Features();
    Features(const Features&) = delete;
    Features& operator=(const Features&) = delete;

    VkPhysicalDeviceVulkan13Features v13{};
    VkPhysicalDeviceVulkan12Features v12{};
    VkPhysicalDeviceFeatures2 core{};
};

/// Returns the names of the required features that `have` lacks; empty if no feature is missing.
[[nodiscard]] std::string missing_features(const Features& have);

/// Whether the device supports 64-bit buffer atomics. Compute shaders then rasterise depth and triangle
/// number with an atomic maximum.
[[nodiscard]] bool offers_compute_raster(const Features& have);

} // namespace estampe::gpu
