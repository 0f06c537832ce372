// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

namespace estampe::viewer {

/// Undo history of a value.
template <typename State>
class History {
public:
    explicit History(State first) { states_.push_back(std::move(first)); }

    /// Adds a state to the history. Drops all states that were undone, and the oldest state if there are very
    /// many.
    void push(State state)
    {
        constexpr size_t most = 500;
        states_.erase(states_.begin() + static_cast<std::ptrdiff_t>(now_) + 1, states_.end());
        states_.push_back(std::move(state));
        if (states_.size() > most) {
            states_.erase(states_.begin());
        }
        now_ = states_.size() - 1;
    }

    [[nodiscard]] bool can_undo() const { return now_ > 0; }

    [[nodiscard]] bool can_redo() const { return now_ + 1 < states_.size(); }

    /// Goes back to the previous state. Only valid if can_undo() returns true. redo() is only valid if
    /// can_redo() returns true.
    const State& undo() { return states_[--now_]; }

    const State& redo() { return states_[++now_]; }

    [[nodiscard]] const State& now() const { return states_[now_]; }

private:
    std::vector<State> states_;
    size_t now_ = 0;
};

} // namespace estampe::viewer
