// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>

#include "options.hpp"

namespace CLI {
class App;
} // namespace CLI

namespace estampe::app {

/// The options of `estampe render` that say what its picture is written as.
class PictureOptions {
public:
    /// Adds them to the command; this object must outlive the parsing.
    void add_to(CLI::App& command);

    /// What was typed, looked at, for a picture that is named by `-o` and of a size. Throws UsageError for a
    /// mistake in it.
    [[nodiscard]] PictureChoice read(const std::string& output, uint32_t width, uint32_t height) const;

    /// That of the frames of a film. Throws UsageError when anything was typed that they do not have.
    [[nodiscard]] PictureChoice of_film() const;

private:
    std::string format_;
    std::string layers_;
    std::string layer_;
    std::optional<int> quality_;
    std::optional<int> depth_;
};

} // namespace estampe::app
