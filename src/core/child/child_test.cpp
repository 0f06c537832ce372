// SPDX-License-Identifier: MIT
#include "core/child/child.hpp"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <stop_token>
#include <string>
#include <thread>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/mman.h>
#include <unistd.h>

#include <estampe/error.hpp>

#include "core/long_jobs.hpp"

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

TEST(Child, HangAfterThePipeIsClosedIsEnded)
{
    const auto start = std::chrono::steady_clock::now();
    const std::string error = error_of_child([]() -> Bytes {
        for (int file = 0; file < 64; ++file)
            close(file);
        while (true)
            std::this_thread::sleep_for(std::chrono::milliseconds(10));
    });
    EXPECT_NE(error.find("without a word"), std::string::npos);
    EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(20));
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

TEST(Child, ErrorKeepsItsMessagePlaceAndRemedy)
{
    const Error sent("is broken", "a.gltf#/meshes/0", "mend it");
    try {
        (void)run_in_child([&sent]() -> Bytes { throw sent; }, {}, "a.gltf");
        FAIL();
    } catch (const Error& error) {
        EXPECT_STREQ(error.what(), sent.what());
        EXPECT_EQ(error.where(), sent.where());
        EXPECT_EQ(error.remedy(), sent.remedy());
    }
    try {
        (void)run_in_child([]() -> Bytes { throw Error("has no remedy", "b.obj"); }, {}, "a.gltf");
        FAIL();
    } catch (const Error& error) {
        EXPECT_STREQ(error.what(), "b.obj: has no remedy");
    }
}

TEST(Child, ProgressIsReportedHere)
{
    std::vector<double> shares;
    const ProgressWatch watch([&shares](double share) {
        shares.push_back(share);
        return true;
    });
    const auto work = [] {
        report_progress(0.25);
        report_progress(0.75);
        return Bytes{};
    };
    (void)run_in_child(work, {}, "");
    ASSERT_NE(std::ranges::find(shares, 0.25), shares.end());
    EXPECT_EQ(shares.back(), 0.75);
}

TEST(Child, IsEndedWhenItsResultIsNotWantedAnyMore)
{
    const auto start = std::chrono::steady_clock::now();
    const ProgressWatch watch([](double) { return false; });
    EXPECT_THROW((void)run_in_child(
                     []() -> Bytes {
                         std::this_thread::sleep_for(std::chrono::seconds(60));
                         return {};
                     },
                     {}, ""),
                 Error);
    EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(20));
}

#if !defined(__SANITIZE_THREAD__) // with which a fork of several threads cannot start another
TEST(Child, StartsThreadsAlsoIfThisProcessHasSeveral)
{
    const std::jthread other([](const std::stop_token& stop) {
        while (!stop.stop_requested())
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
    });
    const auto work = [] {
        Bytes bytes;
        std::thread([&bytes] { bytes.push_back(std::byte{7}); }).join();
        return bytes;
    };
    EXPECT_EQ(run_in_child(work, {}, ""), Bytes{std::byte{7}});
}
#endif

TEST(Child, SharesNoMemoryAndNoOpenFile)
{
    auto* const shared = static_cast<volatile int*>(
        mmap(nullptr, sizeof(int), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0));
    ASSERT_NE(shared, MAP_FAILED);
    *shared = 1;
    const auto error = error_of_child([shared] {
        *shared = 2;
        return Bytes{};
    });
    EXPECT_NE(error, "no error");
    EXPECT_EQ(*shared, 1);
    munmap(const_cast<int*>(shared), sizeof(int));

    std::FILE* const file = std::tmpfile();
    const int number = fileno(file);
    const auto seek_in_it = [number] { return int64_t{lseek(number, 0, SEEK_END)}; };
    EXPECT_EQ(seek_in_it(), 0);
    EXPECT_EQ(run_in_child(seek_in_it, {}, ""), -1);
    std::fclose(file);
}

TEST(Child, ResultThatEndsEarlyOrLiesIsAnError)
{
    const auto error_of_bytes = [](const std::function<void(ByteWriter&)>& send_result) {
        Bytes received;
        try {
            child::run([&]() -> child::Send { return send_result; },
                       [&](ByteReader& reader) { receive(reader, received); }, {}, "lie.obj");
        } catch (const Error& error) {
            return std::string(error.what());
        }
        return std::string("no error");
    };
    EXPECT_EQ(error_of_bytes([](ByteWriter& writer) { send(writer, uint64_t{1} << 62U); }),
              "lie.obj: what was read from it came back damaged");
    EXPECT_NE(error_of_bytes([](ByteWriter& writer) {
                  send(writer, uint64_t{1000});
                  writer.flush();
                  _exit(0);
              }).find("without a word"),
              std::string::npos);
    EXPECT_NE(error_of_bytes([](ByteWriter& writer) {
                  send(writer, uint64_t{1000});
                  (void)raise(SIGSEGV);
              }).find("crashed (signal 11)"),
              std::string::npos);
}

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__) // which map terabytes by themselves
TEST(Child, MemoryHogIsAnError)
{
    const auto hog = []() -> Bytes {
        Bytes bytes;
        while (true)
            bytes.resize(bytes.size() + (size_t{16} << 20U), std::byte{1});
    };
    EXPECT_NE(error_of_child(hog, {.memory_bytes = uint64_t{256} << 20U}).find("more memory"),
              std::string::npos);
}
#endif

} // namespace
} // namespace estampe
