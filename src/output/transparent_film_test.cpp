// SPDX-License-Identifier: MIT
// Films with alpha are decoded by ffmpeg to raw pixels.
#include <estampe/film.hpp>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iterator>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <estampe/error.hpp>

#include "support/folder.hpp"

namespace estampe {
namespace {

constexpr uint32_t side_px = 64;

/// A red disc with a soft edge that moves to the right on a transparent background.
Image disc_at(uint32_t number)
{
    Image image{.width = side_px, .height = side_px};
    for (uint32_t y = 0; y < side_px; ++y) {
        for (uint32_t x = 0; x < side_px; ++x) {
            const double away = std::hypot(x - 16.0 - 6.0 * number, y - 32.0);
            const double alpha = std::clamp(0.25 * (14.0 - away), 0.0, 1.0);
            image.rgba.insert(image.rgba.end(), {200, 40, 30, static_cast<uint8_t>(255.0 * alpha)});
        }
    }
    return image;
}

std::string film_bytes(const std::filesystem::path& path)
{
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

/// Writes a film of `count` frames and decodes it to consecutive red, green, blue and alpha bytes.
std::string film_of(uint32_t count, const std::filesystem::path& path, const std::string& decoder)
{
    FilmWriter film(path, side_px, side_px, 24.0, true);
    for (uint32_t number = 0; number < count; ++number) {
        film.add(disc_at(number));
    }
    film.finish();
    const std::string scratch = path.string() + ".raw";
    const std::string command =
        fmt::format("ffmpeg -nostdin -v error -y {} -i '{}' -pix_fmt rgba -f rawvideo '{}'", decoder,
                    path.string(), scratch);
    EXPECT_EQ(std::system(command.c_str()), 0) << command;
    return film_bytes(scratch);
}

TEST(TransparentFilm, OfVp9HasAPlaneOfAlpha)
{
    const test::Folder folder;
    const std::string pixels = film_of(5, folder / "a.webm", "-c:v libvpx-vp9");
    ASSERT_EQ(pixels.size(), 5U * 4U * side_px * side_px);
    double alpha_off = 0.0;
    double color_off = 0.0;
    size_t solid = 0;
    for (uint32_t number = 0; number < 5; ++number) {
        const Image frame = disc_at(number);
        for (size_t i = 0; i < frame.rgba.size(); i += 4) {
            const size_t at = number * frame.rgba.size() + i;
            alpha_off += std::abs(static_cast<uint8_t>(pixels[at + 3]) - frame.rgba[i + 3]);
            if (frame.rgba[i + 3] == 255) {
                color_off += std::abs(static_cast<uint8_t>(pixels[at]) - frame.rgba[i]);
                ++solid;
            }
        }
    }
    EXPECT_LT(alpha_off / (5.0 * side_px * side_px), 2.0);
    EXPECT_LT(color_off / static_cast<double>(solid), 4.0);
}

TEST(TransparentFilm, OfGifShowsOrHidesEachPixel)
{
    const test::Folder folder;
    const std::string pixels = film_of(5, folder / "a.gif", "");
    ASSERT_EQ(pixels.size(), 5U * 4U * side_px * side_px);
    for (uint32_t number = 0; number < 5; ++number) {
        const Image frame = disc_at(number);
        for (size_t i = 0; i < frame.rgba.size(); i += 4) {
            const auto alpha = static_cast<uint8_t>(pixels[number * frame.rgba.size() + i + 3]);
            const bool is_edge = frame.rgba[i + 3] > 100 && frame.rgba[i + 3] < 156;
            // The next frame must show nothing of the previous one.
            EXPECT_TRUE(is_edge || alpha == (frame.rgba[i + 3] >= 128 ? 255 : 0)) << number << " " << i;
        }
    }
}

TEST(TransparentFilm, CannotBeH264)
{
    const test::Folder folder;
    try {
        FilmWriter(folder / "a.mp4", side_px, side_px, 24.0, true);
        FAIL() << "was taken";
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("write .webm or .gif"), std::string::npos) << error.what();
    }
}

} // namespace
} // namespace estampe
