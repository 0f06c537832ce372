// SPDX-License-Identifier: MIT
#include "gpu/device.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstring>
#include <latch>
#include <system_error>
#include <thread>
#include <vector>

#include <fmt/format.h>

#include <estampe/error.hpp>
#include <estampe/vulkan.hpp>

#include "core/failure.hpp"
#include "core/text.hpp"

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

namespace {

/// Enables the required device features. If requested, also enables the features for rasterising in compute
/// shaders.
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

/// Loads Vulkan. If there is no Vulkan loader, throws an Error that names the package to install.
void load_vulkan()
{
    if (volkInitialize() != VK_SUCCESS) {
        throw Error("no Vulkan loader on this machine", "", "install libvulkan1 and mesa-vulkan-drivers");
    }
}

/// Loads Vulkan through the host application's loader and examines the host's physical device. Throws an
/// Error that names the features that the device lacks.
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

/// Returns all physical devices of `instance`, each with the reason if this program cannot use the device.
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

} // namespace

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
        const std::optional<uint32_t> index = number_from<uint32_t>(choice);
        if (!index) {
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

namespace {

/// Throws Error unless this process can start as many threads as a CPU driver starts. Mesa would wait forever
/// for a thread that fails to start. Cost: about 1 ms.
void require_driver_threads()
{
    // The driver starts one thread per core for triangles, one thread per core for compute shaders, and a few
    // threads that only wait.
    constexpr unsigned most_cores_used = 16;
    constexpr unsigned waiting = 4;
    const unsigned count = 2 * std::clamp(std::thread::hardware_concurrency(), 1U, most_cores_used) + waiting;
    std::latch all_tried(1);
    std::vector<std::jthread> threads;
    // The threads end on every way out of this function, also if memory runs out; the destructor of `threads`
    // would wait for them forever otherwise.
    const auto release = [](std::latch* latch) { latch->count_down(); };
    const std::unique_ptr<std::latch, decltype(release)> at_end(&all_tried, release);
    try {
        for (unsigned i = 0; i < count; ++i) {
            threads.emplace_back([&all_tried] { all_tried.wait(); });
        }
    } catch (const std::system_error& problem) {
        // The started threads still hold their stacks here, so that the cause can be found.
        const std::string what = fmt::format("drawing on the processor takes {} threads, {} could be started",
                                             count, threads.size());
        throw no_thread(what, problem);
    }
}

constexpr const char* validation_layer = "VK_LAYER_KHRONOS_validation";

VKAPI_ATTR VkBool32 VKAPI_CALL on_validation_message(VkDebugUtilsMessageSeverityFlagBitsEXT /*severity*/,
                                                     VkDebugUtilsMessageTypeFlagsEXT /*types*/,
                                                     const VkDebugUtilsMessengerCallbackDataEXT* data,
                                                     void* receiver)
{
    const auto& receive = *static_cast<std::function<void(const std::string&)>*>(receiver);
    if (receive) {
        receive(data->pMessage);
    } else {
        std::fprintf(stderr, "estampe: validation: %s\n", data->pMessage);
    }
    return VK_FALSE;
}

bool has_validation_layer()
{
    uint32_t count = 0;
    vkEnumerateInstanceLayerProperties(&count, nullptr);
    std::vector<VkLayerProperties> layers(count);
    vkEnumerateInstanceLayerProperties(&count, layers.data());
    return std::any_of(layers.begin(), layers.end(), [](const VkLayerProperties& layer) {
        return std::strcmp(layer.layerName, validation_layer) == 0;
    });
}

VkInstance make_instance(const void* next, bool validation)
{
    const VkApplicationInfo application{.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO,
                                        .pApplicationName = "estampe",
                                        .pEngineName = "estampe",
                                        .apiVersion = VK_API_VERSION_1_3};
    const char* debug_extension = VK_EXT_DEBUG_UTILS_EXTENSION_NAME;
    const VkInstanceCreateInfo info{.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO,
                                    .pNext = next,
                                    .pApplicationInfo = &application,
                                    .enabledLayerCount = validation ? 1U : 0U,
                                    .ppEnabledLayerNames = &validation_layer,
                                    .enabledExtensionCount = validation ? 1U : 0U,
                                    .ppEnabledExtensionNames = &debug_extension};
    VkInstance instance = VK_NULL_HANDLE;
    const VkResult result = vkCreateInstance(&info, nullptr, &instance);
    if (result == VK_ERROR_INCOMPATIBLE_DRIVER) {
        throw Error("no Vulkan driver on this machine", "",
                    "install mesa-vulkan-drivers to draw on the processor");
    }
    vk_check(result, "vkCreateInstance");
    volkLoadInstance(instance);
    return instance;
}

} // namespace

Device::Device(const RendererOptions& options)
    : on_validation_message_(
          std::make_unique<std::function<void(const std::string&)>>(options.on_validation_message))
{
    try {
        create_instance(options.validation);
        pick_physical(options.device);
        create_device();
        memory_ = std::make_unique<MemoryAllocator>(physical_, device_);
    } catch (...) {
        destroy();
        throw;
    }
}

Device::Device(const VulkanHost& host)
    : instance_(host.instance), device_(host.device), queue_(host.queue), queue_family_(host.queue_family),
      is_borrowed_(true)
{
    const Candidate candidate = host_candidate(host);
    take_physical(candidate.physical, candidate.info);
    create_fence();
    try {
        memory_ = std::make_unique<MemoryAllocator>(physical_, device_);
    } catch (...) {
        destroy();
        throw;
    }
}

Device::~Device()
{
    destroy();
}

void Device::destroy() noexcept
{
    if (is_borrowed_) {
        vkDestroyFence(device_, fence_, nullptr);
        return;
    }
    if (device_ != VK_NULL_HANDLE) {
        vkDeviceWaitIdle(device_);
        vkDestroyFence(device_, fence_, nullptr);
        memory_.reset();
        vkDestroyDevice(device_, nullptr);
    }
    if (messenger_ != VK_NULL_HANDLE) {
        vkDestroyDebugUtilsMessengerEXT(instance_, messenger_, nullptr);
    }
    if (instance_ != VK_NULL_HANDLE) {
        vkDestroyInstance(instance_, nullptr);
    }
}

void Device::create_instance(bool validation)
{
    load_vulkan();
    if (validation && !has_validation_layer()) {
        throw Error("validation was asked for, but its layer is not installed", "",
                    "install vulkan-validationlayers");
    }
    const VkDebugUtilsMessengerCreateInfoEXT messenger_info{
        .sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT,
        .messageSeverity =
            VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT,
        .messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT,
        .pfnUserCallback = on_validation_message,
        .pUserData = on_validation_message_.get()};
    const auto synchronization = VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT;
    const VkValidationFeaturesEXT features{.sType = VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT,
                                           .pNext = &messenger_info,
                                           .enabledValidationFeatureCount = 1,
                                           .pEnabledValidationFeatures = &synchronization};
    instance_ = make_instance(validation ? &features : nullptr, validation);
    if (validation) {
        vk_check(vkCreateDebugUtilsMessengerEXT(instance_, &messenger_info, nullptr, &messenger_),
                 "vkCreateDebugUtilsMessengerEXT");
    }
}

void Device::pick_physical(const std::string& choice)
{
    const std::vector<Candidate> candidates = list_candidates(instance_);
    const Candidate& chosen = choose(candidates, choice);
    take_physical(chosen.physical, chosen.info);
}

void Device::take_physical(VkPhysicalDevice physical, const DeviceInfo& info)
{
    physical_ = physical;
    info_ = info;
    VkPhysicalDeviceProperties properties{};
    vkGetPhysicalDeviceProperties(physical_, &properties);
    limits_ = properties.limits;
    if (info_.software) {
        require_driver_threads();
    }
}

void Device::create_device()
{
    uint32_t count = 0;
    vkGetPhysicalDeviceQueueFamilyProperties(physical_, &count, nullptr);
    std::vector<VkQueueFamilyProperties> families(count);
    vkGetPhysicalDeviceQueueFamilyProperties(physical_, &count, families.data());
    constexpr VkQueueFlags wanted = VK_QUEUE_GRAPHICS_BIT | VK_QUEUE_COMPUTE_BIT;
    const auto family = std::find_if(families.begin(), families.end(), [](const VkQueueFamilyProperties& f) {
        return (f.queueFlags & wanted) == wanted && f.timestampValidBits > 0;
    });
    if (family == families.end()) {
        throw Error("the graphics device has no queue for both drawing and computing", info_.name);
    }
    queue_family_ = static_cast<uint32_t>(family - families.begin());

    Features features;
    enable_features(features.core.features, features.v12, features.v13, info_.compute_raster);
    const float priority = 1.0F;
    const VkDeviceQueueCreateInfo queue_info{.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO,
                                             .queueFamilyIndex = queue_family_,
                                             .queueCount = 1,
                                             .pQueuePriorities = &priority};
    const VkDeviceCreateInfo info{.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO,
                                  .pNext = &features.core,
                                  .queueCreateInfoCount = 1,
                                  .pQueueCreateInfos = &queue_info};
    vk_check(vkCreateDevice(physical_, &info, nullptr, &device_), "vkCreateDevice");
    vkGetDeviceQueue(device_, queue_family_, 0, &queue_);
    create_fence();
}

void Device::create_fence()
{
    const VkFenceCreateInfo fence_info{.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO};
    vk_check(vkCreateFence(device_, &fence_info, nullptr, &fence_), "vkCreateFence");
}

void Device::submit_and_wait(VkCommandBuffer commands)
{
    const VkCommandBufferSubmitInfo command_info{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_SUBMIT_INFO,
                                                 .commandBuffer = commands};
    const VkSubmitInfo2 submit{.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO_2,
                               .commandBufferInfoCount = 1,
                               .pCommandBufferInfos = &command_info};
    vk_check(vkResetFences(device_, 1, &fence_), "vkResetFences");
    vk_check(vkQueueSubmit2(queue_, 1, &submit, fence_), "vkQueueSubmit2");
    vk_check(vkWaitForFences(device_, 1, &fence_, VK_TRUE, UINT64_MAX), "vkWaitForFences");
}

void Device::name(VkObjectType type, uint64_t object, const std::string& name) const
{
    if (messenger_ == VK_NULL_HANDLE) {
        return;
    }
    const VkDebugUtilsObjectNameInfoEXT info{.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_OBJECT_NAME_INFO_EXT,
                                             .objectType = type,
                                             .objectHandle = object,
                                             .pObjectName = name.c_str()};
    vkSetDebugUtilsObjectNameEXT(device_, &info);
}

} // namespace estampe::gpu

namespace estampe {

std::vector<DeviceInfo> list_devices()
{
    gpu::load_vulkan();
    VkInstance instance = gpu::make_instance(nullptr, false);
    std::vector<DeviceInfo> infos;
    for (const gpu::Candidate& candidate : gpu::list_candidates(instance)) {
        infos.push_back(candidate.info);
    }
    vkDestroyInstance(instance, nullptr);
    return infos;
}

VulkanFeatures::VulkanFeatures(const VulkanHost& host)
{
    const gpu::Candidate candidate = gpu::host_candidate(host);
    v13_.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES;
    v12_.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES;
    v12_.pNext = &v13_;
    core_.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2;
    core_.pNext = &v12_;
    gpu::enable_features(core_.features, v12_, v13_, candidate.info.compute_raster);
}

} // namespace estampe
