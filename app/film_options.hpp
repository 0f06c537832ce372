// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace CLI {
class App;
}

namespace estampe::app {

/// What makes a film of a picture.
struct FilmChoice {
    uint32_t first = 1;
    uint32_t last = 0; ///< with the first; 0: to the end of the animation, of a turn of five seconds, or of
                       ///< the world's own film
    double frames_per_s = 24.0; ///< without --fps that of the scene's file, where it says one
    bool has_rate = false;      ///< --fps was given
    bool turntable = false;     ///< the eye goes once around from the first frame to the last
    bool flies = false;         ///< --film: along the camera path of the world's own film
    bool resume = false;        ///< go on where an earlier run stopped
};

/// Whether `output` is a film, or pictures with numbers in their names ("frames/%04d.png").
[[nodiscard]] bool is_film_output(const std::string& output);

/// The options of `estampe render` that are of films alone.
class FilmOptions {
public:
    /// Adds them to the command; this object must outlive its parsing.
    void add_to(CLI::App& command);

    /// What was typed; nothing where `output` is a single picture. Throws UsageError for what contradicts
    /// itself.
    [[nodiscard]] std::optional<FilmChoice> read(const std::string& output) const;

private:
    std::string frames_;
    std::optional<double> frames_per_s_;
    bool turntable_ = false;
    bool flies_ = false;
    bool resume_ = false;
};

} // namespace estampe::app
