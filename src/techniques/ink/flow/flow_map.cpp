// SPDX-License-Identifier: MIT
// A picture of flow, made into a stream function.
#include <algorithm>

#include <estampe/image.hpp>

#include "techniques/ink/flow/flow.hpp"

namespace estampe::ink {

std::vector<glm::vec2> read_flow(const std::string& path)
{
    const Image picture = load_image(path);
    constexpr uint32_t side = shared::ink_map_side;
    std::vector<glm::vec2> velocities;
    velocities.reserve(size_t{side} * side);
    for (uint32_t row = 0; row < side; ++row) {
        for (uint32_t column = 0; column < side; ++column) {
            const size_t x = std::min<size_t>(size_t{column} * picture.width / (side - 1), picture.width - 1);
            const size_t y = std::min<size_t>(size_t{row} * picture.height / (side - 1), picture.height - 1);
            const uint8_t* const texel = picture.rgba.data() + 4 * (y * picture.width + x);
            velocities.push_back((glm::vec2(texel[0], texel[1]) - 128.0F) / 127.0F);
        }
    }
    return velocities;
}

namespace {

/// Least squares by conjugate gradients: differences of psi along the edges of a grid of nodes against what
/// the velocities ask for there.
class StreamSolver {
public:
    StreamSolver(const std::vector<glm::vec2>& velocities, glm::dvec2 step_mm) : step_mm_(step_mm)
    {
        for (int y = 0; y < side; ++y) {
            for (int x = 0; x < side; ++x) {
                const glm::dvec2 here(velocities.at(place(x, y)));
                if (x + 1 < side) {
                    const double down =
                        0.5 * (here.y + static_cast<double>(velocities.at(place(x + 1, y)).y));
                    add_edge(place(x, y), place(x + 1, y), -down / step_mm_.x, target_);
                }
                if (y + 1 < side) {
                    const double right =
                        0.5 * (here.x + static_cast<double>(velocities.at(place(x, y + 1)).x));
                    add_edge(place(x, y), place(x, y + 1), right / step_mm_.y, target_);
                }
            }
        }
    }

    [[nodiscard]] std::vector<float> solve() const
    {
        std::vector<double> psi(count, 0.0);
        std::vector<double> residual = target_;
        std::vector<double> direction = residual;
        double square = dot(residual, residual);
        const double enough = 1e-12 * square;
        for (int i = 0; i < most_rounds && square > enough; ++i) {
            const std::vector<double> applied = laplacian(direction);
            const double length = square / dot(direction, applied);
            for (size_t k = 0; k < count; ++k) {
                psi[k] += length * direction[k];
                residual[k] -= length * applied[k];
            }
            const double next = dot(residual, residual);
            for (size_t k = 0; k < count; ++k) {
                direction[k] = residual[k] + next / square * direction[k];
            }
            square = next;
        }
        return {psi.begin(), psi.end()};
    }

private:
    static constexpr int side = static_cast<int>(shared::ink_map_side);
    static constexpr size_t count = size_t{shared::ink_map_side} * shared::ink_map_side;
    static constexpr int most_rounds = 400;

    static size_t place(int x, int y) { return static_cast<size_t>(y) * side + static_cast<size_t>(x); }

    static void add_edge(size_t from, size_t to, double flow, std::vector<double>& sums)
    {
        sums[from] -= flow;
        sums[to] += flow;
    }

    static double dot(const std::vector<double>& a, const std::vector<double>& b)
    {
        double sum = 0.0;
        for (size_t k = 0; k < count; ++k) {
            sum += a[k] * b[k];
        }
        return sum;
    }

    [[nodiscard]] std::vector<double> laplacian(const std::vector<double>& psi) const
    {
        std::vector<double> sums(count, 0.0);
        const glm::dvec2 weight = 1.0 / (step_mm_ * step_mm_);
        for (int y = 0; y < side; ++y) {
            for (int x = 0; x < side; ++x) {
                if (x + 1 < side) {
                    add_edge(place(x, y), place(x + 1, y),
                             weight.x * (psi[place(x + 1, y)] - psi[place(x, y)]), sums);
                }
                if (y + 1 < side) {
                    add_edge(place(x, y), place(x, y + 1),
                             weight.y * (psi[place(x, y + 1)] - psi[place(x, y)]), sums);
                }
            }
        }
        return sums;
    }

    glm::dvec2 step_mm_;
    std::vector<double> target_ = std::vector<double>(count, 0.0);
};

} // namespace

std::vector<float> stream_of_flow(const std::vector<glm::vec2>& velocities, glm::vec2 page_mm)
{
    return StreamSolver(velocities, glm::dvec2(page_mm) / static_cast<double>(shared::ink_map_side - 1))
        .solve();
}

} // namespace estampe::ink
