// SPDX-License-Identifier: MIT
// Pictures with transparent paper, drawn to an image of the host.
#include <cmath>

#include <gtest/gtest.h>

#include <estampe/shapes.hpp>
#include <estampe/vulkan.hpp>

#include "frame/transparent_test_support.hpp"
#include "gpu/resources.hpp"
#include "support/gpu_device.hpp"
#include "support/scenes.hpp"

namespace estampe {
namespace {

/// A host with a device of its own, an image on it, and a renderer that borrows the device.
class HostPicture : public testing::Test {
protected:
    HostPicture()
    {
        Scene scene = test::scene_of(shapes::box({1.0F, 1.5F, 1.0F}));
        test::add_object(scene, shapes::sphere(0.6F), {0.2F, 0.4F, 0.7F}, glm::dvec3(1.3, 0.6, 0.5));
        test::add_sun(scene, {1.0, 2.0, 1.5});
        renderer_.set_scene(scene);
    }

    Image draw_into(const Style& style)
    {
        renderer_.render_to({.image = image_.handle(), .layout_after = VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL},
                            transparent_camera, style, transparent_page);
        gpu::run_once(device_, [&](VkCommandBuffer commands) {
            const VkBufferImageCopy region{
                .imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1},
                .imageExtent = {transparent_page.width, transparent_page.height, 1}};
            vkCmdCopyImageToBuffer(commands, image_.handle(), VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
                                   bytes_.handle(), 1, &region);
        });
        Image drawn{.width = transparent_page.width, .height = transparent_page.height};
        const auto* const first = reinterpret_cast<const uint8_t*>(bytes_.mapped().data());
        drawn.rgba.assign(first, first + bytes_.size_bytes());
        return drawn;
    }

    Image draw(const Style& style) { return renderer_.render(transparent_camera, style, transparent_page); }

private:
    gpu::Device device_{test::validated()};
    gpu::Image image_{
        device_,
        "host's",
        {.width = transparent_page.width, .height = transparent_page.height, .format = gpu::Format::rgba8}};
    gpu::Buffer bytes_{device_, "read", uint64_t{4} * transparent_page.width* transparent_page.height,
                       gpu::MemoryUse::readback};
    Renderer renderer_{VulkanHost{.instance = volkGetLoadedInstance(),
                                  .physical_device = device_.physical(),
                                  .device = device_.handle(),
                                  .queue = device_.queue(),
                                  .queue_family = device_.queue_family()}};
};

/// Largest difference between `wanted` and `over` blended over one colour with VK_BLEND_FACTOR_SRC_ALPHA.
double difference_over(const glm::dvec3& background, const Image& over, const Image& wanted)
{
    double largest = 0.0;
    for (size_t i = 0; i < over.rgba.size(); ++i) {
        const size_t channel = i % 4;
        if (channel < 3) {
            const double alpha = over.rgba[i - channel + 3] / 255.0;
            const double blended =
                over.rgba[i] * alpha + background[static_cast<int>(channel)] * (1.0 - alpha);
            largest = std::max(largest, std::abs(std::round(blended) - wanted.rgba[i]));
        }
    }
    return largest;
}

TEST_F(HostPicture, StraightAlphaBlendsOverAnyBackground)
{
    const Image over = draw_into(grainless_style({"wash.strength=0", "paper.transparent=paper"}));
    EXPECT_EQ(over, draw(grainless_style({"wash.strength=0", "paper.transparent=paper"})));
    for (const auto& [name, color, bound] :
         {std::tuple("paper.color=#ffffff", glm::dvec3(255.0), 4.0),
          std::tuple("paper.color=#ff0000", glm::dvec3(255.0, 0.0, 0.0), 16.0)}) {
        EXPECT_LE(difference_over(color, over, draw(grainless_style({"wash.strength=0", name}))), bound)
            << name;
    }
    size_t clear = 0;
    size_t inked = 0;
    for (size_t i = 3; i < over.rgba.size(); i += 4) {
        clear += over.rgba[i] == 0 ? 1 : 0;
        inked += over.rgba[i] > 100 ? 1 : 0;
    }
    EXPECT_GT(clear, over.rgba.size() / 4 / 2);
    EXPECT_GT(inked, 100U);
}

TEST_F(HostPicture, ThingsCoverTheBackground)
{
    const Image over = draw_into(grainless_style({"paper.transparent=background"}));
    EXPECT_LE(difference_over({0xf6, 0xf0, 0xe2}, over, draw(grainless_style({}))), 1.0) << "its own paper";
    EXPECT_EQ(over.rgba[3], 0) << "a corner";
    const size_t middle =
        4 * (transparent_page.height / 2 * size_t{transparent_page.width} + transparent_page.width / 2);
    EXPECT_EQ(over.rgba[middle + 3], 255) << "the box";
}

TEST_F(HostPicture, IsOpaqueOtherwise)
{
    const Image opaque = draw_into(grainless_style({}));
    EXPECT_EQ(opaque, draw(grainless_style({})));
    for (size_t i = 3; i < opaque.rgba.size(); i += 4) {
        ASSERT_EQ(opaque.rgba[i], 255);
    }
}

} // namespace
} // namespace estampe
