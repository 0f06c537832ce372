// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>

#include <estampe/scene.hpp>

namespace CLI {
class App;
} // namespace CLI

namespace estampe::app {

/// The options that say how a scene is read.
class SceneOptions {
public:
    /// Adds --up and --input-format to the command; this object must outlive the parsing.
    void add_to(CLI::App& command);

    /// The axis of the file that points up, if one was typed. Throws UsageError for what is no axis.
    [[nodiscard]] std::optional<UpAxis> up() const;

    /// The format of a piped scene; empty if none was typed. Throws UsageError for an unknown one.
    [[nodiscard]] std::string format() const;

private:
    std::string up_;
    std::string format_;
};

} // namespace estampe::app
