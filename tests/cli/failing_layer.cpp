// SPDX-License-Identifier: MIT
// A Vulkan layer under which one call fails, so that tests see what becomes of a lost device or of exhausted
// memory:
//
//     VK_LAYER_PATH=FOLDER VK_INSTANCE_LAYERS=VK_LAYER_ESTAMPE_failing ESTAMPE_FAIL=vkQueueSubmit2:3:-4
//     estampe ...
//
// lets the third vkQueueSubmit2 give the result -4, a lost device, after which all further submissions and
// waits fail alike. Other results are given once.

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string_view>

#include <unistd.h>

#include <vulkan/vk_layer.h>
#include <vulkan/vulkan.h>

namespace {

struct Failure {
    char call[64] = "";
    long number = 0; ///< from 1
    int result = 0;
};

Failure read_failure()
{
    Failure failure;
    const char* text = std::getenv("ESTAMPE_FAIL");
    if (text != nullptr &&
        std::sscanf(text, "%63[^:]:%ld:%d", failure.call, &failure.number, &failure.result) != 3) {
        std::fprintf(stderr, "ESTAMPE_FAIL=%s is not CALL:NUMBER:RESULT\n", text);
        std::abort();
    }
    return failure;
}

const Failure failure = read_failure();
std::atomic<long> calls{0};
std::atomic<bool> is_lost{false};

/// Threads beside the one that draws compile ahead, on devices of their own, and may fail unnoticed: what
/// they bind for that is not counted.
bool is_ahead(std::string_view call)
{
    return call == "vkAllocateDescriptorSets" && gettid() != getpid();
}

VkResult result_of(const char* call)
{
    const std::string_view name(call);
    if (is_lost &&
        (name.starts_with("vkQueue") || name.starts_with("vkWait") || name == "vkDeviceWaitIdle")) {
        return VK_ERROR_DEVICE_LOST;
    }
    if (name != failure.call || is_ahead(name) || ++calls != failure.number) {
        return VK_SUCCESS;
    }
    is_lost = failure.result == VK_ERROR_DEVICE_LOST;
    return static_cast<VkResult>(failure.result);
}

PFN_vkGetInstanceProcAddr next_instance_call = nullptr;
PFN_vkGetDeviceProcAddr next_device_call = nullptr;

struct Call {
    const char* name;
    PFN_vkVoidFunction ours;
    PFN_vkVoidFunction& next;
};

template <size_t N>
struct Name {
    char text[N];

    constexpr Name(const char (&given)[N]) { std::copy_n(given, N, text); }
};

/// One call that may fail, and what comes after this layer.
template <Name name, typename Function>
struct Wrapped;

template <Name name, typename... Arguments>
struct Wrapped<name, VkResult(VKAPI_PTR*)(Arguments...)> {
    static inline PFN_vkVoidFunction next = nullptr;

    static VKAPI_ATTR VkResult VKAPI_CALL call(Arguments... arguments)
    {
        const VkResult result = result_of(name.text);
        return result != VK_SUCCESS
                   ? result
                   : reinterpret_cast<VkResult(VKAPI_PTR*)(Arguments...)>(next)(arguments...);
    }

