// SPDX-License-Identifier: MIT
#pragma once

// Finds strokes of a drawing near a place of the page.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include <estampe/vector_drawing.hpp>
#include <glm/glm.hpp>

namespace estampe::output {

// Two strokes are parallel if the cosine of the angle between them is at least this; the angle is at most 6
// degrees.
inline constexpr float parallel_cosine = 0.995F;
// Strokes run beside each other if the angle between them is at most 30 degrees.
inline constexpr float beside_cosine = 0.866F;

/// A short piece of a stroke that is already drawn.
struct Piece {
    glm::vec2 from{0.0F};
    glm::vec2 to{0.0F};
    uint32_t stroke = 0;
};

/// Short pieces of strokes in a grid, for searches within at most the side of a cell.
class DrawnPieces {
public:
    explicit DrawnPieces(float cell_mm) : cell_mm_(cell_mm) {}

    /// Returns whether a piece of an earlier stroke lies within `reach_mm` of `place` and is parallel to the
    /// direction `way`.
    [[nodiscard]] bool covers(const glm::vec2& place, const glm::vec2& way, float reach_mm) const
    {
        return has_piece(place, [&](const Piece& piece) {
            return std::abs(glm::dot(way, direction(piece.from, piece.to))) > parallel_cosine &&
                   distance_to(place, piece) <= reach_mm;
        });
    }

    /// Returns whether pieces of other strokes than `stroke`, within `reach_mm` of `place`, run beside the
    /// direction `way` on both of its sides.
    [[nodiscard]] bool encloses(uint32_t stroke, const glm::vec2& place, const glm::vec2& way,
                                float reach_mm) const
    {
        const auto is_on_side = [&](float sign) {
            return has_piece(place, [&](const Piece& piece) {
                const glm::vec2 middle = 0.5F * (piece.from + piece.to) - place;
                return piece.stroke != stroke && sign * (way.x * middle.y - way.y * middle.x) > 0.0F &&
                       std::abs(glm::dot(way, direction(piece.from, piece.to))) > beside_cosine &&
                       distance_to(place, piece) <= reach_mm;
            });
        };
        return is_on_side(1.0F) && is_on_side(-1.0F);
    }

    /// Returns whether a piece of another stroke than `stroke` lies within `reach_mm` of `place`.
    [[nodiscard]] bool has_another(uint32_t stroke, const glm::vec2& place, float reach_mm) const
    {
        return has_piece(place, [&](const Piece& piece) {
            return piece.stroke != stroke && distance_to(place, piece) <= reach_mm;
        });
    }

    void add(const VectorStroke& stroke, uint32_t number)
    {
        for (size_t i = 1; i < stroke.points.size(); ++i) {
            const Piece piece{stroke.points[i - 1].page_mm, stroke.points[i].page_mm};
            const int steps = 1 + static_cast<int>(glm::distance(piece.from, piece.to) / (0.5F * cell_mm_));
            for (int k = 0; k < steps; ++k) {
                const Piece part{
                    glm::mix(piece.from, piece.to, static_cast<float>(k) / static_cast<float>(steps)),
                    glm::mix(piece.from, piece.to, static_cast<float>(k + 1) / static_cast<float>(steps)),
                    number};
                cells_[key_of(cell_of(0.5F * (part.from + part.to)))].push_back(part);
            }
        }
    }

    /// Removes the pieces of stroke `number` that are nearest to `place`.
    void remove(const glm::vec2& place, uint32_t number)
    {
        std::erase_if(cells_[key_of(cell_of(place))], [&](const Piece& piece) {
            return piece.stroke == number && distance_to(place, piece) < 1e-3F;
        });
    }

    [[nodiscard]] static glm::vec2 direction(const glm::vec2& from, const glm::vec2& to)
    {
        const float length = glm::distance(from, to);
        return length > 0.0F ? (to - from) / length : glm::vec2(0.0F);
    }

    [[nodiscard]] static uint64_t key_of(const glm::ivec2& cell)
    {
        return static_cast<uint64_t>(static_cast<uint32_t>(cell.x)) << 32U | static_cast<uint32_t>(cell.y);
    }

private:
    template <class IsOne>
    [[nodiscard]] bool has_piece(const glm::vec2& place, const IsOne& is_one) const
    {
        const glm::ivec2 middle = cell_of(place);
        for (int i = 0; i < 9; ++i) {
            const auto found = cells_.find(key_of(middle + glm::ivec2(i % 3 - 1, i / 3 - 1)));
            if (found != cells_.end() && std::ranges::any_of(found->second, is_one)) {
                return true;
            }
        }
        return false;
    }

    [[nodiscard]] static float distance_to(const glm::vec2& place, const Piece& piece)
    {
        const glm::vec2 way = piece.to - piece.from;
        const float along =
            glm::clamp(glm::dot(place - piece.from, way) / std::max(glm::dot(way, way), 1e-12F), 0.0F, 1.0F);
        return glm::distance(place, piece.from + along * way);
    }

    [[nodiscard]] glm::ivec2 cell_of(const glm::vec2& place) const { return {glm::floor(place / cell_mm_)}; }

    float cell_mm_ = 1.0F;
    std::unordered_map<uint64_t, std::vector<Piece>> cells_;
};

} // namespace estampe::output
