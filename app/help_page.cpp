// SPDX-License-Identifier: MIT
#include "help_page.hpp"

#include <algorithm>
#include <sstream>
#include <vector>

#include <fmt/format.h>

#include "core/text.hpp"
#include "option_values.hpp"

namespace estampe::app {
namespace {

constexpr size_t page_columns = 100;
constexpr size_t short_name_columns = 24; ///< Width of the column of options in --help
constexpr size_t full_name_columns = 34;  ///< Width of the column of options in --help-all

using Options = std::vector<const CLI::Option*>;

struct OptionGroup {
    const char* title;
    std::vector<const char*> options; ///< Long names of the options, in the order of the help page
};

constexpr const char* other_options = "Options";

/// Returns the groups of options in the order of the help page. Options that belong to no group are listed
/// under the heading `other_options`.
const std::vector<OptionGroup>& option_groups()
{
    static const std::vector<OptionGroup> groups{
        {"Most used",
         {"output", "style", "set", "size", "page", "camera", "view", "time", "animation", "samples"}},
        {other_options, {}},
        {"Scene", {"up", "input-format", "variant", "world", "seed", "terrain", "lightmap", "confine"}},
        {"Picture", {"transparent", "draft", "ortho", "dpi", "landscape", "tile"}},
        {"Film", {"frames", "fps", "turntable", "film", "resume"}},
        {"Output", {"format", "depth", "quality", "layers", "layer", "motion", "since", "hidden", "plotter"}},
        {"Device",
         {"device", "raster", "no-cache", "max-memory", "max-seconds", "repeat", "timings", "json"}},
        {"Help", {"help", "help-all", "help-style", "man", "completion", "version"}}};
    return groups;
}

bool is_named(const OptionGroup& group, const CLI::Option& option)
{
    return std::ranges::any_of(group.options, [&](const char* name) { return option.check_lname(name); });
}

Options options_in(const CLI::App& command, const OptionGroup& group)
{
    Options found;
    for (const char* name : group.options) {
        if (const CLI::Option* option = find_option(command, name)) {
            found.push_back(option);
        }
    }
    if (group.title == other_options) {
        found = command.get_options([](const CLI::Option* option) {
            return option->nonpositional() &&
                   std::ranges::none_of(option_groups(),
                                        [&](const OptionGroup& named) { return is_named(named, *option); });
        });
    }
    return found;
}

/// Returns the first sentence of an option's description on one line, with the default in brackets if
/// `columns` are enough.
std::string first_sentence(const CLI::Option& option, size_t columns)
{
    std::string text = option.get_description();
    std::ranges::replace(text, '\n', ' ');
    std::string fallback = option.get_default_str();
    if (const size_t bracket = text.rfind(" ["); bracket != std::string::npos && text.ends_with(']')) {
        fallback = text.substr(bracket + 2, text.size() - bracket - 3);
        text.resize(bracket);
    }
    text.resize(std::min(text.size(), text.find(". ")));
    const std::string with_default = fmt::format("{} [{}]", text, fallback);
    return !fallback.empty() && with_default.size() <= columns ? with_default : text;
}

/// Returns the names of an option as help shows them: "-o, --output FILE".
std::string names_of(const CLI::Option& option)
{
    std::string names = option.get_name(option.get_positional(), true);
    replace_all(names, ",", ", ");
    const bool has_value = option.nonpositional() && !option.get_type_name().empty() &&
                           (option.get_items_expected_max() > 0 || option.get_type_name().front() == '[');
    const char* gap = option.get_type_name().starts_with("[=") ? "" : " ";
    return has_value ? names + gap + option.get_type_name() : names;
}

std::string short_line(const CLI::Option& option)
{
    return fmt::format("  {:<{}}{}\n", names_of(option), short_name_columns - 2,
                       first_sentence(option, page_columns - short_name_columns));
}

/// Returns the first example in a footer of help that runs this command, as one line; empty if there is none.
std::string first_example(const std::string& footer, const std::string& command)
{
    std::istringstream lines(footer);
    for (std::string line; std::getline(lines, line);) {
        if (line.starts_with(fmt::format("  {} ", command))) {
            return fmt::format("Example:{}\n", line.substr(1));
        }
    }
    return {};
}

} // namespace

HelpPage::HelpPage()
{
    column_width(full_name_columns);
}

std::string HelpPage::make_usage(const CLI::App* app, std::string name) const
{
    std::string line = fmt::format("Usage: {} [OPTION]...", name);
    for (const CLI::Option* option : app->get_options()) {
        if (option->get_positional()) {
            line += " " + make_option_usage(option);
        }
    }
    for (const CLI::Option* option : app->get_options()) {
        if (option->get_required() && option->nonpositional()) {
            const bool has_short = !option->get_snames().empty();
            line += fmt::format(" {} {}",
                                has_short ? "-" + option->get_snames().front()
                                          : "--" + option->get_lnames().front(),
                                option->get_type_name());
        }
    }
    return line + (app->get_subcommands({}).empty() ? "\n" : " [COMMAND]\n");
}

std::string HelpPage::make_option_opts(const CLI::Option* option) const
{
    std::string text = CLI::Formatter::make_option_opts(option);
    // The help shows "..." only for an option that accepts several values after one name.
    if (!option->get_allow_extra_args()) {
        replace_all(text, " ...", "");
    }
    return text;
}

std::string HelpPage::make_help(const CLI::App* app, std::string name, CLI::AppFormatMode mode) const
{
    const bool is_full = mode == CLI::AppFormatMode::All;
    std::string page = make_description(app) + make_usage(app, name);
    if (is_full) {
        page += make_positionals(app);
    } else {
        for (const CLI::Option* option : app->get_options()) {
            page += option->get_positional() ? short_line(*option) : "";
        }
    }
    for (const OptionGroup& group : option_groups()) {
        const Options options = options_in(*app, group);
        if (options.empty()) {
            continue;
        }
        if (is_full) {
            page += make_group(group.title, false, options);
            continue;
        }
        page += fmt::format("{}:\n", group.title);
        for (const CLI::Option* option : options) {
            page += short_line(*option);
        }
    }
    if (is_full) {
        return page + make_subcommands(app, CLI::AppFormatMode::Normal) + "\n" + make_footer(app);
    }
    const std::vector<const CLI::App*> commands = app->get_subcommands({});
    page += commands.empty() ? "" : "Commands:\n";
    for (const CLI::App* command : commands) {
        page += fmt::format("  {:<{}}{}\n", command->get_name(), short_name_columns - 2,
                            command->get_description());
    }
    page += first_example(app->get_footer(), name);
    // The help of a command lists --help-all among its options.
    return commands.empty() ? page
                            : page + fmt::format("{} COMMAND --help lists the options of a command.\n", name);
}

} // namespace estampe::app
