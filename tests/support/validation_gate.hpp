// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <tuple>

#include <gtest/gtest.h>

#include "support/gpu_device.hpp"

namespace estampe::test {

/// Fails the test that caused a validation message, unless the test itself took the message.
class ValidationGate : public testing::EmptyTestEventListener {
public:
    void OnTestStart(const testing::TestInfo& /*test*/) override { std::ignore = take_validation_messages(); }

    void OnTestEnd(const testing::TestInfo& /*test*/) override
    {
        for (const std::string& message : take_validation_messages()) {
            ADD_FAILURE() << "validation: " << message;
        }
    }
};

} // namespace estampe::test
