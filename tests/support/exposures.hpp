// SPDX-License-Identifier: MIT
#pragma once

// Means of many pictures, as references for effects of the lens and of the shutter.

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include <estampe/scene.hpp>
#include <glm/glm.hpp>

namespace estampe::test {

/// A picture in linear light, row by row.
struct Exposure {
    uint32_t width = 0;
    uint32_t height = 0;
    std::vector<glm::dvec3> pixels;
};

[[nodiscard]] inline Exposure exposure_of(const Image& image)
{
    Exposure exposure{.width = image.width, .height = image.height, .pixels = {}};
    const auto linear = [](uint8_t byte) {
        const double encoded = byte / 255.0;
        return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
    };
    for (size_t i = 0; i < size_t{image.width} * image.height; ++i) {
        exposure.pixels.emplace_back(linear(image.rgba[4 * i]), linear(image.rgba[4 * i + 1]),
                                     linear(image.rgba[4 * i + 2]));
    }
    return exposure;
}

/// The camera turned by part of a pixel. Each number gives another direction, like the samples of a picture.
/// A mean of many such pictures has smooth edges, like a picture of many samples.
[[nodiscard]] inline Camera shifted_in_pixel(const Camera& camera, int number, uint32_t height_px)
{
    const auto radical = [](int index, int base) {
        double result = 0.0;
        double digit = 1.0;
        for (int left = index; left > 0; left /= base) {
            digit /= base;
            result += digit * (left % base);
        }
        return result - 0.5;
    };
    const glm::dvec3 ahead = camera.target - camera.eye;
    const glm::dvec3 right = glm::normalize(glm::cross(ahead, camera.up));
    const glm::dvec3 above = glm::normalize(glm::cross(right, ahead));
    const double pixel_m = 2.0 * std::tan(0.5 * camera.vertical_fov_rad) / height_px * glm::length(ahead);
    Camera shifted = camera;
    shifted.target += pixel_m * (radical(number + 1, 2) * right + radical(number + 1, 3) * above);
    return shifted;
}

/// The mean of `count` pictures.
[[nodiscard]] inline Exposure mean_of(int count, const std::function<Image(int)>& draw)
{
    Exposure mean = exposure_of(draw(0));
    for (int i = 1; i < count; ++i) {
        const Exposure next = exposure_of(draw(i));
        for (size_t pixel = 0; pixel < mean.pixels.size(); ++pixel) {
            mean.pixels[pixel] += next.pixels[pixel];
        }
    }
    for (glm::dvec3& pixel : mean.pixels) {
        pixel /= count;
    }
    return mean;
}

/// Peak signal-to-noise ratio, in decibels, of light from 0 to 1.
[[nodiscard]] inline double psnr_db(const Exposure& a, const Exposure& b)
{
    double sum = 0.0;
    for (size_t i = 0; i < a.pixels.size(); ++i) {
        const glm::dvec3 off = a.pixels[i] - b.pixels[i];
        sum += glm::dot(off, off) / 3.0;
    }
    return -10.0 * std::log10(std::max(sum / static_cast<double>(a.pixels.size()), 1e-12));
}

/// The side in pixels of the largest square in which all pixels differ by more than `tolerance`. An error
/// along an edge is as wide as this square.
[[nodiscard]] inline int widest_error_px(const Exposure& a, const Exposure& b, double tolerance)
{
    std::vector<int> side(a.pixels.size(), 0);
    int widest = 0;
    for (size_t i = 0; i < a.pixels.size(); ++i) {
        const glm::dvec3 off = glm::abs(a.pixels[i] - b.pixels[i]);
        const bool is_off = std::max(off.x, std::max(off.y, off.z)) > tolerance;
        const bool is_inside = i % a.width > 0 && i >= a.width;
        const int before = is_inside ? std::min({side[i - 1], side[i - a.width], side[i - a.width - 1]}) : 0;
        side[i] = is_off ? before + 1 : 0;
        widest = std::max(widest, side[i]);
    }
    return widest;
}

} // namespace estampe::test
