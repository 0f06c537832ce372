// SPDX-License-Identifier: MIT
#include "gpu/device_choice.hpp"

#include <algorithm>
#include <charconv>

#include <fmt/format.h>

#include <estampe/error.hpp>
#include <estampe/vulkan.hpp>

namespace estampe::gpu {
namespace {

Candidate judge(VkPhysicalDevice physical, uint32_t index)
{
    VkPhysicalDeviceSubgroupProperties subgroups{.sType =
                                                     VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SUBGROUP_PROPERTIES};
    VkPhysicalDeviceDriverProperties driver{.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES,
                                            .pNext = &subgroups};
    VkPhysicalDeviceProperties2 properties{.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2,
                                           .pNext = &driver};
    vkGetPhysicalDeviceProperties2(physical, &properties);
    Candidate candidate{.physical = physical};
    candidate.discrete = properties.properties.deviceType == VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU;
    candidate.info = {.index = index,
                      .name = properties.properties.deviceName,
                      .driver = fmt::format("{} {}", driver.driverName, driver.driverInfo),
                      .software = properties.properties.deviceType == VK_PHYSICAL_DEVICE_TYPE_CPU};
    Features have;
    vkGetPhysicalDeviceFeatures2(physical, &have.core);
    candidate.info.compute_raster = offers_compute_raster(have);
    const uint32_t version = properties.properties.apiVersion;
    if (version < VK_API_VERSION_1_3) {
        candidate.info.why_not = fmt::format("offers Vulkan {}.{} only, 1.3 is needed",
                                             VK_API_VERSION_MAJOR(version), VK_API_VERSION_MINOR(version));
    } else if (const std::string missing = missing_features(have); !missing.empty()) {
        candidate.info.why_not = "lacks " + missing;
    } else if ((subgroups.supportedOperations & VK_SUBGROUP_FEATURE_VOTE_BIT) == 0) {
        candidate.info.why_not = "lacks votes of subgroups";
    } else if ((subgroups.supportedOperations & VK_SUBGROUP_FEATURE_ARITHMETIC_BIT) == 0) {
        candidate.info.why_not = "lacks sums over subgroups";
    }
    candidate.info.usable = candidate.info.why_not.empty();
    return candidate;
}

std::string describe(const std::vector<Candidate>& candidates)
{
    std::string text;
    for (const Candidate& candidate : candidates) {
        text += fmt::format("{}{}: {}{}", text.empty() ? "" : ", ", candidate.info.index, candidate.info.name,
                            candidate.info.usable ? "" : " (" + candidate.info.why_not + ")");
    }
    return text.empty() ? "there is none; install mesa-vulkan-drivers to draw on the processor"
                        : "there is " + text;
}

int preference(const Candidate& candidate)
{
    return candidate.discrete ? 0 : candidate.info.software ? 2 : 1;
}

} // namespace

Features::Features()
{
    v13.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES;
    v12.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES;
    v12.pNext = &v13;
    core.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2;
    core.pNext = &v12;
}

std::string missing_features(const Features& have)
{
    std::string missing;
    const auto need = [&](VkBool32 there, const char* name) {
        if (there == VK_FALSE) {
            missing += missing.empty() ? name : std::string(", ") + name;
        }
    };
    need(have.v13.synchronization2, "synchronization2");
    need(have.v13.dynamicRendering, "dynamic rendering");
    need(have.v13.maintenance4, "maintenance4");
    need(have.v12.scalarBlockLayout, "scalar block layout");
    need(have.v12.hostQueryReset, "host query reset");
    need(have.core.features.shaderStorageImageExtendedFormats, "extended storage image formats");
    need(have.core.features.shaderClipDistance, "clip distances");
    return missing;
}

bool offers_compute_raster(const Features& have)
{
    return have.v12.shaderBufferInt64Atomics == VK_TRUE && have.core.features.shaderInt64 == VK_TRUE;
}

void enable_features(VkPhysicalDeviceFeatures& core, VkPhysicalDeviceVulkan12Features& v12,
                     VkPhysicalDeviceVulkan13Features& v13, bool compute_raster)
{
    v13.synchronization2 = VK_TRUE;
    v13.dynamicRendering = VK_TRUE;
    v13.maintenance4 = VK_TRUE;
    v12.scalarBlockLayout = VK_TRUE;
    v12.shaderBufferInt64Atomics = compute_raster ? VK_TRUE : VK_FALSE;
    v12.hostQueryReset = VK_TRUE;
    core.shaderInt64 = compute_raster ? VK_TRUE : VK_FALSE;
    core.shaderStorageImageExtendedFormats = VK_TRUE;
    core.shaderClipDistance = VK_TRUE;
}

Candidate host_candidate(const VulkanHost& host)
{
    if (host.instance == VK_NULL_HANDLE || host.physical_device == VK_NULL_HANDLE) {
        throw Error("the host has no Vulkan instance or physical device", "VulkanHost");
    }
    if (host.get_instance_proc_addr != nullptr) {
        volkInitializeCustom(host.get_instance_proc_addr);
    } else {
        load_vulkan();
    }
    volkLoadInstance(host.instance);
    Candidate candidate = judge(host.physical_device, 0);
    if (!candidate.info.usable) {
        throw Error("the host's graphics device cannot be drawn on", candidate.info.name,
                    "it " + candidate.info.why_not);
    }
    return candidate;
}

void load_vulkan()
{
    if (volkInitialize() != VK_SUCCESS) {
        throw Error("no Vulkan loader on this machine", "", "install libvulkan1 and mesa-vulkan-drivers");
    }
}

std::vector<Candidate> list_candidates(VkInstance instance)
{
    uint32_t count = 0;
    vk_check(vkEnumeratePhysicalDevices(instance, &count, nullptr), "vkEnumeratePhysicalDevices");
    std::vector<VkPhysicalDevice> devices(count);
    vk_check(vkEnumeratePhysicalDevices(instance, &count, devices.data()), "vkEnumeratePhysicalDevices");
    std::vector<Candidate> candidates;
    for (uint32_t i = 0; i < count; ++i) {
        candidates.push_back(judge(devices[i], i));
    }
    return candidates;
}

const Candidate& choose(const std::vector<Candidate>& candidates, const std::string& choice)
{
    const Candidate* best = nullptr;
    if (choice == "auto" || choice == "cpu") {
        for (const Candidate& candidate : candidates) {
            const bool eligible = candidate.info.usable && (choice == "auto" || candidate.info.software);
            if (eligible && (best == nullptr || preference(candidate) < preference(*best))) {
                best = &candidate;
            }
        }
    } else {
        uint32_t index = 0;
        const auto [end, failure] = std::from_chars(choice.data(), choice.data() + choice.size(), index);
        const bool is_number = failure == std::errc{} && end == choice.data() + choice.size();
        if (!is_number) {
            throw Error(fmt::format("\"{}\" is no device", choice), "device",
                        "use auto, cpu or a number of 'estampe devices'");
        }
        const auto found =
            std::find_if(candidates.begin(), candidates.end(), [&](const Candidate& candidate) {
                return candidate.info.index == index && candidate.info.usable;
            });
        best = found == candidates.end() ? nullptr : &*found;
    }
    if (best == nullptr) {
        throw Error(fmt::format("no usable Vulkan device for \"{}\"", choice), "device",
                    describe(candidates));
    }
    return *best;
}

} // namespace estampe::gpu
