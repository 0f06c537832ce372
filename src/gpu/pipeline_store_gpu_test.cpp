// SPDX-License-Identifier: MIT
#include "gpu/pipelines.hpp"

#include <cstdlib>
#include <filesystem>
#include <span>
#include <string>

#include <gtest/gtest.h>

#include "support/folder.hpp"
#include "support/gpu_device.hpp"

namespace estampe::gpu {
namespace {

TEST(PipelineStore, APoisonedFileIsNotedAndReplaced)
{
    const test::Folder folder;
    const std::string before = std::getenv("XDG_CACHE_HOME") != nullptr ? std::getenv("XDG_CACHE_HOME") : "";
    setenv("XDG_CACHE_HOME", folder.path().c_str(), 1);
    const auto file = pipeline_file(owner_of(test::shared_device().physical()));
    write_pipelines(file, std::as_bytes(std::span("of no driver")));
    {
        const PipelineStore store(test::shared_device());
        EXPECT_NE(store.note().find("is of another device or driver"), std::string::npos) << store.note();
        EXPECT_FALSE(std::filesystem::exists(file));
    }
    {
        const PipelineStore store(test::shared_device());
        EXPECT_EQ(store.note(), "");
    }
    before.empty() ? unsetenv("XDG_CACHE_HOME") : setenv("XDG_CACHE_HOME", before.c_str(), 1);
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
