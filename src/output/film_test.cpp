// SPDX-License-Identifier: MIT
// Films are decoded by ffmpeg to raw pixels.
#include <estampe/film.hpp>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>

#include <fmt/format.h>
#include <glm/glm.hpp>
#include <gtest/gtest.h>

#include <estampe/error.hpp>

#include "support/folder.hpp"

namespace estampe {
namespace {

constexpr glm::uvec2 size_px(64, 48);

/// A soft ball on paper that moves to the right.
Image ball_at(uint32_t number, glm::uvec2 size = size_px)
{
    Image image{.width = size.x, .height = size.y};
    for (uint32_t y = 0; y < size.y; ++y) {
        for (uint32_t x = 0; x < size.x; ++x) {
            const double away = std::hypot(x - 10.0 - 4.0 * number, y - 24.0);
            const auto ink = static_cast<uint8_t>(220.0 * std::exp(-away * away / 80.0));
            image.rgba.insert(image.rgba.end(),
                              {static_cast<uint8_t>(250 - ink), static_cast<uint8_t>(240 - ink),
                               static_cast<uint8_t>(225 - ink / 2), 255});
        }
    }
    return image;
}

void write_film(const std::filesystem::path& path, uint32_t count, glm::uvec2 size = size_px)
{
    FilmWriter film(path, size.x, size.y, 24.0);
    for (uint32_t number = 0; number < count; ++number) {
        film.add(ball_at(number, size));
    }
    film.finish();
}

std::string bytes_of(const std::filesystem::path& path)
{
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

/// Decodes all frames of a film to consecutive red, green and blue bytes.
std::string pixels_of(const std::filesystem::path& film, const std::filesystem::path& scratch)
{
    const std::string command =
        fmt::format("ffmpeg -nostdin -v error -y -i '{}' -pix_fmt rgb24 -f rawvideo '{}'", film.string(),
                    scratch.string());
    EXPECT_EQ(std::system(command.c_str()), 0) << command;
    return bytes_of(scratch);
}

class Film : public testing::TestWithParam<const char*> {};

TEST_P(Film, ShowsItsFramesInTheirOrder)
{
    const test::Folder folder;
    const auto path = folder / (std::string("a: ball") + GetParam());
    constexpr uint32_t count = 9;
    write_film(path, count);
    const std::string pixels = pixels_of(path, folder.path() / "pixels");
    constexpr size_t frame_bytes = 3ULL * size_px.x * size_px.y;
    ASSERT_EQ(pixels.size(), count * frame_bytes);
    for (uint32_t number = 0; number < count; ++number) {
        const Image expected = ball_at(number);
        double difference = 0.0;
        for (size_t i = 0; i < frame_bytes; ++i) {
            const auto shown = static_cast<uint8_t>(pixels[number * frame_bytes + i]);
            difference += std::abs(shown - expected.rgba[i / 3 * 4 + i % 3]);
        }
        EXPECT_LT(difference / frame_bytes, 2.5) << "frame " << number;
    }
}

TEST_P(Film, IsTheSameBytesEachTime)
{
    const test::Folder folder;
    write_film(folder.path() / (std::string("one") + GetParam()), 5);
    write_film(folder.path() / (std::string("two") + GetParam()), 5);
    const std::string one = bytes_of(folder.path() / (std::string("one") + GetParam()));
    EXPECT_GT(one.size(), 200U);
    EXPECT_TRUE(one == bytes_of(folder.path() / (std::string("two") + GetParam())));
}

INSTANTIATE_TEST_SUITE_P(Kinds, Film, testing::Values(".mp4", ".webm", ".gif"));

TEST(FilmSize, OddSidesAreMadeEvenByTheirLastPixels)
{
    const test::Folder folder;
    const auto path = folder.path() / "odd.mp4";
    write_film(path, 2, {63, 47});
    const std::string pixels = pixels_of(path, folder.path() / "pixels");
    ASSERT_EQ(pixels.size(), 2ULL * 3 * 64 * 48);
    for (const size_t last : {size_t{3} * 63, size_t{3} * 64 * 47}) {
        EXPECT_NEAR(static_cast<uint8_t>(pixels[last]), 250, 6);
    }
}

TEST(FilmErrors, AreToldInWords)
{
    const test::Folder folder;
    const auto message = [](const auto& act) {
        try {
            act();
        } catch (const Error& error) {
            return std::string(error.what());
        }
        return std::string("none");
    };
    const auto path = folder.path() / "film.mp4";
    EXPECT_NE(
        message([&] { FilmWriter(folder.path() / "film.avi", 8, 8, 24.0); }).find(".mp4, .webm or .gif"),
        std::string::npos);
    EXPECT_NE(message([&] { FilmWriter(path, 8, 0, 24.0); }).find("without a size"), std::string::npos);
    EXPECT_NE(message([&] { FilmWriter(path, 8, 8, 0.0); }).find("0.1 to 1000"), std::string::npos);
    EXPECT_NE(message([&] { FilmWriter(path, 8, 8, 24.0).finish(); }).find("without frames"),
              std::string::npos);
    EXPECT_NE(message([&] { FilmWriter(path, 8, 8, 24.0).add(ball_at(0)); }).find("64 x 48"),
              std::string::npos);
    EXPECT_TRUE(std::filesystem::is_empty(folder.path())) << "nothing half done stays";

    const std::string search = std::getenv("PATH");
    setenv("PATH", folder.path().c_str(), 1);
    EXPECT_NE(message([&] { FilmWriter(path, 8, 8, 24.0); }).find("install"), std::string::npos);
    // A program that fails like ffmpeg on a full disk.
    std::ofstream(folder.path() / "ffmpeg") << "#!/bin/sh\necho 'No space left on device' >&2\nexit 1\n";
    std::filesystem::permissions(folder.path() / "ffmpeg", std::filesystem::perms::owner_all);
    const auto give_up = [&] {
        FilmWriter film(path, size_px.x, size_px.y, 24.0);
        for (uint32_t number = 0; number < 200; ++number) {
            film.add(ball_at(number));
        }
        film.finish();
    };
    EXPECT_NE(message(give_up).find("No space left"), std::string::npos);
    setenv("PATH", search.c_str(), 1);
}

} // namespace
} // namespace estampe
