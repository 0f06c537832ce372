// SPDX-License-Identifier: MIT
#include "core/long_jobs.hpp"

#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include <estampe/error.hpp>

namespace estampe {
namespace {

TEST(ProgressWatch, HearsItsOwnThreadWhileItLives)
{
    report_progress(0.1);
    std::vector<double> heard;
    {
        const ProgressWatch watch([&](double share) {
            heard.push_back(share);
            return share < 0.6;
        });
        report_progress(0.5);
        std::thread([] { report_progress(0.9); }).join();
        EXPECT_THROW(report_progress(0.7), Error);
    }
    report_progress(0.8);
    EXPECT_EQ(heard, (std::vector<double>{0.5, 0.7}));
}

} // namespace
} // namespace estampe
