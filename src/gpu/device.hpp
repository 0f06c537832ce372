// SPDX-License-Identifier: MIT
#pragma once

// Physical devices and what they lack, and the one that is opened.

#include <memory>
#include <string>
#include <vector>

#include <estampe/renderer.hpp>

#include "gpu/execution_profile.hpp"
#include "gpu/memory.hpp"
#include "gpu/vulkan.hpp"

namespace estampe::gpu {

/// One Vulkan device with one queue, which does everything: compute, copies, and raster where it is used.
///
/// Needs Vulkan 1.3 with scalar block layout; throws Error saying what a device lacks. Without 64-bit buffer
/// atomics it has no raster in compute (DeviceInfo::compute_raster).
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

    /// Whether it is a host application's.
    [[nodiscard]] bool is_borrowed() const { return is_borrowed_; }

    /// Runs `commands` and waits until the GPU is done. Throws Error when the device is lost.
    void submit_and_wait(VkCommandBuffer commands);

    /// Gives an object its name, for debuggers and validation messages; free without the validation layer.
    void name(VkObjectType type, uint64_t object, const std::string& name) const;

private:
    void create_instance(bool validation);
    void pick_physical(const std::string& choice);
    void create_device();
    void create_fence();
    void take_physical(VkPhysicalDevice physical, const DeviceInfo& info);

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
    std::unique_ptr<std::function<void(const std::string&)>>
        on_validation_message_; ///< stays put for the messenger
    std::unique_ptr<MemoryAllocator> memory_;
};

/// A physical device and what we think of it.
struct Candidate {
    VkPhysicalDevice physical = VK_NULL_HANDLE;
    DeviceInfo info;
    bool discrete = false;
};

/// Picks by "auto" (discrete GPU, other GPU, processor), "cpu" or an index. Throws Error listing what there
/// is.
[[nodiscard]] const Candidate& choose(const std::vector<Candidate>& candidates, const std::string& choice);

/// The feature chain we need, to be asked of a device or enabled on it.
struct Features {
    Features();
    Features(const Features&) = delete;
    Features& operator=(const Features&) = delete;

    VkPhysicalDeviceVulkan13Features v13{};
    VkPhysicalDeviceVulkan12Features v12{};
    VkPhysicalDeviceFeatures2 core{};
};

/// Names of the features that drawing cannot do without and `have` lacks; empty when it lacks none.
[[nodiscard]] std::string missing_features(const Features& have);

/// Whether words of depth and triangle can be drawn in compute, by an atomic maximum.
[[nodiscard]] bool offers_compute_raster(const Features& have);

} // namespace estampe::gpu
