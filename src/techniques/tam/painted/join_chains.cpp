// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "techniques/tam/painted/chains.hpp"

namespace estampe::tam {
namespace {

/// One end of a chain.
struct End {
    size_t chain = 0;
    bool at_back = false;
    glm::vec2 place{0.0F};
    glm::vec2 outward{0.0F};
};

End end_of(const std::vector<Chain>& chains, size_t index, bool at_back)
{
    constexpr size_t tangent_px = 7;
    const Chain& chain = chains[index];
    const size_t span = std::min(tangent_px, chain.size() - 1);
    const glm::vec2 tip = at_back ? chain.back() : chain.front();
    const glm::vec2 inner = at_back ? chain[chain.size() - 1 - span] : chain[span];
    const glm::vec2 out = tip - inner;
    const float length = glm::length(out);
    return {index, at_back, tip, length > 0.0F ? out / length : glm::vec2(0.0F)};
}

/// Joins chains whose ends point at each other.
class Joiner {
public:
    Joiner(std::vector<Chain> chains, const Field& ink, float reach_px)
        : chains_(std::move(chains)), ink_(ink), reach_px_(reach_px),
          size_(static_cast<float>(ink.size_px())), partner_(2 * chains_.size(), none)
    {
        for (size_t i = 0; i < chains_.size(); ++i) {
            ends_.push_back(end_of(chains_, i, false));
            ends_.push_back(end_of(chains_, i, true));
        }
    }

    [[nodiscard]] std::vector<Chain> join()
    {
        pair_ends();
        std::vector<Chain> joined;
        std::vector<bool> used(chains_.size());
        // Open strings of chains first, from their free ends, then what is left: rings.
        for (const bool rings : {false, true}) {
            for (size_t end = 0; end < ends_.size(); ++end) {
                if (!used[end / 2] && (rings || partner_[end] == none)) {
                    joined.push_back(follow(end, used));
                }
            }
        }
        return joined;
    }

private:
    static constexpr size_t none = std::numeric_limits<size_t>::max();

    struct Pair {
        float cost = 0.0F;
        size_t a = 0;
        size_t b = 0;
    };

    [[nodiscard]] glm::vec2 wrapped(glm::vec2 difference) const
    {
        return difference - size_ * glm::round(difference / size_);
    }

    /// How badly two ends fit; negative when they do not.
    [[nodiscard]] float misfit(const End& a, const End& b) const
    {
        constexpr float least_agreement = 0.85F;
        const glm::vec2 gap = wrapped(b.place - a.place);
        const float distance = glm::length(gap);
        if (a.chain == b.chain || distance > reach_px_ || distance <= 0.0F) {
            return -1.0F;
        }
        const float agreement =
            std::min({-glm::dot(a.outward, b.outward), glm::dot(a.outward, gap) / distance,
                      -glm::dot(b.outward, gap) / distance});
        if (agreement < least_agreement && (distance > 2.9F || -glm::dot(a.outward, b.outward) < 0.6F)) {
            return -1.0F;
        }
        const int samples = static_cast<int>(distance) + 1;
        for (int i = 1; i < samples; ++i) {
            const glm::vec2 place = a.place + gap * (static_cast<float>(i) / static_cast<float>(samples));
            if (ink_.at(glm::ivec2(glm::round(place))) == 0) {
                return -1.0F;
            }
        }
        return distance * (2.0F - agreement);
    }

    void pair_ends()
    {
        const auto cells = static_cast<size_t>(std::max(1.0F, std::floor(size_ / reach_px_)));
        const auto cell_of = [&](float place) {
            const float share = place / size_ - std::floor(place / size_);
            return std::min(cells - 1, static_cast<size_t>(share * static_cast<float>(cells)));
        };
        std::vector<std::vector<size_t>> grid(cells * cells);
        for (size_t end = 0; end < ends_.size(); ++end) {
            grid[cell_of(ends_[end].place.y) * cells + cell_of(ends_[end].place.x)].push_back(end);
        }
        std::vector<Pair> pairs;
        for (size_t end = 0; end < ends_.size(); ++end) {
            for (size_t dy = 0; dy < std::min<size_t>(3, cells); ++dy) {
                for (size_t dx = 0; dx < std::min<size_t>(3, cells); ++dx) {
                    const size_t row = (cell_of(ends_[end].place.y) + cells + dy - 1) % cells;
                    const size_t column = (cell_of(ends_[end].place.x) + cells + dx - 1) % cells;
                    collect(end, grid[row * cells + column], pairs);
                }
            }
        }
        std::sort(pairs.begin(), pairs.end(), [](const Pair& left, const Pair& right) {
            return std::tie(left.cost, left.a, left.b) < std::tie(right.cost, right.a, right.b);
        });
        for (const Pair& pair : pairs) {
            if (partner_[pair.a] == none && partner_[pair.b] == none) {
                partner_[pair.a] = pair.b;
                partner_[pair.b] = pair.a;
            }
        }
    }

    void collect(size_t end, const std::vector<size_t>& others, std::vector<Pair>& pairs) const
    {
        constexpr size_t most_in_a_cell = 64;
        for (size_t i = 0; i < std::min(most_in_a_cell, others.size()); ++i) {
            const float cost = others[i] > end ? misfit(ends_[end], ends_[others[i]]) : -1.0F;
            if (cost >= 0.0F) {
                pairs.push_back({cost, end, others[i]});
            }
        }
    }

    /// The string of chains that begins at an end, gaps filled.
    [[nodiscard]] Chain follow(size_t end, std::vector<bool>& used) const
    {
        Chain string;
        while (end != none && !used[end / 2]) {
            used[end / 2] = true;
            Chain chain = chains_[end / 2];
            if (end % 2 == 1) {
                std::reverse(chain.begin(), chain.end());
            }
            append(string, chain);
            end = partner_[end ^ 1U];
        }
        return string;
    }

    void append(Chain& string, const Chain& chain) const
    {
        glm::ivec2 shift(0);
        if (!string.empty()) {
            const glm::vec2 last = string.back();
            const glm::vec2 gap = wrapped(glm::vec2(chain.front()) - last);
            shift = glm::ivec2(glm::round(last + gap)) - chain.front();
            const int samples = static_cast<int>(glm::length(gap));
            for (int i = 1; i < samples; ++i) {
                const float share = static_cast<float>(i) / static_cast<float>(samples);
                string.push_back(glm::ivec2(glm::round(last + gap * share)));
            }
        }
        for (const glm::ivec2 place : chain) {
            string.push_back(place + shift);
        }
    }

    std::vector<Chain> chains_;
    const Field& ink_;
    float reach_px_;
    float size_;
    std::vector<End> ends_;
    std::vector<size_t> partner_;
};

} // namespace

std::vector<Chain> join_chains(std::vector<Chain> chains, const Field& ink, float reach_px)
{
    return Joiner(std::move(chains), ink, reach_px).join();
}

} // namespace estampe::tam
