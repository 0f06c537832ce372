// SPDX-License-Identifier: MIT
// Shaders are compiled ahead without touching the graph's own resources.
#include <gtest/gtest.h>

#include "gpu/graph/execute.hpp"
#include "gpu/resources.hpp"
#include "support/gpu_device.hpp"
#include "techniques/raster/paths.hpp"

namespace estampe::gpu {
namespace {

TEST(UseShaders, GoFromTheLastPassToTheFirstAndRunNone)
{
    const std::vector<uint32_t> numbers(64, 5U);
    Buffer target = upload_buffer(test::shared_device(), "target", numbers);
    Graph graph;
    BufferId cleared = import_whole(graph, "target", target);
    for (const char* const name : {"first", "second", "third"}) {
        cleared = raster::add_clear(graph, name, cleared);
    }
    graph.export_buffer(cleared);
    Executor executor(test::shared_device());
    int used = 0;
    executor.use_shaders(graph, [&] { return ++used < 10; });
    EXPECT_EQ(used, static_cast<int>(compile(graph).passes.size()));
    used = 0;
    executor.use_shaders(graph, [&] { return ++used < 2; });
    EXPECT_EQ(used, std::min(2, static_cast<int>(compile(graph).passes.size())));

    Graph read;
    EXPECT_EQ(test::run_and_read_as<uint32_t>(read, import_whole(read, "target", target)), numbers);
    executor.run(graph);
    Graph again;
    EXPECT_EQ(test::run_and_read_as<uint32_t>(again, import_whole(again, "target", target)),
              std::vector<uint32_t>(64, 0U));
}

} // namespace
} // namespace estampe::gpu
