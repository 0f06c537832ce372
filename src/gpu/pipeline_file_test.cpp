// SPDX-License-Identifier: MIT
#include "gpu/pipelines.hpp"

#include <cstring>
#include <filesystem>

#include <sys/stat.h>

#include <gtest/gtest.h>

#include "core/file.hpp"
#include "support/folder.hpp"

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

TEST(PipelineFile, ReadsWhatItWrote)
{
    const test::Folder folder;
    const auto file = folder.path() / "below" / "pipelines";
    EXPECT_TRUE(read_pipelines(file, some_owner()).bytes.empty());
    EXPECT_EQ(read_pipelines(file, some_owner()).note, "") << "a file that does not exist yet is no fault";
    const std::vector<std::byte> pipelines = pipelines_of(some_owner());
    write_pipelines(file, pipelines);
    EXPECT_EQ(read_pipelines(file, some_owner()).bytes, pipelines);
    EXPECT_EQ(read_pipelines(file, some_owner()).note, "");
}

TEST(PipelineFile, IgnoresAFileThatIsBroken)
{
    const test::Folder folder;
    const auto file = folder.path() / "pipelines";
    write_pipelines(file, pipelines_of(some_owner()));
    const std::vector<std::byte> whole = read_file(file);
    for (const size_t at : {size_t{0}, size_t{9}, size_t{17}, size_t{40}, whole.size() - 1}) {
        std::vector<std::byte> changed = whole;
        changed[at] ^= std::byte{1};
        write_file_atomically(file, changed);
        const StoredPipelines read = read_pipelines(file, some_owner());
        EXPECT_TRUE(read.bytes.empty()) << "byte " << at;
        EXPECT_NE(read.note.find("is truncated or changed; it is ignored"), std::string::npos) << read.note;
        EXPECT_FALSE(std::filesystem::exists(file)) << "so that it is written again";
    }
    for (const size_t size : {size_t{0}, size_t{10}, size_t{24}, whole.size() - 1}) {
        write_file_atomically(file, std::span(whole).first(size));
        const StoredPipelines read = read_pipelines(file, some_owner());
        EXPECT_TRUE(read.bytes.empty()) << size << " bytes";
        EXPECT_NE(read.note.find("is truncated or changed"), std::string::npos) << read.note;
    }
    write_file_atomically(file, whole);
    EXPECT_FALSE(read_pipelines(file, some_owner()).bytes.empty());
}

TEST(PipelineFile, KeepsOwnersApart)
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
            const StoredPipelines read = read_pipelines(file, other);
            EXPECT_TRUE(read.bytes.empty()) << part;
            EXPECT_NE(read.note.find("is of another device or driver"), std::string::npos) << read.note;
            write_pipelines(file, pipelines_of(some_owner()));
        }
    }
}

TEST(PipelineFile, UsesNoFolderIntoWhichOthersWrite)
{
    const test::Folder folder;
    const auto cache = folder.path() / "cache";
    const auto file = cache / "pipelines";
    const mode_t before = umask(0);
    write_pipelines(file, pipelines_of(some_owner()));
    umask(before);
    EXPECT_EQ(std::filesystem::status(cache).permissions(), std::filesystem::perms(0700));
    for (const int mode : {0770, 0707, 0777, 0720, 0702}) {
        std::filesystem::permissions(cache, std::filesystem::perms(mode));
        const StoredPipelines read = read_pipelines(file, some_owner());
        EXPECT_TRUE(read.bytes.empty()) << mode;
        EXPECT_NE(read.note.find("is writable by other users"), std::string::npos) << read.note;
        EXPECT_TRUE(std::filesystem::exists(file)) << "a file of others is left alone";
        write_pipelines(file, pipelines_of({.vendor = 9}));
    }
    std::filesystem::permissions(cache, std::filesystem::perms(0755));
    EXPECT_EQ(read_pipelines(file, some_owner()).bytes, pipelines_of(some_owner())) << "none was written";
}

TEST(PipelineFile, FollowsNoLinks)
{
    const test::Folder folder;
    const auto file = folder.path() / "pipelines";
    const auto elsewhere = folder.path() / "elsewhere";
    write_pipelines(elsewhere / "pipelines", pipelines_of(some_owner()));
    std::filesystem::create_symlink(elsewhere / "pipelines", file);
    const StoredPipelines read = read_pipelines(file, some_owner());
    EXPECT_TRUE(read.bytes.empty());
    EXPECT_NE(read.note.find("is no regular file"), std::string::npos) << read.note;
    EXPECT_TRUE(std::filesystem::exists(elsewhere / "pipelines"));
    std::filesystem::create_directory_symlink(elsewhere, folder.path() / "linked");
    const StoredPipelines linked = read_pipelines(folder.path() / "linked" / "pipelines", some_owner());
    EXPECT_TRUE(linked.bytes.empty());
    EXPECT_NE(linked.note.find("is no folder"), std::string::npos) << linked.note;
}

TEST(PipelineFile, WhatCannotBeWrittenIsNoError)
{
    const test::Folder folder;
    write_file_atomically(folder.path() / "file", std::as_bytes(std::span("x")));
    write_pipelines(folder.path() / "file" / "pipelines", pipelines_of(some_owner()));
    EXPECT_TRUE(read_pipelines(folder.path() / "file" / "pipelines", some_owner()).bytes.empty());
}

} // namespace
} // namespace estampe::gpu
