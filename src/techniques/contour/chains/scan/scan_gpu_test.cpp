// SPDX-License-Identifier: MIT
// Prefix sums of lists by one workgroup and by many, compared with the CPU.
#include "techniques/contour/chains/scan/scan.hpp"

#include <bit>
#include <random>

#include <gtest/gtest.h>

#include "gpu/resources.hpp"
#include "support/gpu_device.hpp"

namespace estampe::contour {
namespace {

struct Summed {
    std::vector<uint32_t> before;
    std::vector<shared::ListSize> sizes;
};

/// Scans a list whose length is half fixed and half another list's; its total becomes the size of a third.
Summed summed(const std::vector<uint32_t>& values, bool is_spread, bool counts_bits, uint32_t capacity)
{
    const auto count = static_cast<uint32_t>(values.size());
    std::vector<shared::ListSize> sizes(shared::list_count);
    sizes[shared::list_points].count = count - count / 2;
    gpu::Device& device = test::shared_device();
    gpu::Buffer size_buffer = gpu::upload_buffer(device, "sizes", sizes);
    std::vector<uint32_t> padded = values;
    padded.resize(std::max<size_t>(values.size(), 1));
    gpu::Buffer value_buffer = gpu::upload_buffer(device, "values", padded);
    gpu::Graph graph;
    const Scanned scanned = add_scan(graph, "list",
                                     {.sizes = gpu::import_whole(graph, "sizes", size_buffer),
                                      .values = gpu::import_whole(graph, "values", value_buffer),
                                      .value_capacity = count,
                                      .is_spread = is_spread,
                                      .constants = {.fixed_count = count / 2,
                                                    .count_of = shared::list_points,
                                                    .total_to = shared::list_samples,
                                                    .capacity = capacity,
                                                    .slots_before = 7,
                                                    .counts_bits = counts_bits ? 1U : 0U}});
    const std::array wanted{scanned.before, scanned.sizes};
    const auto bytes = test::run_and_read(graph, wanted);
    return {test::items_of<uint32_t>(bytes[0]), test::items_of<shared::ListSize>(bytes[1])};
}

TEST(ContourScan, SumsAsTheProcessorDoes)
{
    std::mt19937 random(3);
    for (const uint32_t count : {0U, 1U, 2U, 255U, 256U, 257U, 511U, 4096U, 65537U, 200001U}) {
        std::vector<uint32_t> values(count);
        std::ranges::generate(values, [&] { return static_cast<uint32_t>(random()) & 0xFFFU; });
        for (const bool counts_bits : {false, true}) {
            std::vector<uint32_t> expected{0};
            for (const uint32_t value : values) {
                expected.push_back(expected.back() +
                                   (counts_bits ? static_cast<uint32_t>(std::popcount(value)) : value));
            }
            for (const bool is_spread : {false, true}) {
                const uint32_t capacity = count == 257 ? 100U : 0xFFFFFFFFU;
                Summed result = summed(values, is_spread, counts_bits, capacity);
                result.before.resize(expected.size()); // buffers have at least 16 bytes
                const uint32_t total = std::min(expected.back(), capacity);
                EXPECT_EQ(result.before, expected) << count << (is_spread ? ", spread" : "");
                EXPECT_EQ(result.sizes[shared::list_samples].count, total);
                EXPECT_EQ(result.sizes[shared::list_slots].count, total + 7);
                EXPECT_EQ(result.sizes[shared::list_points].count, count - count / 2);
            }
        }
    }
}

} // namespace
} // namespace estampe::contour
