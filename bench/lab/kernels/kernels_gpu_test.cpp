// SPDX-License-Identifier: MIT
#include "lab/kernels/kernels.hpp"

#include <set>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <estampe/error.hpp>

#include "support/gpu_device.hpp"

namespace estampe::lab::kernels {
namespace {

const Entry& entry_of(const std::string& name)
{
    for (const Entry& entry : all_experiments()) {
        if (name == entry.name) {
            return entry;
        }
    }
    throw Error("there is no such experiment", name);
}

class Laboratory : public testing::TestWithParam<Entry> {};

TEST_P(Laboratory, KernelsLeaveWhatTheProcessorFinds)
{
    const ExperimentResult result = run_experiment(test::shared_device(), GetParam(), Effort::check, 1);
    std::set<std::string> names;
    for (const KernelResult& kernel : result.kernels) {
        EXPECT_TRUE(names.insert(kernel.name).second) << kernel.name;
        EXPECT_GT(kernel.ms.median, 0.0) << kernel.name;
        EXPECT_GT(kernel.ratio.median, 0.0) << kernel.name;
    }
    for (const KernelResult& kernel : result.kernels) {
        EXPECT_TRUE(names.contains(kernel.against)) << kernel.against;
        if (kernel.name == kernel.against) {
            EXPECT_DOUBLE_EQ(kernel.ratio.median, 1.0);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(All, Laboratory, testing::ValuesIn(all_experiments()),
                         [](const testing::TestParamInfo<Entry>& entry) {
                             std::string name = entry.param.name;
                             std::erase(name, '-');
                             return name;
                         });

TEST(Laboratory, ThrowsWhenAKernelLeavesAnythingElse)
{
    Entry wrong = entry_of("min");
    wrong.make = [](gpu::Device& device, Effort effort) {
        Experiment made = minima(device, effort);
        made.kernels[1].numbers.a -= 1; // the expected output does not use this changed number
        return made;
    };
    try {
        static_cast<void>(run_experiment(test::shared_device(), wrong, Effort::check, 1));
        FAIL() << "nothing was found wrong";
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("if (x > a) x = a"), std::string::npos) << error.what();
    }
}

KernelsResult small_result()
{
    return {.device = "a device",
            .driver = "a driver",
            .software = false,
            .rounds = 3,
            .experiments = {
                {.name = "reads",
                 .about = "Reads",
                 .kernels = {
                     {.name = "one", .against = "one", .ms = {1, 2, 3}, .ratio = {1, 1, 1}},
                     {.name = "two, really", .against = "one", .ms = {3, 4, 5}, .ratio = {1.5, 2, 2.5}}}}}};
}

TEST(LaboratoryTables, SayAllThatWasMeasured)
{
    const KernelsResult result = small_result();
    const std::string text = text_of(result);
    EXPECT_NE(text.find("a device, a driver"), std::string::npos);
    EXPECT_NE(text.find("two, really     4.000    2.00    1.50    2.50\n"), std::string::npos) << text;
    EXPECT_NE(text.find("one             2.000\n"), std::string::npos) << text;
    const auto json = nlohmann::json::parse(json_of(result));
    EXPECT_EQ(json["experiments"][0]["kernels"][1]["ratio"]["high"], 2.5);
    EXPECT_NE(csv_of(result).find("reads,\"two, really\",\"one\",4,3,5,2,1.5,2.5\n"), std::string::npos);
}

} // namespace
} // namespace estampe::lab::kernels
