// SPDX-License-Identifier: MIT
// Runs the tests that draw. A validation message fails the test that caused it; so does the lack of a device.
#include <cstdio>

#include <gtest/gtest.h>

#include "support/gpu_device.hpp"

namespace {

class ValidationGate : public testing::EmptyTestEventListener {
    void OnTestStart(const testing::TestInfo& /*test*/) override { std::ignore = estampe::test::take_validation_messages(); }

    void OnTestEnd(const testing::TestInfo& /*test*/) override
    {
        for (const std::string& message : estampe::test::take_validation_messages()) {
            ADD_FAILURE() << "validation: " << message;
        }
    }
};

} // namespace

int main(int argc, char** argv)
{
    testing::InitGoogleTest(&argc, argv);
    testing::UnitTest::GetInstance()->listeners().Append(new ValidationGate);
    if (!testing::GTEST_FLAG(list_tests)) {
        const auto& info = estampe::test::shared_device().info();
        std::printf("drawing on %s, %s\n", info.name.c_str(), info.driver.c_str());
    }
    return RUN_ALL_TESTS();
}
