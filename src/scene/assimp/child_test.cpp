// SPDX-License-Identifier: MIT
#include "scene/assimp/child.hpp"

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <thread>

#include <gtest/gtest.h>
#include <unistd.h>

#include <estampe/error.hpp>

namespace estampe {
namespace {

using Bytes = std::vector<std::byte>;

std::string error_of_child(const std::function<Bytes()>& work, const ChildLimits& limits = {})
{
    try {
        (void)run_in_child(work, limits, "somewhere.obj");
    } catch (const Error& error) {
        EXPECT_EQ(error.where(), "somewhere.obj");
        return error.what();
    }
    return "no error";
}

TEST(Child, ReturnsWhatTheWorkReturned)
{
    Bytes large(5'000'000);
    for (size_t i = 0; i < large.size(); ++i)
        large[i] = static_cast<std::byte>(i % 251);
    EXPECT_EQ(run_in_child([&large] { return large; }, {}, ""), large);
    EXPECT_TRUE(run_in_child([] { return Bytes{}; }, {}, "").empty());
}

TEST(Child, ChangesNothingHere)
{
    int value = 1;
    (void)run_in_child(
        [&value] {
            value = 2;
            return Bytes{};
        },
        {}, "");
    EXPECT_EQ(value, 1);
}

TEST(Child, CrashIsAnError)
{
    EXPECT_NE(error_of_child([]() -> Bytes {
                  (void)raise(SIGSEGV);
                  return {};
              }).find("crashed (signal 11)"),
              std::string::npos);
    EXPECT_NE(error_of_child([]() -> Bytes { std::abort(); }).find("crashed"), std::string::npos);
}

TEST(Child, SilentEndIsAnError)
{
    EXPECT_NE(error_of_child([]() -> Bytes { _exit(0); }).find("without a word"), std::string::npos);
    EXPECT_NE(error_of_child([]() -> Bytes { _exit(7); }).find("without a word"), std::string::npos);
}

TEST(Child, ExceptionKeepsItsWordsInOneLine)
{
    EXPECT_NE(error_of_child([]() -> Bytes { throw std::runtime_error("too\nodd"); }).find("too odd"),
              std::string::npos);
    EXPECT_NE(error_of_child([]() -> Bytes { throw std::bad_alloc(); }).find("more memory"),
              std::string::npos);
}

TEST(Child, HangIsEnded)
{
    const auto start = std::chrono::steady_clock::now();
    const std::string error = error_of_child(
        []() -> Bytes {
            while (true)
                std::this_thread::sleep_for(std::chrono::milliseconds(10));
        },
        {.wall_s = 0.2});
    EXPECT_NE(error.find("too long"), std::string::npos);
    EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(10));
}

TEST(Child, BusyHangIsEndedByItsProcessorTime)
{
    const std::string error = error_of_child(
        []() -> Bytes {
            for (volatile int spin = 0;;)
                spin = 1 - spin;
        },
        {.wall_s = 60.0, .cpu_s = 1});
    EXPECT_NE(error.find("too long"), std::string::npos);
}

} // namespace
} // namespace estampe
