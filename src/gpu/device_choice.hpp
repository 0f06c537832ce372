// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include <estampe/renderer.hpp>

#include "gpu/vulkan.hpp"

namespace estampe::gpu {

/// A physical device and what we think of it.
struct Candidate {
    VkPhysicalDevice physical = VK_NULL_HANDLE;
    DeviceInfo info;
    bool discrete = false;
};

/// Loads Vulkan; throws Error with the package to install when there is no loader.
void load_vulkan();

/// All devices of `instance`, judged: usable, or why not.
[[nodiscard]] std::vector<Candidate> list_candidates(VkInstance instance);

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

/// Enables what drawing needs, and what raster in compute does.
void enable_features(VkPhysicalDeviceFeatures& core, VkPhysicalDeviceVulkan12Features& v12,
                     VkPhysicalDeviceVulkan13Features& v13, bool compute_raster);

/// Loads Vulkan as the host has it, and judges its physical device. Throws Error saying what that lacks.
[[nodiscard]] Candidate host_candidate(const VulkanHost& host);

/// Names of the features that drawing cannot do without and `have` lacks; empty when it lacks none.
[[nodiscard]] std::string missing_features(const Features& have);

/// Whether words of depth and triangle can be drawn in compute, by an atomic maximum.
[[nodiscard]] bool offers_compute_raster(const Features& have);

} // namespace estampe::gpu