    static Call entry() { return {name.text, reinterpret_cast<PFN_vkVoidFunction>(call), next}; }
};

#define WRAPPED(name) Wrapped<#name, PFN_##name>::entry()

/// Every call of a device that the program makes and that can fail.
const Call* find_call(const char* name)
{
    static const Call wrapped[] = {
        WRAPPED(vkAllocateCommandBuffers),
        WRAPPED(vkAllocateDescriptorSets),
        WRAPPED(vkAllocateMemory),
        WRAPPED(vkBeginCommandBuffer),
        WRAPPED(vkBindBufferMemory),
        WRAPPED(vkBindImageMemory),
        WRAPPED(vkCreateBuffer),
        WRAPPED(vkCreateCommandPool),
        WRAPPED(vkCreateComputePipelines),
        WRAPPED(vkCreateDescriptorPool),
        WRAPPED(vkCreateDescriptorSetLayout),
        WRAPPED(vkCreateFence),
        WRAPPED(vkCreateGraphicsPipelines),
        WRAPPED(vkCreateImage),
        WRAPPED(vkCreateImageView),
        WRAPPED(vkCreatePipelineLayout),
        WRAPPED(vkCreateQueryPool),
        WRAPPED(vkCreateSampler),
        WRAPPED(vkCreateShaderModule),
        WRAPPED(vkDeviceWaitIdle),
        WRAPPED(vkEndCommandBuffer),
        WRAPPED(vkGetQueryPoolResults),
        WRAPPED(vkMapMemory),
        WRAPPED(vkQueueSubmit2),
        WRAPPED(vkResetCommandPool),
        WRAPPED(vkResetFences),
        WRAPPED(vkWaitForFences),
    };
    for (const Call& call : wrapped) {
        if (std::strcmp(name, call.name) == 0) {
            return &call;
        }
    }
    return nullptr;
}

/// The link of the loader's chain that holds what comes after this layer.
template <typename Link, VkStructureType type>
Link* find_link(const void* chain)
{
    auto* link = static_cast<Link*>(const_cast<void*>(chain));
    while (link != nullptr && (link->sType != type || link->function != VK_LAYER_LINK_INFO)) {
        link = static_cast<Link*>(const_cast<void*>(link->pNext));
    }
    return link;
}

VKAPI_ATTR VkResult VKAPI_CALL create_instance(const VkInstanceCreateInfo* info,
                                               const VkAllocationCallbacks* allocator, VkInstance* made)
{
    auto* link =
        find_link<VkLayerInstanceCreateInfo, VK_STRUCTURE_TYPE_LOADER_INSTANCE_CREATE_INFO>(info->pNext);
    next_instance_call = link->u.pLayerInfo->pfnNextGetInstanceProcAddr;
    link->u.pLayerInfo = link->u.pLayerInfo->pNext;
    const VkResult result = result_of("vkCreateInstance");
    const auto next =
        reinterpret_cast<PFN_vkCreateInstance>(next_instance_call(VK_NULL_HANDLE, "vkCreateInstance"));
    return result != VK_SUCCESS ? result : next(info, allocator, made);
}

VKAPI_ATTR VkResult VKAPI_CALL create_device(VkPhysicalDevice physical, const VkDeviceCreateInfo* info,
                                             const VkAllocationCallbacks* allocator, VkDevice* made)
{
    auto* link = find_link<VkLayerDeviceCreateInfo, VK_STRUCTURE_TYPE_LOADER_DEVICE_CREATE_INFO>(info->pNext);
    next_device_call = link->u.pLayerInfo->pfnNextGetDeviceProcAddr;
    const auto next = reinterpret_cast<PFN_vkCreateDevice>(
        link->u.pLayerInfo->pfnNextGetInstanceProcAddr(VK_NULL_HANDLE, "vkCreateDevice"));
    link->u.pLayerInfo = link->u.pLayerInfo->pNext;
    const VkResult result = result_of("vkCreateDevice");
    return result != VK_SUCCESS ? result : next(physical, info, allocator, made);
}

} // namespace

extern "C" {

__attribute__((visibility("default"))) PFN_vkVoidFunction VKAPI_CALL estampe_get_device_call(VkDevice device,
                                                                                             const char* name)
{
    const Call* call = find_call(name);
    PFN_vkVoidFunction next = next_device_call(device, name);
    if (call == nullptr || next == nullptr) {
        return next;
    }
    call->next = next;
    return call->ours;
}

__attribute__((visibility("default"))) PFN_vkVoidFunction VKAPI_CALL
estampe_get_instance_call(VkInstance instance, const char* name)
{
    if (std::strcmp(name, "vkCreateInstance") == 0) {
        return reinterpret_cast<PFN_vkVoidFunction>(create_instance);
    }
    if (std::strcmp(name, "vkCreateDevice") == 0) {
        return reinterpret_cast<PFN_vkVoidFunction>(create_device);
    }
    if (std::strcmp(name, "vkGetDeviceProcAddr") == 0) {
        return reinterpret_cast<PFN_vkVoidFunction>(estampe_get_device_call);
    }
    return next_instance_call == nullptr ? nullptr : next_instance_call(instance, name);
}

__attribute__((visibility("default"))) VKAPI_ATTR VkResult VKAPI_CALL
vkNegotiateLoaderLayerInterfaceVersion(VkNegotiateLayerInterface* loader)
{
    loader->loaderLayerInterfaceVersion = 2;
    loader->pfnGetInstanceProcAddr = estampe_get_instance_call;
    loader->pfnGetDeviceProcAddr = estampe_get_device_call;
    loader->pfnGetPhysicalDeviceProcAddr = nullptr;
    return VK_SUCCESS;
}
}
