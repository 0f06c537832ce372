// SPDX-License-Identifier: MIT
#include "common/command_line.hpp"

#include <sstream>

#include <estampe/error.hpp>
#include <gtest/gtest.h>

namespace estampe::bench {
namespace {

bool is_size(const std::string& text)
{
    Size size;
    std::istringstream stream(text);
    return static_cast<bool>(stream >> size);
}

TEST(BenchCommandLine, SizesAreTwoSidesOfPixels)
{
    Size size;
    std::istringstream("64x36") >> size;
    EXPECT_EQ(size.width, 64U);
    EXPECT_EQ(size.height, 36U);
    EXPECT_TRUE(is_size("65535x1"));
    for (const char* const wrong : {"", "64", "64x", "x36", "0x36", "64x0", "-1x36", "65536x36", "64*36"}) {
        EXPECT_FALSE(is_size(wrong)) << wrong;
    }
}

/// Exit status of a program that takes --device and --only, and what it says.
std::pair<int, std::string> run_with(std::vector<std::string> words, const std::function<void()>& measure)
{
    CLI::App app("A test", "measures");
    std::string device = "auto";
    std::string only;
    add_device_option(app, device);
    app.add_option("--only", only)->check(one_of("series", {"lamps", "cloth"}));
    words.insert(words.begin(), "measures");
    std::vector<char*> pointers;
    for (std::string& word : words) {
        pointers.push_back(word.data());
    }
    testing::internal::CaptureStderr();
    const int status = run(app, static_cast<int>(pointers.size()), pointers.data(), measure);
    return {status, testing::internal::GetCapturedStderr()};
}

TEST(BenchCommandLine, StatusSaysWhatWentWrong)
{
    const auto nothing = [] {};
    EXPECT_EQ(run_with({"--device", "3", "--only", "cloth"}, nothing), std::pair(0, std::string()));
    const auto [unknown, unknown_text] = run_with({"--only", "lumps"}, nothing);
    EXPECT_EQ(unknown, 2);
    EXPECT_NE(unknown_text.find("there is no series \"lumps\"; there are lamps, cloth"), std::string::npos)
        << unknown_text;
    EXPECT_NE(unknown_text.find("see measures --help\n"), std::string::npos) << unknown_text;
    EXPECT_EQ(run_with({"--device", "gpu"}, nothing).first, 2);
    EXPECT_EQ(run_with({"--device", ""}, nothing).first, 2);
    const auto [failed, failed_text] = run_with({}, [] { throw Error("broke", "a\nfile"); });
    EXPECT_EQ(failed, 1);
    EXPECT_TRUE(failed_text.starts_with("measures: error: ")) << failed_text;
    EXPECT_EQ(std::ranges::count(failed_text, '\n'), 1) << failed_text;
    EXPECT_EQ(run_with({}, [] { throw CLI::ValidationError("--only", "contradicts"); }).first, 2);
}

} // namespace
} // namespace estampe::bench
