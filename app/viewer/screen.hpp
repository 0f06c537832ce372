// SPDX-License-Identifier: MIT
#pragma once

// The viewer's window has its own Vulkan device, separate from the renderer's device. The Vulkan functions of
// the window's device are kept apart from the functions that the library loads globally. Loading a second
// instance would replace the global functions while the renderer draws.

#include <optional>
#include <string>
#include <vector>

#include "gpu/vulkan.hpp"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

namespace estampe::viewer {

// NOLINTBEGIN(bugprone-macro-parentheses)
#define VIEWER_INSTANCE_FUNCTIONS(each)                                                                      \
    each(DestroyInstance) each(EnumeratePhysicalDevices) each(GetPhysicalDeviceProperties)                   \
        each(GetPhysicalDeviceFeatures2) each(GetPhysicalDeviceMemoryProperties)                             \
            each(GetPhysicalDeviceQueueFamilyProperties) each(GetPhysicalDeviceSurfaceSupportKHR)            \
                each(GetPhysicalDeviceSurfaceCapabilitiesKHR) each(GetPhysicalDeviceSurfaceFormatsKHR)       \
                    each(DestroySurfaceKHR) each(CreateDevice) each(GetDeviceProcAddr)

#define VIEWER_DEVICE_FUNCTIONS(each)                                                                        \
    each(DestroyDevice) each(GetDeviceQueue) each(DeviceWaitIdle) each(QueueSubmit2) each(QueuePresentKHR)   \
        each(CreateSwapchainKHR) each(DestroySwapchainKHR) each(GetSwapchainImagesKHR) each(                 \
            AcquireNextImageKHR) each(CreateImage) each(DestroyImage) each(GetImageMemoryRequirements)       \
            each(BindImageMemory) each(CreateImageView) each(DestroyImageView) each(CreateBuffer) each(      \
                DestroyBuffer) each(GetBufferMemoryRequirements) each(BindBufferMemory) each(AllocateMemory) \
                each(FreeMemory) each(MapMemory) each(CreateSampler) each(DestroySampler)                    \
                    each(CreateShaderModule) each(DestroyShaderModule) each(CreateDescriptorSetLayout) each( \
                        DestroyDescriptorSetLayout) each(CreateDescriptorPool) each(DestroyDescriptorPool)   \
                        each(AllocateDescriptorSets) each(FreeDescriptorSets) each(UpdateDescriptorSets)     \
                            each(CreatePipelineLayout) each(DestroyPipelineLayout)                           \
                                each(CreateGraphicsPipelines) each(DestroyPipeline) each(CreateCommandPool)  \
                                    each(DestroyCommandPool) each(AllocateCommandBuffers)                    \
                                        each(BeginCommandBuffer) each(EndCommandBuffer)                      \
                                            each(ResetCommandPool) each(CreateFence) each(DestroyFence)      \
                                                each(WaitForFences) each(ResetFences) each(CreateSemaphore)  \
                                                    each(DestroySemaphore) each(CmdPipelineBarrier2)         \
                                                        each(CmdCopyBufferToImage) each(CmdBeginRendering)   \
                                                            each(CmdEndRendering) each(CmdBindPipeline)      \
                                                                each(CmdBindDescriptorSets)                  \
                                                                    each(CmdBindVertexBuffers)               \
                                                                        each(CmdBindIndexBuffer)             \
                                                                            each(CmdPushConstants)           \
                                                                                each(CmdSetViewport)         \
                                                                                    each(CmdSetScissor)      \
                                                                                        each(CmdDrawIndexed)

struct InstanceFunctions {
#define VIEWER_DECLARE(name) PFN_vk##name name = nullptr;
    VIEWER_INSTANCE_FUNCTIONS(VIEWER_DECLARE)
};

struct DeviceFunctions {
    VIEWER_DEVICE_FUNCTIONS(VIEWER_DECLARE)
#undef VIEWER_DECLARE
};

// NOLINTEND(bugprone-macro-parentheses)

/// Loads the Vulkan functions of an instance that was made through GLFW's loader.
[[nodiscard]] InstanceFunctions load_functions(VkInstance instance);
[[nodiscard]] DeviceFunctions load_functions(const InstanceFunctions& vk, VkDevice device);

/// Device memory that belongs to a single buffer or image; the window has only a few of them.
struct Allocation {
    VkDeviceMemory memory = VK_NULL_HANDLE;
    void* mapped = nullptr; ///< Address of the memory for the CPU; only set for host-visible memory
};

/// The window's Vulkan device and swapchain. Painted values are sRGB bytes, shown without conversion.
class Screen {
public:
    /// Opens the device that `choice` names as --device does, if that device can present to this window;
    /// otherwise the best device that can. Throws Error when there is none.
    Screen(GLFWwindow* window, const std::string& choice);
    ~Screen();
    Screen(const Screen&) = delete;
    Screen& operator=(const Screen&) = delete;

    /// A frame of the window while its Vulkan commands are recorded.
    struct Frame {
        VkCommandBuffer commands = VK_NULL_HANDLE;
        VkExtent2D size_px{};
        uint32_t image = 0;
    };

    /// Begins a frame; returns nothing while the window has no size. Record copies to textures after this
    /// call.
    [[nodiscard]] std::optional<Frame> begin();
    /// Begins rendering to the window; record draw calls after this call.
    void begin_drawing(const Frame& frame) const;
    /// Submits the frame and presents it in the window.
    void end(const Frame& frame);

    /// Waits until the device has finished the last frame, so that its resources are free.
    void wait() const;

    [[nodiscard]] const DeviceFunctions& vk() const { return vk_; }

    [[nodiscard]] VkDevice device() const { return device_; }

    [[nodiscard]] VkFormat format() const { return format_.format; }

    /// Allocates and binds the memory of a buffer or image. Throws Error when there is no memory left.
    [[nodiscard]] Allocation allocate(VkBuffer buffer) const;
    [[nodiscard]] Allocation allocate(VkImage image) const;

private:
    void create_instance();
    void pick_physical(const std::string& choice);
    void create_device();
    void create_swapchain();
    void destroy_swapchain();
    [[nodiscard]] VkDeviceMemory allocate(const VkMemoryRequirements& needs,
                                          VkMemoryPropertyFlags wanted) const;

    GLFWwindow* window_;
    VkInstance instance_ = VK_NULL_HANDLE;
    InstanceFunctions instance_vk_;
    VkSurfaceKHR surface_ = VK_NULL_HANDLE;
    VkPhysicalDevice physical_ = VK_NULL_HANDLE;
    uint32_t queue_family_ = 0;
    VkDevice device_ = VK_NULL_HANDLE;
    DeviceFunctions vk_;
    VkQueue queue_ = VK_NULL_HANDLE;
    VkSurfaceFormatKHR format_{};
    VkSwapchainKHR swapchain_ = VK_NULL_HANDLE;
    VkExtent2D size_px_{};
    bool is_outdated_ = true;
    std::vector<VkImage> images_;
    std::vector<VkImageView> views_;
    /// One semaphore per image of the swapchain, signalled when the image is drawn.
    std::vector<VkSemaphore> drawn_;
    VkSemaphore acquired_ = VK_NULL_HANDLE;
    VkFence done_ = VK_NULL_HANDLE;
    VkCommandPool pool_ = VK_NULL_HANDLE;
    VkCommandBuffer commands_ = VK_NULL_HANDLE;
};

} // namespace estampe::viewer
