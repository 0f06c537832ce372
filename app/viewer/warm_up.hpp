// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "options.hpp"
#include "output/child.hpp"

namespace estampe::viewer {

/// Sees to it that the first window of a program just installed does not wait for shaders to be compiled
/// well: it has them compiled quickly, and a process of low priority compile them well for the next
/// one. Which of the two it is stands in a file of the user's cache, see warmth_file().
class WarmUp {
public:
    /// Before a device is opened and before threads start.
    explicit WarmUp(const app::ViewCommand& command);

    /// Whether shaders are compiled quickly in this run.
    [[nodiscard]] bool is_quick() const { return is_quick_; }

    /// To be called when the window shows this scene, drawn on the processor: begins what is to be done for
    /// the next run, once. What is not done when this goes is left.
    void begin(const std::string& scene);

private:
    bool is_quick_ = false;
    bool has_scene_;
    std::unique_ptr<output::Child> process_;
};

/// What that process does: draws the scene unseen in the ways of the window, and writes down that it did.
/// Throws Error as estampe render does.
void warm_up(const app::ViewCommand& command);

/// Where it stands for which program and which cache of Mesa's shaders were compiled well; empty when the
/// user has no home.
[[nodiscard]] std::filesystem::path warmth_file();

} // namespace estampe::viewer
