// SPDX-License-Identifier: MIT
#include "host.hpp"

#include <cstring>
#include <stdexcept>
#include <string>

namespace {

void check(VkResult result, const char* call)
{
    if (result != VK_SUCCESS) {
        throw std::runtime_error(std::string(call) + " failed");
    }
}

VkInstance make_instance()
{
    const VkApplicationInfo application{.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO,
                                        .pApplicationName = "host_device",
                                        .apiVersion = VK_API_VERSION_1_3};
    const VkInstanceCreateInfo info{.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO,
                                    .pApplicationInfo = &application};
    VkInstance instance = VK_NULL_HANDLE;
    check(vkCreateInstance(&info, nullptr, &instance), "vkCreateInstance");
    return instance;
}

VkPhysicalDevice first_device(VkInstance instance)
{
    uint32_t count = 1;
    VkPhysicalDevice physical = VK_NULL_HANDLE;
    const VkResult result = vkEnumeratePhysicalDevices(instance, &count, &physical);
    if ((result != VK_SUCCESS && result != VK_INCOMPLETE) || count == 0) {
        throw std::runtime_error("there is no Vulkan device");
    }
    return physical;
}

uint32_t drawing_family(VkPhysicalDevice physical)
{
    uint32_t count = 0;
    vkGetPhysicalDeviceQueueFamilyProperties(physical, &count, nullptr);
    std::vector<VkQueueFamilyProperties> families(count);
    vkGetPhysicalDeviceQueueFamilyProperties(physical, &count, families.data());
    constexpr VkQueueFlags wanted = VK_QUEUE_GRAPHICS_BIT | VK_QUEUE_COMPUTE_BIT;
    for (uint32_t family = 0; family < count; ++family) {
        if ((families[family].queueFlags & wanted) == wanted && families[family].timestampValidBits > 0) {
            return family;
        }
    }
    throw std::runtime_error("the device has no queue for drawing and computing");
}

} // namespace

Host::Host()
{
    vulkan_.get_instance_proc_addr = vkGetInstanceProcAddr;
    vulkan_.instance = make_instance();
    vulkan_.physical_device = first_device(vulkan_.instance);
    vulkan_.queue_family = drawing_family(vulkan_.physical_device);
    estampe::VulkanFeatures features(vulkan_);
    const float priority = 1.0F;
    const VkDeviceQueueCreateInfo queue_info{.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO,
                                             .queueFamilyIndex = vulkan_.queue_family,
                                             .queueCount = 1,
                                             .pQueuePriorities = &priority};
    const VkDeviceCreateInfo info{.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO,
                                  .pNext = features.chain(),
                                  .queueCreateInfoCount = 1,
                                  .pQueueCreateInfos = &queue_info};
    check(vkCreateDevice(vulkan_.physical_device, &info, nullptr, &vulkan_.device), "vkCreateDevice");
    vkGetDeviceQueue(vulkan_.device, vulkan_.queue_family, 0, &vulkan_.queue);
}

Host::~Host()
{
    vkDestroyDevice(vulkan_.device, nullptr);
    vkDestroyInstance(vulkan_.instance, nullptr);
}

VkDeviceMemory Host::allocate(const VkMemoryRequirements& needs, VkMemoryPropertyFlags wanted) const
{
    VkPhysicalDeviceMemoryProperties properties{};
    vkGetPhysicalDeviceMemoryProperties(vulkan_.physical_device, &properties);
    for (uint32_t type = 0; type < properties.memoryTypeCount; ++type) {
        const bool is_allowed = (needs.memoryTypeBits >> type & 1U) != 0;
        if (is_allowed && (properties.memoryTypes[type].propertyFlags & wanted) == wanted) {
            const VkMemoryAllocateInfo info{.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO,
                                            .allocationSize = needs.size,
                                            .memoryTypeIndex = type};
            VkDeviceMemory memory = VK_NULL_HANDLE;
            check(vkAllocateMemory(vulkan_.device, &info, nullptr, &memory), "vkAllocateMemory");
            return memory;
        }
    }
    throw std::runtime_error("the device has no such memory");
}

