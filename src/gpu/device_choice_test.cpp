// SPDX-License-Identifier: MIT
#include "gpu/device.hpp"

#include <gtest/gtest.h>

namespace estampe::gpu {
namespace {

void offer_all_needed(Features& have)
{
    have.v13.synchronization2 = VK_TRUE;
    have.v13.dynamicRendering = VK_TRUE;
    have.v13.maintenance4 = VK_TRUE;
    have.v12.scalarBlockLayout = VK_TRUE;
    have.v12.hostQueryReset = VK_TRUE;
    have.core.features.shaderStorageImageExtendedFormats = VK_TRUE;
    have.core.features.shaderClipDistance = VK_TRUE;
}

TEST(DeviceChoice, SixtyFourBitAtomicsAreNotNeeded)
{
    Features have;
    offer_all_needed(have);
    EXPECT_EQ(missing_features(have), "");
    EXPECT_FALSE(offers_compute_raster(have));
    have.v12.shaderBufferInt64Atomics = VK_TRUE;
    EXPECT_FALSE(offers_compute_raster(have)) << "the shaders also need 64-bit integers";
    have.core.features.shaderInt64 = VK_TRUE;
    EXPECT_TRUE(offers_compute_raster(have));
}

TEST(DeviceChoice, WhatIsMissingIsNamed)
{
    Features have;
    offer_all_needed(have);
    have.v13.dynamicRendering = VK_FALSE;
    have.v12.scalarBlockLayout = VK_FALSE;
    EXPECT_EQ(missing_features(have), "dynamic rendering, scalar block layout");
}

} // namespace
} // namespace estampe::gpu
