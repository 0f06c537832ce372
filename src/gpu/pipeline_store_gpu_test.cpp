// SPDX-License-Identifier: MIT
#include "gpu/pipelines.hpp"

#include <cstdlib>
#include <cstring>

#include <gtest/gtest.h>

#include "core/file.hpp"
#include "support/folder.hpp"
#include "support/gpu_device.hpp"

namespace estampe::gpu {
namespace {

PipelineOwner some_owner()
{
    return {.vendor = 1, .device = 2, .driver_version = 3, .uuid = {4, 5, 6}};
}

/// Returns cache data like a driver's: a header that identifies the device and driver, and further bytes.
std::vector<std::byte> pipelines_of(const PipelineOwner& owner)
{
    VkPipelineCacheHeaderVersionOne head{.headerSize = sizeof head,
                                         .headerVersion = VK_PIPELINE_CACHE_HEADER_VERSION_ONE,
                                         .vendorID = owner.vendor,
                                         .deviceID = owner.device};
    std::memcpy(head.pipelineCacheUUID, owner.uuid, sizeof owner.uuid);
    std::vector<std::byte> bytes(sizeof head + 1000, std::byte{7});
    std::memcpy(bytes.data(), &head, sizeof head);
    return bytes;
}

TEST(PipelineStore, ReadsWhatItWrote)
{
    const test::Folder folder;
    const auto file = folder.path() / "below" / "pipelines";
    EXPECT_TRUE(read_pipelines(file, some_owner()).empty());
    const std::vector<std::byte> pipelines = pipelines_of(some_owner());
    write_pipelines(file, pipelines);
    EXPECT_EQ(read_pipelines(file, some_owner()), pipelines);
}

TEST(PipelineStore, IgnoresAFileThatIsBroken)
{
    const test::Folder folder;
    const auto file = folder.path() / "pipelines";
    write_pipelines(file, pipelines_of(some_owner()));
    const std::vector<std::byte> whole = read_file(file);
    for (const size_t at : {size_t{0}, size_t{9}, size_t{17}, size_t{40}, whole.size() - 1}) {
        std::vector<std::byte> changed = whole;
        changed[at] ^= std::byte{1};
        write_file_atomically(file, changed);
        EXPECT_TRUE(read_pipelines(file, some_owner()).empty()) << "byte " << at;
    }
    for (const size_t size : {size_t{0}, size_t{10}, size_t{24}, whole.size() - 1}) {
        write_file_atomically(file, std::span(whole).first(size));
        EXPECT_TRUE(read_pipelines(file, some_owner()).empty()) << size << " bytes";
    }
    write_file_atomically(file, whole);
    EXPECT_FALSE(read_pipelines(file, some_owner()).empty());
}

TEST(PipelineStore, KeepsOwnersApart)
{
    const test::Folder folder;
    const auto file = folder.path() / "pipelines";
    write_pipelines(file, pipelines_of(some_owner()));
    for (const int part : {0, 1, 2, 3}) {
        PipelineOwner other = some_owner();
        (part == 0 ? other.vendor : part == 1 ? other.device : other.driver_version) += part < 3 ? 1 : 0;
        other.uuid[0] = static_cast<uint8_t>(other.uuid[0] + (part == 3 ? 1 : 0));
        EXPECT_NE(pipeline_file(other), pipeline_file(some_owner())) << part;
        if (part != 2) { // The driver's cache header has no field for this part
            EXPECT_TRUE(read_pipelines(file, other).empty()) << part;
        }
    }
}

TEST(PipelineStore, WhatCannotBeWrittenIsNoError)
{
    const test::Folder folder;
    write_file_atomically(folder.path() / "file", std::as_bytes(std::span("x")));
    write_pipelines(folder.path() / "file" / "pipelines", pipelines_of(some_owner()));
    EXPECT_TRUE(read_pipelines(folder.path() / "file" / "pipelines", some_owner()).empty());
}

TEST(PipelineStore, GivesADriverACacheThatIsEmpty)
{
    keep_pipelines(false);
    {
        const PipelineStore store(test::shared_device());
        EXPECT_NE(store.handle(), VkPipelineCache{VK_NULL_HANDLE});
    }
    keep_pipelines(true);
}

} // namespace
} // namespace estampe::gpu
