// SPDX-License-Identifier: MIT
#include "viewer/screen.hpp"

#include <algorithm>
#include <array>
#include <limits>

#include <estampe/error.hpp>

#include "gpu/vulkan.hpp"

namespace estampe::viewer {

InstanceFunctions load_functions(VkInstance instance)
{
    InstanceFunctions vk;
#define VIEWER_LOAD(name)                                                                                    \
    vk.name = reinterpret_cast<PFN_vk##name>(glfwGetInstanceProcAddress(instance, "vk" #name));
    VIEWER_INSTANCE_FUNCTIONS(VIEWER_LOAD)
#undef VIEWER_LOAD
    return vk;
}

DeviceFunctions load_functions(const InstanceFunctions& vk, VkDevice device)
{
    DeviceFunctions made;
#define VIEWER_LOAD(name)                                                                                    \
    made.name = reinterpret_cast<PFN_vk##name>(vk.GetDeviceProcAddr(device, "vk" #name));
    VIEWER_DEVICE_FUNCTIONS(VIEWER_LOAD)
#undef VIEWER_LOAD
    return made;
}

namespace {

using gpu::vk_check;

constexpr uint64_t forever = std::numeric_limits<uint64_t>::max();

struct Candidate {
    VkPhysicalDevice physical = VK_NULL_HANDLE;
    uint32_t queue_family = 0;
    int preference = 0; ///< Rank of the device; the device with the lowest number is used
};

/// Returns the rank of a device. Discrete GPUs come before other GPUs, and all GPUs before CPUs. The
/// requested device comes first.
int preference_of(const VkPhysicalDeviceProperties& properties, uint32_t index, const std::string& choice)
{
    const bool is_cpu = properties.deviceType == VK_PHYSICAL_DEVICE_TYPE_CPU;
    if (choice == std::to_string(index) || (choice == "cpu" && is_cpu)) {
        return -1;
    }
    return properties.deviceType == VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU ? 0 : is_cpu ? 2 : 1;
}

bool can_paint(const InstanceFunctions& vk, VkPhysicalDevice physical)
{
    VkPhysicalDeviceVulkan13Features features{.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES};
    VkPhysicalDeviceFeatures2 all{.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2, .pNext = &features};
    VkPhysicalDeviceProperties properties{};
    vk.GetPhysicalDeviceProperties(physical, &properties);
    if (properties.apiVersion < VK_API_VERSION_1_3) {
        return false;
    }
    vk.GetPhysicalDeviceFeatures2(physical, &all);
    return features.dynamicRendering == VK_TRUE && features.synchronization2 == VK_TRUE;
}

VkImageMemoryBarrier2 whole_image(VkImage image)
{
    return {.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2,
            .srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
            .dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
            .image = image,
            .subresourceRange = {.aspectMask = VK_IMAGE_ASPECT_COLOR_BIT, .levelCount = 1, .layerCount = 1}};
}

void record_barrier(const DeviceFunctions& vk, VkCommandBuffer commands, const VkImageMemoryBarrier2& barrier)
{
    const VkDependencyInfo info{.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO,
                                .imageMemoryBarrierCount = 1,
                                .pImageMemoryBarriers = &barrier};
    vk.CmdPipelineBarrier2(commands, &info);
}

} // namespace

Screen::Screen(GLFWwindow* window, const std::string& choice) : window_(window)
{
    create_instance();
    pick_physical(choice);
    create_device();
}

Screen::~Screen()
{
    if (device_ != VK_NULL_HANDLE) {
        vk_.DeviceWaitIdle(device_);
        destroy_swapchain();
        vk_.DestroyCommandPool(device_, pool_, nullptr);
        vk_.DestroyFence(device_, done_, nullptr);
        vk_.DestroySemaphore(device_, acquired_, nullptr);
        vk_.DestroyDevice(device_, nullptr);
    }
    if (surface_ != VK_NULL_HANDLE) {
        instance_vk_.DestroySurfaceKHR(instance_, surface_, nullptr);
    }
    if (instance_ != VK_NULL_HANDLE) {
        instance_vk_.DestroyInstance(instance_, nullptr);
    }
}

void Screen::create_instance()
{
    uint32_t extension_count = 0;
    const char** extensions = glfwGetRequiredInstanceExtensions(&extension_count);
    if (extensions == nullptr) {
        throw Error("Vulkan cannot show pictures in windows here", "",
                    "install libvulkan1 and mesa-vulkan-drivers; estampe render needs no window");
    }
    const VkApplicationInfo application{.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO,
                                        .pApplicationName = "estampe view",
                                        .pEngineName = "estampe",
                                        .apiVersion = VK_API_VERSION_1_3};
    const VkInstanceCreateInfo info{.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO,
                                    .pApplicationInfo = &application,
                                    .enabledExtensionCount = extension_count,
                                    .ppEnabledExtensionNames = extensions};
    const auto create =
        reinterpret_cast<PFN_vkCreateInstance>(glfwGetInstanceProcAddress(nullptr, "vkCreateInstance"));
    vk_check(create(&info, nullptr, &instance_), "vkCreateInstance");
    instance_vk_ = load_functions(instance_);
    vk_check(glfwCreateWindowSurface(instance_, window_, nullptr, &surface_), "glfwCreateWindowSurface");
}

void Screen::pick_physical(const std::string& choice)
{
    uint32_t count = 0;
    vk_check(instance_vk_.EnumeratePhysicalDevices(instance_, &count, nullptr), "vkEnumeratePhysicalDevices");
    std::vector<VkPhysicalDevice> devices(count);
    vk_check(instance_vk_.EnumeratePhysicalDevices(instance_, &count, devices.data()),
             "vkEnumeratePhysicalDevices");
    std::vector<Candidate> candidates;
    for (uint32_t index = 0; index < count; ++index) {
        VkPhysicalDevice physical = devices[index];
        uint32_t family_count = 0;
        instance_vk_.GetPhysicalDeviceQueueFamilyProperties(physical, &family_count, nullptr);
        std::vector<VkQueueFamilyProperties> families(family_count);
        instance_vk_.GetPhysicalDeviceQueueFamilyProperties(physical, &family_count, families.data());
        for (uint32_t family = 0; family < family_count && can_paint(instance_vk_, physical); ++family) {
            VkBool32 shows = VK_FALSE;
            instance_vk_.GetPhysicalDeviceSurfaceSupportKHR(physical, family, surface_, &shows);
            if (shows == VK_TRUE && (families[family].queueFlags & VK_QUEUE_GRAPHICS_BIT) != 0) {
                VkPhysicalDeviceProperties properties{};
                instance_vk_.GetPhysicalDeviceProperties(physical, &properties);
                candidates.push_back({physical, family, preference_of(properties, index, choice)});
                break;
            }
        }
    }
    const auto best = std::ranges::min_element(candidates, {}, &Candidate::preference);
    if (best == candidates.end()) {
        throw Error("no Vulkan device can show pictures in a window of this display", "",
                    "install mesa-vulkan-drivers; estampe render needs no window");
    }
    physical_ = best->physical;
    queue_family_ = best->queue_family;
}

void Screen::create_device()
{
    VkPhysicalDeviceVulkan13Features features{.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES,
                                              .synchronization2 = VK_TRUE,
                                              .dynamicRendering = VK_TRUE};
    const float priority = 1.0F;
    const VkDeviceQueueCreateInfo queue_info{.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO,
                                             .queueFamilyIndex = queue_family_,
                                             .queueCount = 1,
                                             .pQueuePriorities = &priority};
    const char* extension = VK_KHR_SWAPCHAIN_EXTENSION_NAME;
    const VkDeviceCreateInfo info{.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO,
                                  .pNext = &features,
                                  .queueCreateInfoCount = 1,
                                  .pQueueCreateInfos = &queue_info,
                                  .enabledExtensionCount = 1,
                                  .ppEnabledExtensionNames = &extension};
    vk_check(instance_vk_.CreateDevice(physical_, &info, nullptr, &device_), "vkCreateDevice");
    vk_ = load_functions(instance_vk_, device_);
    vk_.GetDeviceQueue(device_, queue_family_, 0, &queue_);

    uint32_t count = 0;
    instance_vk_.GetPhysicalDeviceSurfaceFormatsKHR(physical_, surface_, &count, nullptr);
    std::vector<VkSurfaceFormatKHR> formats(count);
    instance_vk_.GetPhysicalDeviceSurfaceFormatsKHR(physical_, surface_, &count, formats.data());
    const auto plain = std::ranges::find_if(formats, [](const VkSurfaceFormatKHR& format) {
        return (format.format == VK_FORMAT_B8G8R8A8_UNORM || format.format == VK_FORMAT_R8G8B8A8_UNORM) &&
               format.colorSpace == VK_COLOR_SPACE_SRGB_NONLINEAR_KHR;
    });
    if (plain == formats.end()) {
        throw Error("the display takes no pictures of 8 bits a channel");
    }
    format_ = *plain;

    const VkCommandPoolCreateInfo pool_info{.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO,
                                            .queueFamilyIndex = queue_family_};
    vk_check(vk_.CreateCommandPool(device_, &pool_info, nullptr, &pool_), "vkCreateCommandPool");
    const VkCommandBufferAllocateInfo commands_info{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO,
                                                    .commandPool = pool_,
                                                    .level = VK_COMMAND_BUFFER_LEVEL_PRIMARY,
                                                    .commandBufferCount = 1};
    vk_check(vk_.AllocateCommandBuffers(device_, &commands_info, &commands_), "vkAllocateCommandBuffers");
    const VkFenceCreateInfo fence_info{.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO,
                                       .flags = VK_FENCE_CREATE_SIGNALED_BIT};
    vk_check(vk_.CreateFence(device_, &fence_info, nullptr, &done_), "vkCreateFence");
    const VkSemaphoreCreateInfo semaphore_info{.sType = VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO};
    vk_check(vk_.CreateSemaphore(device_, &semaphore_info, nullptr, &acquired_), "vkCreateSemaphore");
}

void Screen::create_swapchain()
{
    vk_.DeviceWaitIdle(device_);
    destroy_swapchain();
    VkSurfaceCapabilitiesKHR can{};
    vk_check(instance_vk_.GetPhysicalDeviceSurfaceCapabilitiesKHR(physical_, surface_, &can),
             "vkGetPhysicalDeviceSurfaceCapabilitiesKHR");
    int width = 0;
    int height = 0;
    glfwGetFramebufferSize(window_, &width, &height);
    size_px_ = can.currentExtent;
    if (size_px_.width == std::numeric_limits<uint32_t>::max()) {
        size_px_ = {
            std::clamp(static_cast<uint32_t>(width), can.minImageExtent.width, can.maxImageExtent.width),
            std::clamp(static_cast<uint32_t>(height), can.minImageExtent.height, can.maxImageExtent.height)};
    }
    if (size_px_.width == 0 || size_px_.height == 0) {
        return;
    }
    const uint32_t most = can.maxImageCount > 0 ? can.maxImageCount : can.minImageCount + 1;
    const VkSwapchainCreateInfoKHR info{.sType = VK_STRUCTURE_TYPE_SWAPCHAIN_CREATE_INFO_KHR,
                                        .surface = surface_,
                                        .minImageCount = std::min(can.minImageCount + 1, most),
                                        .imageFormat = format_.format,
                                        .imageColorSpace = format_.colorSpace,
                                        .imageExtent = size_px_,
                                        .imageArrayLayers = 1,
                                        .imageUsage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT,
                                        .imageSharingMode = VK_SHARING_MODE_EXCLUSIVE,
                                        .preTransform = can.currentTransform,
                                        .compositeAlpha = VK_COMPOSITE_ALPHA_OPAQUE_BIT_KHR,
                                        .presentMode = VK_PRESENT_MODE_FIFO_KHR,
                                        .clipped = VK_TRUE};
    vk_check(vk_.CreateSwapchainKHR(device_, &info, nullptr, &swapchain_), "vkCreateSwapchainKHR");
    uint32_t count = 0;
    vk_check(vk_.GetSwapchainImagesKHR(device_, swapchain_, &count, nullptr), "vkGetSwapchainImagesKHR");
    images_.resize(count);
    vk_check(vk_.GetSwapchainImagesKHR(device_, swapchain_, &count, images_.data()),
             "vkGetSwapchainImagesKHR");
    for (VkImage image : images_) {
        const VkImageViewCreateInfo view_info{.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO,
                                              .image = image,
                                              .viewType = VK_IMAGE_VIEW_TYPE_2D,
                                              .format = format_.format,
                                              .subresourceRange = whole_image(image).subresourceRange};
        vk_check(vk_.CreateImageView(device_, &view_info, nullptr, &views_.emplace_back()),
                 "vkCreateImageView");
        const VkSemaphoreCreateInfo semaphore_info{.sType = VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO};
        vk_check(vk_.CreateSemaphore(device_, &semaphore_info, nullptr, &drawn_.emplace_back()),
                 "vkCreateSemaphore");
    }
    is_outdated_ = false;
}

void Screen::destroy_swapchain()
{
    for (VkImageView view : views_) {
        vk_.DestroyImageView(device_, view, nullptr);
    }
    for (VkSemaphore semaphore : drawn_) {
        vk_.DestroySemaphore(device_, semaphore, nullptr);
    }
    views_.clear();
    drawn_.clear();
    images_.clear();
    if (swapchain_ != VK_NULL_HANDLE) {
        vk_.DestroySwapchainKHR(device_, swapchain_, nullptr);
        swapchain_ = VK_NULL_HANDLE;
    }
}

void Screen::wait() const
{
    vk_check(vk_.WaitForFences(device_, 1, &done_, VK_TRUE, forever), "vkWaitForFences");
}

std::optional<Screen::Frame> Screen::begin()
{
    int width = 0;
    int height = 0;
    glfwGetFramebufferSize(window_, &width, &height);
    if (width == 0 || height == 0) {
        return std::nullopt; // No frame is drawn, because the window is minimised
    }
    if (is_outdated_ || size_px_.width != static_cast<uint32_t>(width) ||
        size_px_.height != static_cast<uint32_t>(height)) {
        create_swapchain();
    }
    if (swapchain_ == VK_NULL_HANDLE) {
        return std::nullopt;
    }
    wait();
    Frame frame{.commands = commands_, .size_px = size_px_};
    const VkResult result =
        vk_.AcquireNextImageKHR(device_, swapchain_, forever, acquired_, VK_NULL_HANDLE, &frame.image);
    if (result == VK_ERROR_OUT_OF_DATE_KHR) {
        is_outdated_ = true;
        return std::nullopt;
    }
    if (result != VK_SUBOPTIMAL_KHR) {
        vk_check(result, "vkAcquireNextImageKHR");
    }
    vk_check(vk_.ResetFences(device_, 1, &done_), "vkResetFences");
    vk_check(vk_.ResetCommandPool(device_, pool_, 0), "vkResetCommandPool");
    const VkCommandBufferBeginInfo begin_info{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO,
                                              .flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT};
    vk_check(vk_.BeginCommandBuffer(commands_, &begin_info), "vkBeginCommandBuffer");
    return frame;
}

void Screen::begin_drawing(const Frame& frame) const
{
    VkImageMemoryBarrier2 barrier = whole_image(images_[frame.image]);
    barrier.srcStageMask = VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT;
    barrier.dstStageMask = VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT;
    barrier.dstAccessMask = VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT | VK_ACCESS_2_COLOR_ATTACHMENT_READ_BIT;
    barrier.newLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
    record_barrier(vk_, frame.commands, barrier);
    const VkRenderingAttachmentInfo color{.sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO,
                                          .imageView = views_[frame.image],
                                          .imageLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
                                          .loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR,
                                          .storeOp = VK_ATTACHMENT_STORE_OP_STORE,
                                          .clearValue = {.color = {.float32 = {0.93F, 0.92F, 0.9F, 1.0F}}}};
    const VkRenderingInfo info{.sType = VK_STRUCTURE_TYPE_RENDERING_INFO,
                               .renderArea = {.extent = frame.size_px},
                               .layerCount = 1,
                               .colorAttachmentCount = 1,
                               .pColorAttachments = &color};
    vk_.CmdBeginRendering(frame.commands, &info);
}

void Screen::end(const Frame& frame)
{
    vk_.CmdEndRendering(frame.commands);
    VkImageMemoryBarrier2 barrier = whole_image(images_[frame.image]);
    barrier.srcStageMask = VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT;
    barrier.srcAccessMask = VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT;
    barrier.oldLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
    barrier.newLayout = VK_IMAGE_LAYOUT_PRESENT_SRC_KHR;
    record_barrier(vk_, frame.commands, barrier);
    vk_check(vk_.EndCommandBuffer(frame.commands), "vkEndCommandBuffer");

    const VkSemaphoreSubmitInfo acquired{.sType = VK_STRUCTURE_TYPE_SEMAPHORE_SUBMIT_INFO,
                                         .semaphore = acquired_,
                                         .stageMask = VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT};
    const VkSemaphoreSubmitInfo drawn{.sType = VK_STRUCTURE_TYPE_SEMAPHORE_SUBMIT_INFO,
                                      .semaphore = drawn_[frame.image],
                                      .stageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT};
    const VkCommandBufferSubmitInfo commands{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_SUBMIT_INFO,
                                             .commandBuffer = frame.commands};
    const VkSubmitInfo2 submit{.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO_2,
                               .waitSemaphoreInfoCount = 1,
                               .pWaitSemaphoreInfos = &acquired,
                               .commandBufferInfoCount = 1,
                               .pCommandBufferInfos = &commands,
                               .signalSemaphoreInfoCount = 1,
                               .pSignalSemaphoreInfos = &drawn};
    vk_check(vk_.QueueSubmit2(queue_, 1, &submit, done_), "vkQueueSubmit2");
    const VkPresentInfoKHR present{.sType = VK_STRUCTURE_TYPE_PRESENT_INFO_KHR,
                                   .waitSemaphoreCount = 1,
                                   .pWaitSemaphores = &drawn_[frame.image],
                                   .swapchainCount = 1,
                                   .pSwapchains = &swapchain_,
                                   .pImageIndices = &frame.image};
    const VkResult result = vk_.QueuePresentKHR(queue_, &present);
    if (result == VK_ERROR_OUT_OF_DATE_KHR || result == VK_SUBOPTIMAL_KHR) {
        is_outdated_ = true;
    } else {
        vk_check(result, "vkQueuePresentKHR");
    }
}

VkDeviceMemory Screen::allocate(const VkMemoryRequirements& needs, VkMemoryPropertyFlags wanted) const
{
    VkPhysicalDeviceMemoryProperties offered{};
    instance_vk_.GetPhysicalDeviceMemoryProperties(physical_, &offered);
    for (uint32_t type = 0; type < offered.memoryTypeCount; ++type) {
        const bool fits = ((needs.memoryTypeBits >> type) & 1U) != 0;
        if (fits && (offered.memoryTypes[type].propertyFlags & wanted) == wanted) {
            const VkMemoryAllocateInfo info{.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO,
                                            .allocationSize = needs.size,
                                            .memoryTypeIndex = type};
            VkDeviceMemory memory = VK_NULL_HANDLE;
            vk_check(vk_.AllocateMemory(device_, &info, nullptr, &memory), "vkAllocateMemory");
            return memory;
        }
    }
    throw Error("the window's device has no memory of the kind that is needed");
}

Allocation Screen::allocate(VkBuffer buffer) const
{
    VkMemoryRequirements needs{};
    vk_.GetBufferMemoryRequirements(device_, buffer, &needs);
    Allocation made{.memory = allocate(needs, VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT |
                                                  VK_MEMORY_PROPERTY_HOST_COHERENT_BIT)};
    vk_check(vk_.BindBufferMemory(device_, buffer, made.memory, 0), "vkBindBufferMemory");
    vk_check(vk_.MapMemory(device_, made.memory, 0, VK_WHOLE_SIZE, 0, &made.mapped), "vkMapMemory");
    return made;
}

Allocation Screen::allocate(VkImage image) const
{
    VkMemoryRequirements needs{};
    vk_.GetImageMemoryRequirements(device_, image, &needs);
    Allocation made{.memory = allocate(needs, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT)};
    vk_check(vk_.BindImageMemory(device_, image, made.memory, 0), "vkBindImageMemory");
    return made;
}

} // namespace estampe::viewer
