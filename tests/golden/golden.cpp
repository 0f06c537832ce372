// SPDX-License-Identifier: MIT
#include "golden.hpp"

#include <algorithm>
#include <cstdlib>
#include <string_view>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "../support/image_compare.hpp"
#include "support/files.hpp"

namespace estampe::test {

namespace {

bool is_looser_than_default(const GoldenTolerance& tolerance)
{
    const GoldenTolerance usual;
    return tolerance.channel_limit > usual.channel_limit ||
           tolerance.failing_fraction > usual.failing_fraction ||
           tolerance.delta_e_mean > usual.delta_e_mean || tolerance.delta_e_p95 > usual.delta_e_p95;
}

bool is_within(const ImageDifference& difference, const GoldenTolerance& tolerance)
{
    return difference.failing_fraction <= tolerance.failing_fraction &&
           difference.delta_e_mean <= tolerance.delta_e_mean &&
           difference.delta_e_p95 <= tolerance.delta_e_p95;
}

void renew(const Image& image, const std::filesystem::path& path)
{
    const bool is_new = !std::filesystem::exists(path);
    if (!is_new && load_image(path) == image)
        return;
    std::filesystem::create_directories(path.parent_path());
    save_png(image, path);
    fmt::print("{} {}: look at it before you commit it\n", is_new ? "wrote" : "renewed", path.string());
}

} // namespace

Image sheet_of(const std::vector<Image>& tiles, uint32_t columns)
{
    const uint32_t tile_width = tiles.front().width;
    const uint32_t tile_height = tiles.front().height;
    const uint32_t rows = static_cast<uint32_t>(tiles.size()) / columns;
    Image sheet{.width = columns * tile_width, .height = rows * tile_height};
    sheet.rgba.resize(4ULL * sheet.width * sheet.height);
    for (uint32_t tile = 0; tile < tiles.size(); ++tile) {
        for (uint32_t y = 0; y < tile_height; ++y) {
            const auto from = tiles[tile].rgba.begin() + static_cast<std::ptrdiff_t>(4ULL * y * tile_width);
            const size_t row = static_cast<size_t>(tile / columns) * tile_height + y;
            const size_t to = 4 * (row * sheet.width + static_cast<size_t>(tile % columns) * tile_width);
            std::copy(from, from + 4 * tile_width, sheet.rgba.begin() + static_cast<std::ptrdiff_t>(to));
        }
    }
    return sheet;
}

std::optional<std::string> golden_failure(const Image& image, const std::string& name,
                                          const GoldenTolerance& tolerance, const GoldenFolders& folders)
{
    if (is_looser_than_default(tolerance) && tolerance.reason.empty())
        return fmt::format("golden picture '{}': a tolerance looser than the default needs a reason", name);
    const std::filesystem::path golden_path = folders.golden / (name + ".png");
    if (folders.renew) {
        renew(image, golden_path);
        return std::nullopt;
    }

    const std::filesystem::path actual_path = folders.failures / (name + ".actual.png");
    const std::filesystem::path sheet_path = folders.failures / (name + ".difference.png");
    const auto keep_actual = [&] {
        std::filesystem::create_directories(actual_path.parent_path());
        save_png(image, actual_path);
    };
    if (!std::filesystem::exists(golden_path)) {
        keep_actual();
        return fmt::format(
            "there is no golden picture {}; the render is {}; script/goldens makes it the golden one",
            golden_path.string(), actual_path.string());
    }

    const Image golden = load_image(golden_path);
    std::string what;
    if (golden.width != image.width || golden.height != image.height) {
        what = fmt::format("{} x {} pixels instead of {} x {}", image.width, image.height, golden.width,
                           golden.height);
    } else {
        const ImageDifference difference = compare_images(golden, image, tolerance.channel_limit);
        if (is_within(difference, tolerance))
            return std::nullopt;
        what = describe(difference) + "\n" + heat_map(golden, image);
    }
    keep_actual();
    save_png(difference_sheet(golden, image), sheet_path);
    return fmt::format(
        "golden picture '{}': {}\nexpected | actual | difference: {}\nscript/goldens renews it if the "
        "change is meant",
        name, what, sheet_path.string());
}

void expect_matches_golden(const Image& image, const std::string& name, const GoldenTolerance& tolerance)
{
    const char* renewing = std::getenv("ESTAMPE_RENEW_GOLDENS");
    const GoldenFolders folders{.golden = test::golden_folder(),
                                .failures = std::filesystem::current_path() / "golden-failures",
                                .renew = renewing != nullptr && std::string_view(renewing) == "1"};
    if (const std::optional<std::string> failure = golden_failure(image, name, tolerance, folders))
        ADD_FAILURE() << *failure;
}

} // namespace estampe::test
