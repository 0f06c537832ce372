// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include <estampe/style.hpp>

#include "viewer/history.hpp"

namespace estampe::viewer {

/// The style in hand: where it came from, what was changed, and how to go back.
class Look {
public:
    /// As the command line has it: a preset or a file, changed by --set. An empty name is the built-in style.
    Look(const std::string& name, Style style);

    [[nodiscard]] const Style& style() const { return style_; }

    /// To be changed in place; finish_change() makes a step of it that can be undone.
    [[nodiscard]] Style& style() { return style_; }

    /// What parameters are set back to: the preset or file as it is.
    [[nodiscard]] const Style& base() const { return base_; }

    [[nodiscard]] const std::string& name() const { return name_; }

    /// Takes a preset or file, in one step. Throws Error as Style::load() does, and is then as before.
    void load(const std::string& name);
    /// Applies "key=value", in one step. Throws Error as Style::set() does.
    void set(std::string_view assignment);
    void finish_change();
    /// The same, once for all that was changed since the last step.
    void finish_change_if_any();

    [[nodiscard]] bool can_undo() const { return history_.can_undo(); }

    [[nodiscard]] bool can_redo() const { return history_.can_redo(); }

    void undo();
    void redo();

    /// Writes all parameters as a TOML file, or nothing. It is then the file in hand. Throws Error when it
    /// cannot be written.
    void save(const std::filesystem::path& path);

    /// Grows with every change of the style.
    [[nodiscard]] uint64_t revision() const { return revision_; }

    void changed() { ++revision_; }

private:
    struct State {
        std::string name;
        Style base;
        Style style;
    };

    void take(const State& state);

    std::string name_;
    Style base_;
    Style style_;
    History<State> history_;
    uint64_t revision_ = 0;
    uint64_t finished_revision_ = 0; ///< of the last step
};

} // namespace estampe::viewer
