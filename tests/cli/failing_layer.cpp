// SPDX-License-Identifier: MIT
// A Vulkan layer under which calls fail, so that tests see what becomes of a lost device or of exhausted
// memory:
//
//     VK_LAYER_PATH=FOLDER VK_INSTANCE_LAYERS=VK_LAYER_ESTAMPE_failing ESTAMPE_FAIL=vkQueueSubmit2:3:-4
//     estampe ...
//
// lets the third vkQueueSubmit2 give the result -4, a lost device, after which all further submissions and
// waits fail alike until another device is created. Other results are given once. A fourth number repeats the
// failure: vkQueueSubmit2:3:-4:2 loses the device at the third call, and again 3 calls later. The name `any`
// stands for every call that can fail, `main` for those of the main thread, which draws; other threads open
// devices and compile ahead. ESTAMPE_COUNT_CALLS=FILE appends how often these calls were made.

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
    long times = 1;
};

Failure read_failure()
{
    Failure failure;
    const char* text = std::getenv("ESTAMPE_FAIL");
    if (text != nullptr && std::sscanf(text, "%63[^:]:%ld:%d:%ld", failure.call, &failure.number,
                                       &failure.result, &failure.times) < 3) {
        std::fprintf(stderr, "ESTAMPE_FAIL=%s is not CALL:NUMBER:RESULT[:TIMES]\n", text);
        std::abort();
    }
    return failure;
}

const Failure failure = read_failure();
std::atomic<long> calls{0};
std::atomic<long> calls_of_all{0};
std::atomic<long> calls_of_main{0};
std::atomic<bool> is_lost{false};

__attribute__((destructor)) void write_count()
{
    const char* const path = std::getenv("ESTAMPE_COUNT_CALLS");
    if (std::FILE* const file = path == nullptr ? nullptr : std::fopen(path, "a"); file != nullptr) {
        std::fprintf(file, "vulkan %ld\nvulkan-main %ld\n", calls_of_all.load(), calls_of_main.load());
        std::fclose(file);
    }
}

bool is_main_thread()
{
    return gettid() == getpid();
}

/// Whether a call is one of those that the environment names. Threads beside the one that draws compile
/// ahead, on devices of their own, and may fail unnoticed: what they bind for that is not counted.
bool is_named(std::string_view call)
{
    const std::string_view wanted(failure.call);
    return wanted == "any" || (wanted == "main" && is_main_thread()) ||
           (wanted == call && (call != "vkAllocateDescriptorSets" || is_main_thread()));
}

VkResult result_of(const char* call)
{
    const std::string_view name(call);
    ++calls_of_all;
    calls_of_main += is_main_thread() ? 1 : 0;
    if (is_lost &&
        (name.starts_with("vkQueue") || name.starts_with("vkWait") || name == "vkDeviceWaitIdle")) {
        return VK_ERROR_DEVICE_LOST;
    }
    if (!is_named(name)) {
        return VK_SUCCESS;
    }
    const long number = ++calls;
    if (number % failure.number != 0 || number / failure.number > failure.times) {
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
        WRAPPED(vkCreateBufferView),
        WRAPPED(vkCreateCommandPool),
        WRAPPED(vkCreateComputePipelines),
        WRAPPED(vkCreateDescriptorPool),
        WRAPPED(vkCreateDescriptorSetLayout),
        WRAPPED(vkCreateFence),
        WRAPPED(vkCreateGraphicsPipelines),
        WRAPPED(vkCreateImage),
        WRAPPED(vkCreateImageView),
        WRAPPED(vkCreatePipelineCache),
        WRAPPED(vkCreatePipelineLayout),
        WRAPPED(vkCreateQueryPool),
        WRAPPED(vkCreateSampler),
        WRAPPED(vkCreateShaderModule),
        WRAPPED(vkDeviceWaitIdle),
        WRAPPED(vkEndCommandBuffer),
        WRAPPED(vkGetPipelineCacheData),
        WRAPPED(vkGetQueryPoolResults),
        WRAPPED(vkMapMemory),
        WRAPPED(vkQueueSubmit2),
        WRAPPED(vkResetCommandPool),
        WRAPPED(vkResetDescriptorPool),
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
    is_lost = is_lost && result != VK_SUCCESS;
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