Texture::Texture(const Host& host, uint32_t width, uint32_t height)
    : host_(host), width_(width), height_(height)
{
    const VkDevice device = host.vulkan().device;
    const VkImageCreateInfo info{.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO,
                                 .imageType = VK_IMAGE_TYPE_2D,
                                 .format = VK_FORMAT_R8G8B8A8_SRGB,
                                 .extent = {width, height, 1},
                                 .mipLevels = 1,
                                 .arrayLayers = 1,
                                 .samples = VK_SAMPLE_COUNT_1_BIT,
                                 .tiling = VK_IMAGE_TILING_OPTIMAL,
                                 .usage = VK_IMAGE_USAGE_TRANSFER_DST_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT |
                                          VK_IMAGE_USAGE_SAMPLED_BIT};
    check(vkCreateImage(device, &info, nullptr, &image_), "vkCreateImage");
    VkMemoryRequirements needs{};
    vkGetImageMemoryRequirements(device, image_, &needs);
    memory_ = host.allocate(needs, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT);
    check(vkBindImageMemory(device, image_, memory_, 0), "vkBindImageMemory");
}

Texture::~Texture()
{
    vkDestroyImage(host_.vulkan().device, image_, nullptr);
    vkFreeMemory(host_.vulkan().device, memory_, nullptr);
}

std::vector<uint8_t> Texture::read() const
{
    const VkDevice device = host_.vulkan().device;
    const VkDeviceSize size_bytes = VkDeviceSize{4} * width_ * height_;
    const VkBufferCreateInfo buffer_info{.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO,
                                         .size = size_bytes,
                                         .usage = VK_BUFFER_USAGE_TRANSFER_DST_BIT};
    VkBuffer buffer = VK_NULL_HANDLE;
    check(vkCreateBuffer(device, &buffer_info, nullptr, &buffer), "vkCreateBuffer");
    VkMemoryRequirements needs{};
    vkGetBufferMemoryRequirements(device, buffer, &needs);
    VkDeviceMemory memory =
        host_.allocate(needs, VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT);
    check(vkBindBufferMemory(device, buffer, memory, 0), "vkBindBufferMemory");

    const VkCommandPoolCreateInfo pool_info{.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO,
                                            .queueFamilyIndex = host_.vulkan().queue_family};
    VkCommandPool pool = VK_NULL_HANDLE;
    check(vkCreateCommandPool(device, &pool_info, nullptr, &pool), "vkCreateCommandPool");
    const VkCommandBufferAllocateInfo commands_info{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO,
                                                    .commandPool = pool,
                                                    .level = VK_COMMAND_BUFFER_LEVEL_PRIMARY,
                                                    .commandBufferCount = 1};
    VkCommandBuffer commands = VK_NULL_HANDLE;
    check(vkAllocateCommandBuffers(device, &commands_info, &commands), "vkAllocateCommandBuffers");
    const VkCommandBufferBeginInfo begin{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
    check(vkBeginCommandBuffer(commands, &begin), "vkBeginCommandBuffer");
    const VkBufferImageCopy region{.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1},
                                   .imageExtent = {width_, height_, 1}};
    vkCmdCopyImageToBuffer(commands, image_, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, buffer, 1, &region);
    const VkMemoryBarrier for_host{.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER,
                                   .srcAccessMask = VK_ACCESS_TRANSFER_WRITE_BIT,
                                   .dstAccessMask = VK_ACCESS_HOST_READ_BIT};
    vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_PIPELINE_STAGE_HOST_BIT, 0, 1,
                         &for_host, 0, nullptr, 0, nullptr);
    check(vkEndCommandBuffer(commands), "vkEndCommandBuffer");
    const VkSubmitInfo submit{
        .sType = VK_STRUCTURE_TYPE_SUBMIT_INFO, .commandBufferCount = 1, .pCommandBuffers = &commands};
    check(vkQueueSubmit(host_.vulkan().queue, 1, &submit, VK_NULL_HANDLE), "vkQueueSubmit");
    check(vkQueueWaitIdle(host_.vulkan().queue), "vkQueueWaitIdle");

    std::vector<uint8_t> texels(size_bytes);
    void* mapped = nullptr;
    check(vkMapMemory(device, memory, 0, size_bytes, 0, &mapped), "vkMapMemory");
    std::memcpy(texels.data(), mapped, texels.size());
    vkDestroyCommandPool(device, pool, nullptr);
    vkDestroyBuffer(device, buffer, nullptr);
    vkFreeMemory(device, memory, nullptr);
    return texels;
}
