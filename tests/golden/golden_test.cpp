// SPDX-License-Identifier: MIT
#include "golden.hpp"
#include "support/image_compare.hpp"

#include <chrono>
#include <cstdlib>

#include <fmt/format.h>
#include <gtest/gtest-spi.h>
#include <gtest/gtest.h>
#include <unistd.h>

namespace estampe::test {
namespace {

class GoldenTest : public ::testing::Test {
protected:
    GoldenTest()
    {
        const std::string name = ::testing::UnitTest::GetInstance()->current_test_info()->name();
        root_ =
            std::filesystem::path(::testing::TempDir()) / fmt::format("estampe_golden_{}_{}", name, getpid());
        std::filesystem::remove_all(root_);
        std::filesystem::create_directories(root_ / "golden");
    }

    ~GoldenTest() override { std::filesystem::remove_all(root_); }

    std::optional<std::string> check(const Image& image, const GoldenTolerance& tolerance = {},
                                     bool renew = false)
    {
        return golden_failure(image, "picture", tolerance, {root_ / "golden", root_ / "failures", renew});
    }

    std::filesystem::path golden() const { return root_ / "golden/picture.png"; }

    std::filesystem::path actual() const { return root_ / "failures/picture.actual.png"; }

    std::filesystem::path sheet() const { return root_ / "failures/picture.difference.png"; }

private:
    std::filesystem::path root_;
};

TEST_F(GoldenTest, AMissingPictureFailsAndLeavesTheRender)
{
    const std::optional<std::string> failure = check(flat_image(32, 18, 90));
    ASSERT_TRUE(failure.has_value());
    EXPECT_NE(failure->find("script/goldens"), std::string::npos);
    EXPECT_NE(failure->find(actual().string()), std::string::npos);
    EXPECT_EQ(load_image(actual()), flat_image(32, 18, 90));
    EXPECT_FALSE(std::filesystem::exists(golden()));
}

TEST_F(GoldenTest, TheSamePictureMatchesAndLeavesNothing)
{
    save_png(flat_image(32, 18, 90), golden());
    EXPECT_EQ(check(flat_image(32, 18, 90)), std::nullopt);
    EXPECT_FALSE(std::filesystem::exists(actual().parent_path()));
}

TEST_F(GoldenTest, RoundingPassesAndADriftOfToneFails)
{
    Image rounded = flat_image(64, 36, 128);
    for (size_t i = 0; i < rounded.rgba.size(); i += 40)
        rounded.rgba[i] = 129;
    save_png(flat_image(64, 36, 128), golden());
    EXPECT_EQ(check(rounded), std::nullopt);
    ASSERT_TRUE(check(flat_image(64, 36, 125)).has_value());
    // Below the limit of every channel, but everywhere.
    ASSERT_TRUE(check(flat_image(64, 36, 126)).has_value());
}

TEST_F(GoldenTest, ADifferenceIsShown)
{
    save_png(flat_image(32, 18, 90), golden());
    const std::optional<std::string> failure = check(flat_image(32, 18, 200));
    ASSERT_TRUE(failure.has_value());
    EXPECT_NE(failure->find("110/255"), std::string::npos) << *failure;
    EXPECT_NE(failure->find("================\n"), std::string::npos) << "no heat map in\n" << *failure;
    EXPECT_EQ(load_image(actual()), flat_image(32, 18, 200));
    EXPECT_EQ(load_image(sheet()).height, 18u);
}

TEST_F(GoldenTest, AnotherSizeFails)
{
    save_png(flat_image(32, 18, 90), golden());
    const std::optional<std::string> failure = check(flat_image(33, 18, 90));
    ASSERT_TRUE(failure.has_value());
    EXPECT_NE(failure->find("33 x 18 pixels instead of 32 x 18"), std::string::npos) << *failure;
}

TEST_F(GoldenTest, ALooserToleranceNeedsAReason)
{
    save_png(flat_image(32, 18, 90), golden());
    GoldenTolerance loose{.failing_fraction = 1.0, .delta_e_mean = 5.0, .delta_e_p95 = 5.0};
    const std::optional<std::string> failure = check(flat_image(32, 18, 94), loose);
    ASSERT_TRUE(failure.has_value());
    EXPECT_NE(failure->find("needs a reason"), std::string::npos);
    loose.reason = "the strokes depend on the driver's rounding";
    EXPECT_EQ(check(flat_image(32, 18, 94), loose), std::nullopt);
}

TEST_F(GoldenTest, RenewingWrites)
{
    EXPECT_EQ(check(flat_image(32, 18, 90), {}, true), std::nullopt);
    EXPECT_EQ(load_image(golden()), flat_image(32, 18, 90));
    EXPECT_EQ(check(flat_image(32, 18, 91), {}, true), std::nullopt);
    EXPECT_EQ(load_image(golden()), flat_image(32, 18, 91));
}

TEST_F(GoldenTest, RenewingLeavesAnEqualPictureAlone)
{
    save_png(flat_image(32, 18, 90), golden());
    const auto past = std::filesystem::file_time_type::clock::now() - std::chrono::hours(1);
    std::filesystem::last_write_time(golden(), past);
    EXPECT_EQ(check(flat_image(32, 18, 90), {}, true), std::nullopt);
    EXPECT_EQ(std::filesystem::last_write_time(golden()), past);
}

TEST_F(GoldenTest, TheRunningTestFails)
{
    const std::filesystem::path before = std::filesystem::current_path();
    std::filesystem::current_path(golden().parent_path());
    EXPECT_NONFATAL_FAILURE(expect_matches_golden(flat_image(4, 4, 0), "no such picture"), "script/goldens");
    EXPECT_TRUE(std::filesystem::exists("golden-failures/no such picture.actual.png"));
    std::filesystem::current_path(before);
}

} // namespace
} // namespace estampe::test
