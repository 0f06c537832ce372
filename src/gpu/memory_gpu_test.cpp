// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <estampe/error.hpp>

#include "gpu/resources.hpp"
#include "support/gpu_device.hpp"

namespace estampe::gpu {
namespace {

constexpr uint64_t mib = 1U << 20U;

std::string refusal_of(uint64_t bytes)
{
    try {
        test::shared_device().memory().require(bytes);
    } catch (const Error& error) {
        return error.what();
    }
    return {};
}

TEST(GraphicsMemory, TooLittleOfItIsSaidBeforeItIsTaken)
{
    EXPECT_EQ(refusal_of(mib), "");
    const std::string message = refusal_of(uint64_t{1} << 60U);
    EXPECT_TRUE(message.starts_with("out of graphics memory: 1073741824.0 GiB more are needed, ")) << message;
    EXPECT_NE(message.find("free; try a smaller --size"), std::string::npos) << message;
}

TEST(GraphicsMemory, WhatIsTakenIsNotFree)
{
    Device device(test::validated());
    uint64_t left = mib;
    const auto has = [&](uint64_t bytes) {
        try {
            device.memory().require(bytes);
            return true;
        } catch (const Error&) {
            return false;
        }
    };
    while (left < uint64_t{1} << 50U && has(2 * left)) {
        left *= 2;
    }
    const uint64_t part = std::min<uint64_t>(left / 4, 100 * mib);
    uint64_t most = left;
    for (uint64_t step = left / 2; step > mib; step /= 2) {
        most += has(most + step) ? step : 0;
    }
    {
        const uint64_t used_before = device.memory().used_bytes();
        const Buffer taken(device, "taken", part, MemoryUse::device);
        const uint64_t used = device.memory().used_bytes() - used_before;
        EXPECT_GE(used, part);
        EXPECT_LT(used, part + mib);
        EXPECT_FALSE(has(most));
        EXPECT_TRUE(has(most - part - 2 * mib));
    }
    EXPECT_TRUE(has(most)) << "and is free again";
}

TEST(GraphicsMemory, OfImages)
{
    EXPECT_EQ(size_bytes({.width = 4, .height = 2, .format = Format::rgba8}), 32U);
    EXPECT_EQ(size_bytes({.width = 4, .height = 2, .format = Format::rgba16f, .layers = 3, .mips = 3}),
              8U * 3U * (8U + 2U + 1U));
}

} // namespace
} // namespace estampe::gpu
