// SPDX-License-Identifier: MIT
#include "image_compare.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <numeric>
#include <stdexcept>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <glm/glm.hpp>

#include "core/color.hpp"

namespace estampe::test {

namespace {

constexpr uint32_t sheet_gap_px = 4;
constexpr uint32_t heat_columns = 16;
constexpr uint32_t heat_rows = 9;

void require_comparable(const Image& expected, const Image& actual)
{
    if (expected.width != actual.width || expected.height != actual.height)
        throw std::invalid_argument(fmt::format("pictures of {} x {} and {} x {} cannot be compared",
                                                expected.width, expected.height, actual.width,
                                                actual.height));
    if (expected.empty() || actual.empty())
        throw std::invalid_argument("an empty picture cannot be compared");
}

const uint8_t* pixel(const Image& image, uint32_t x, uint32_t y)
{
    return &image.rgba[(size_t{y} * image.width + x) * 4];
}

uint32_t pixel_difference(const uint8_t* a, const uint8_t* b)
{
    int largest = 0;
    for (int c = 0; c < 4; ++c)
        largest = std::max(largest, std::abs(a[c] - b[c]));
    return static_cast<uint32_t>(largest);
}

/// Linear red, green and blue over white.
std::vector<glm::dvec3> linear_pixels(const Image& image)
{
    const std::array<double, 256> linear = linear_of_srgb_bytes<double>();
    std::vector<glm::dvec3> out(image.rgba.size() / 4);
    for (size_t i = 0; i < out.size(); ++i) {
        const uint8_t* p = &image.rgba[i * 4];
        const double alpha = p[3] / 255.0;
        out[i] = glm::dvec3(linear[p[0]], linear[p[1]], linear[p[2]]) * alpha + glm::dvec3(1.0 - alpha);
    }
    return out;
}

/// Convolves lines of `count` pixels, `step` apart, with a Gaussian of sigma 1; edge pixels repeat.
void blur_line(const std::vector<glm::dvec3>& from, std::vector<glm::dvec3>& to, size_t start, size_t count,
               size_t step)
{
    constexpr int radius = 3;
    constexpr std::array<double, radius + 1> weights{0.39905, 0.24204, 0.05400, 0.00443};
    const int last = static_cast<int>(count) - 1;
    for (int i = 0; i <= last; ++i) {
        glm::dvec3 sum(0.0);
        double weight_sum = 0.0;
        for (int k = -radius; k <= radius; ++k) {
            const double weight = weights[static_cast<size_t>(std::abs(k))];
            sum += weight * from[start + static_cast<size_t>(std::clamp(i + k, 0, last)) * step];
            weight_sum += weight;
        }
        to[start + static_cast<size_t>(i) * step] = sum / weight_sum;
    }
}

glm::dvec3 lab_from_linear(const glm::dvec3& rgb)
{
    const glm::dvec3 xyz_over_white((0.4124564 * rgb.x + 0.3575761 * rgb.y + 0.1804375 * rgb.z) / 0.95047,
                                    0.2126729 * rgb.x + 0.7151522 * rgb.y + 0.0721750 * rgb.z,
                                    (0.0193339 * rgb.x + 0.1191920 * rgb.y + 0.9503041 * rgb.z) / 1.08883);
    glm::dvec3 f;
    for (int c = 0; c < 3; ++c) {
        const double t = xyz_over_white[c];
        f[c] = t > 216.0 / 24389.0 ? std::cbrt(t) : (24389.0 / 27.0 * t + 16.0) / 116.0;
    }
    return {116.0 * f.y - 16.0, 500.0 * (f.x - f.y), 200.0 * (f.y - f.z)};
}

std::vector<glm::dvec3> blurred_lab(const Image& image)
{
    std::vector<glm::dvec3> pixels = linear_pixels(image);
    std::vector<glm::dvec3> rows(pixels.size());
    for (size_t y = 0; y < image.height; ++y)
        blur_line(pixels, rows, y * image.width, image.width, 1);
    for (size_t x = 0; x < image.width; ++x)
        blur_line(rows, pixels, x, image.height, image.width);
    std::ranges::transform(pixels, pixels.begin(), lab_from_linear);
    return pixels;
}

void paste(const Image& from, Image& to, uint32_t left)
{
    for (uint32_t y = 0; y < from.height; ++y) {
        const auto row = from.rgba.begin() + static_cast<std::ptrdiff_t>(size_t{y} * from.width * 4);
        const auto target = to.rgba.begin() + static_cast<std::ptrdiff_t>((size_t{y} * to.width + left) * 4);
        std::copy_n(row, size_t{from.width} * 4, target);
    }
}

Image difference_picture(const Image& expected, const Image& actual)
{
    const uint32_t width = std::max(expected.width, actual.width);
    const uint32_t height = std::max(expected.height, actual.height);
    Image out{width, height, std::vector<uint8_t>(size_t{width} * height * 4, 255)};
    for (uint32_t y = 0; y < height; ++y) {
        for (uint32_t x = 0; x < width; ++x) {
            uint8_t* target = &out.rgba[(size_t{y} * width + x) * 4];
            const bool both =
                x < std::min(expected.width, actual.width) && y < std::min(expected.height, actual.height);
            if (!both) {
                target[1] = 0;
                continue;
            }
            const uint8_t* a = pixel(expected, x, y);
            const uint8_t* b = pixel(actual, x, y);
            for (int c = 0; c < 3; ++c) {
                const int difference = std::max(std::abs(a[c] - b[c]), std::abs(a[3] - b[3]));
                target[c] = static_cast<uint8_t>(std::min(255, 4 * difference));
            }
        }
    }
    return out;
}

} // namespace

Image flat_image(uint32_t width, uint32_t height, uint8_t grey)
{
    Image image{width, height, std::vector<uint8_t>(size_t{width} * height * 4, grey)};
    for (size_t i = 3; i < image.rgba.size(); i += 4)
        image.rgba[i] = 255;
    return image;
}

ImageDifference compare_images(const Image& expected, const Image& actual, uint32_t channel_limit)
{
    require_comparable(expected, actual);
    ImageDifference result;
    const size_t count = expected.rgba.size() / 4;
    uint64_t sum = 0;
    size_t failing = 0;
    for (size_t i = 0; i < count; ++i) {
        const uint32_t difference = pixel_difference(&expected.rgba[i * 4], &actual.rgba[i * 4]);
        result.max_abs = std::max(result.max_abs, difference);
        sum += difference;
        failing += difference > channel_limit ? 1 : 0;
    }
    result.mean_abs = static_cast<double>(sum) / static_cast<double>(count);
    result.failing_fraction = static_cast<double>(failing) / static_cast<double>(count);

    const std::vector<glm::dvec3> expected_lab = blurred_lab(expected);
    const std::vector<glm::dvec3> actual_lab = blurred_lab(actual);
    std::vector<double> delta_e(count);
    std::ranges::transform(expected_lab, actual_lab, delta_e.begin(),
                           [](const glm::dvec3& a, const glm::dvec3& b) { return glm::distance(a, b); });
    result.delta_e_mean = std::accumulate(delta_e.begin(), delta_e.end(), 0.0) / static_cast<double>(count);
    const auto p95 = delta_e.begin() + static_cast<std::ptrdiff_t>((count - 1) * 95 / 100);
    std::ranges::nth_element(delta_e, p95);
    result.delta_e_p95 = *p95;
    return result;
}

std::string describe(const ImageDifference& d)
{
    return fmt::format(
        "largest difference {}/255, mean {:.3f}/255, {:.3f} % of the pixels fail, delta E mean {:.3f}, "
        "95th percentile {:.3f}",
        d.max_abs, d.mean_abs, 100.0 * d.failing_fraction, d.delta_e_mean, d.delta_e_p95);
}

Image difference_sheet(const Image& expected, const Image& actual)
{
    const Image difference = difference_picture(expected, actual);
    const uint32_t width = 3 * difference.width + 2 * sheet_gap_px;
    Image sheet{width, difference.height, std::vector<uint8_t>(size_t{width} * difference.height * 4, 128)};
    for (size_t i = 3; i < sheet.rgba.size(); i += 4)
        sheet.rgba[i] = 255;
    paste(expected, sheet, 0);
    paste(actual, sheet, difference.width + sheet_gap_px);
    paste(difference, sheet, 2 * (difference.width + sheet_gap_px));
    return sheet;
}

std::string heat_map(const Image& expected, const Image& actual)
{
    require_comparable(expected, actual);
    std::array<uint32_t, size_t{heat_columns} * heat_rows> cells{};
    for (uint32_t y = 0; y < expected.height; ++y) {
        for (uint32_t x = 0; x < expected.width; ++x) {
            const uint64_t column = uint64_t{x} * heat_columns / expected.width;
            const uint64_t row = uint64_t{y} * heat_rows / expected.height;
            uint32_t& cell = cells[row * heat_columns + column];
            cell = std::max(cell, pixel_difference(pixel(expected, x, y), pixel(actual, x, y)));
        }
    }
    constexpr std::string_view ramp = ".:-=+*#%@";
    std::string text;
    for (size_t i = 0; i < cells.size(); ++i) {
        text += cells[i] == 0 ? ' ' : ramp[(cells[i] - 1) * (ramp.size() - 1) / 254];
        if (i % heat_columns == heat_columns - 1)
            text += '\n';
    }
    return text;
}

} // namespace estampe::test
