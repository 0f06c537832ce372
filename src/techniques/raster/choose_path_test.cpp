// SPDX-License-Identifier: MIT
#include "techniques/raster/paths.hpp"

#include <gtest/gtest.h>

#include <estampe/error.hpp>

namespace estampe::raster {
namespace {

using enum RasterPath;

const DeviceInfo gpu{.name = "a GPU"};
const DeviceInfo processor{.name = "a processor", .software = true};
const DeviceInfo plain_gpu{.name = "a plain GPU", .compute_raster = false};
const DeviceInfo plain_processor{.name = "a plain processor", .software = true, .compute_raster = false};

TEST(ChoosePath, WhatIsWantedIsTaken)
{
    for (const RasterPath wanted : {hardware, compute}) {
        EXPECT_EQ(settled_path(gpu, wanted), wanted);
        EXPECT_EQ(settled_path(processor, wanted), wanted);
    }
    EXPECT_EQ(settled_path(plain_gpu, hardware), hardware);
}

TEST(ChoosePath, OnlyWhereBothArePossibleOnAGpuIsThereAnythingToMeasure)
{
    EXPECT_EQ(settled_path(gpu, automatic), std::nullopt);
    EXPECT_EQ(settled_path(processor, automatic), hardware);
    EXPECT_EQ(settled_path(plain_gpu, automatic), hardware);
}

TEST(ChoosePath, AProcessorDrawsSmallTrianglesInComputeWhereItIsFreeTo)
{
    const PageWork dense{.triangles = 1000, .pixels = 8000};
    const Paths by_hardware{.page = hardware, .maps = hardware};
    EXPECT_EQ(paths_of(processor, automatic, hardware, dense), (Paths{.page = compute, .maps = hardware}));
    EXPECT_EQ(paths_of(processor, automatic, hardware, {.triangles = 1000, .pixels = 8001}), by_hardware);
    EXPECT_EQ(paths_of(processor, automatic, hardware, {.triangles = 1000, .pixels = 10, .has_masks = true}),
              by_hardware);
    EXPECT_EQ(paths_of(processor, hardware, hardware, dense), by_hardware);
    EXPECT_EQ(paths_of(plain_processor, automatic, hardware, dense), by_hardware);
    EXPECT_EQ(paths_of(gpu, automatic, hardware, dense), by_hardware);
}

TEST(ChoosePath, WhatIsImpossibleIsRefused)
{
    try {
        std::ignore = settled_path(plain_gpu, compute);
        FAIL() << "nothing was thrown";
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("a plain GPU"), std::string::npos) << error.what();
        EXPECT_NE(std::string(error.what()).find("64-bit buffer atomics"), std::string::npos);
    }
}

} // namespace
} // namespace estampe::raster
