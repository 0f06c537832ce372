// SPDX-License-Identifier: MIT
#include "common/film.hpp"

#include <fmt/format.h>

#include <estampe/image.hpp>
#include <estampe/style.hpp>

namespace estampe::bench {

void FilmOptions::add_to(CLI::App& app)
{
    add_device_option(app, device);
    app.add_option("--style", style, "Preset, or TOML file")->capture_default_str();
    add_set_option(app, assignments);
    app.add_option("--width", width, "Width of a frame in pixels")->capture_default_str();
    app.add_option("--height", height, "Height of a frame in pixels")->capture_default_str();
    app.add_option("--pictures", pictures, "Folder that frames are written to");
    app.add_flag("--passes", passes, "Also prints what each pass costs; a frame then takes longer");
}

Style FilmOptions::load_style() const
{
    Style loaded = Style::load(style);
    for (const std::string& assignment : assignments) {
        loaded.set(assignment);
    }
    return loaded;
}

void FilmOptions::save(const Image& frame, int number) const
{
    if (!pictures.empty()) {
        save_png(frame, fmt::format("{}/{:05}.png", pictures, number));
    }
}

} // namespace estampe::bench
