// SPDX-License-Identifier: MIT
#include "viewer/look.hpp"

#include <span>

#include "core/file.hpp"

namespace estampe::viewer {
namespace {

Style style_named(const std::string& name)
{
    return name.empty() ? Style() : Style::load(name);
}

} // namespace

Look::Look(const std::string& name, Style style)
    : name_(name), base_(style_named(name)), style_(std::move(style)), history_({name_, base_, style_})
{
}

void Look::load(const std::string& name)
{
    const Style style = style_named(name);
    history_.push({name, style, style});
    take(history_.now());
}

void Look::set(std::string_view assignment)
{
    style_.set(assignment);
    finish_change();
}

void Look::finish_change()
{
    ++revision_;
    if (style_.to_toml() != history_.now().style.to_toml()) {
        history_.push({name_, base_, style_});
    }
    finished_revision_ = revision_;
}

void Look::finish_change_if_any()
{
    if (revision_ != finished_revision_) {
        finish_change();
    }
}

void Look::take(const State& state)
{
    name_ = state.name;
    base_ = state.base;
    style_ = state.style;
    finished_revision_ = ++revision_;
}

void Look::undo()
{
    if (history_.can_undo()) {
        take(history_.undo());
    }
}

void Look::redo()
{
    if (history_.can_redo()) {
        take(history_.redo());
    }
}

void Look::save(const std::filesystem::path& path)
{
    const std::string text = style_.to_toml();
    write_file_atomically(path, std::as_bytes(std::span(text)));
    name_ = path.string();
    base_ = style_;
    history_.push({name_, base_, style_});
}

} // namespace estampe::viewer
