// SPDX-License-Identifier: MIT
// Runs the tests that draw. A validation message fails the test that caused it, and so does a missing device.
// Messages at the destruction of the device, such as about leaked objects, fail the program.
#include <cstdio>

#include <gtest/gtest.h>

#include "support/gpu_device.hpp"
#include "support/validation_gate.hpp"

int main(int argc, char** argv)
{
    testing::InitGoogleTest(&argc, argv);
    if (testing::GTEST_FLAG(list_tests)) {
        return RUN_ALL_TESTS();
    }
    testing::UnitTest::GetInstance()->listeners().Append(new estampe::test::ValidationGate);
    const auto& info = estampe::test::shared_device().info();
    std::printf("drawing on %s, %s\n", info.name.c_str(), info.driver.c_str());
    int result = RUN_ALL_TESTS();
    estampe::test::destroy_shared();
    for (const std::string& message : estampe::test::take_validation_messages()) {
        std::printf("validation at the end: %s\n", message.c_str());
        result = 1;
    }
    return result;
}
