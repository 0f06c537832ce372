// SPDX-License-Identifier: MIT
#include "manual_page.hpp"

#include <string_view>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace estampe::app {
namespace {

/// `text` as roff reads it: no line is a request, and hyphens can be copied as the minus signs they are.
std::string roff(std::string_view text)
{
    std::string escaped;
    bool starts_line = true;
    for (const char letter : text) {
        if (starts_line && (letter == '.' || letter == '\'')) {
            escaped += "\\&";
        }
        switch (letter) {
        case '\\':
            escaped += "\\e";
            break;
        case '-':
            escaped += "\\-";
            break;
        default:
            escaped += letter;
            break;
        }
        starts_line = letter == '\n';
    }
    return escaped;
}

/// "-o, --output FILE", names bold and the value in italics.
std::string heading(const CLI::Option& option)
{
    std::string names;
    const auto add = [&](const std::string& name) {
        names += fmt::format("{}\\fB{}\\fR", names.empty() ? "" : ", ", roff(name));
    };
    for (const std::string& name : option.get_snames()) {
        add("-" + name);
    }
    for (const std::string& name : option.get_lnames()) {
        add("--" + name);
    }
    if (option.get_positional()) {
        add(option.get_name(true));
    } else if (option.get_items_expected_max() > 0) {
        names += fmt::format(" \\fI{}\\fR", roff(option.get_type_name()));
    }
    return names;
}

std::string entry(const CLI::Option& option)
{
    std::string text = fmt::format(".TP\n{}\n{}", heading(option), roff(option.get_description()));
    if (!option.get_default_str().empty()) {
        text += roff(fmt::format(" [{}]", option.get_default_str()));
    }
    return text + "\n";
}

/// All commands with what is typed to run each.
std::vector<std::pair<std::string, const CLI::App*>> list_commands(const CLI::App& app)
{
    std::vector<std::pair<std::string, const CLI::App*>> found;
    for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
        found.emplace_back(app.get_name() + " " + command->get_name(), command);
    }
    return found;
}

/// "render [OPTION]... SCENE -o FILE"
std::string usage(const std::string& typed, const CLI::App& command)
{
    std::string line = fmt::format("\\fB{}\\fR [\\fIOPTION\\fR]...", roff(typed));
    for (const CLI::Option* option : command.get_options()) {
        if (option->get_positional()) {
            const std::string name = fmt::format("\\fI{}\\fR", roff(option->get_name(true)));
            line += option->get_required() ? " " + name : fmt::format(" [{}]", name);
        } else if (option->get_required()) {
            const std::string name = option->get_snames().empty() ? "--" + option->get_lnames().front()
                                                                  : "-" + option->get_snames().front();
            line += fmt::format(" \\fB{}\\fR \\fI{}\\fR", roff(name), roff(option->get_type_name()));
        }
    }
    return line;
}

/// What stands at the end of a command's help, without the line on exit status.
std::string examples_of(const CLI::App& command)
{
    const std::string footer = command.get_footer();
    return footer.substr(0, footer.rfind("\n\nExit status"));
}

} // namespace

std::string manual_page(const CLI::App& app)
{
    const std::vector<std::pair<std::string, const CLI::App*>> commands = list_commands(app);

    std::string page = fmt::format(".TH ESTAMPE 1 \"\" \"{}\" \"User Commands\"\n.nh\n.SH NAME\nestampe \\- "
                                   "draws 3D scenes as a hand would\n.SH SYNOPSIS\n",
                                   app.version());
    for (const auto& [typed, command] : commands) {
        page += usage(typed, *command) + "\n.br\n";
    }
    page += fmt::format(".SH DESCRIPTION\n{}\n.SH OPTIONS\n", roff(app.get_description()));
    for (const CLI::Option* option : app.get_options()) {
        page += entry(*option);
    }
    page += ".SH COMMANDS\n";
    for (const auto& [typed, command] : commands) {
        page += fmt::format(".SS {}\n{}.\n", roff(typed), roff(command->get_description()));
        for (const CLI::Option* option : command->get_options()) {
            page += option->check_lname("help") ? "" : entry(*option);
        }
        if (!command->get_footer().empty() && command->get_footer() != app.get_footer()) {
            page += fmt::format(".PP\n.nf\n{}\n.fi\n", roff(examples_of(*command)));
        }
    }
    page += fmt::format(".SH EXAMPLES\n.nf\n{}\n.fi\n", roff(examples_of(app)));
    page +=
        ".SH EXIT STATUS\n.TP\n0\nThe job is done.\n.TP\n1\nThe job failed; a line on standard error says "
        "what, where and what to do.\n.TP\n2\nThe command line is wrong.\n";
    page += ".SH ENVIRONMENT\n.TP\nXDG_CACHE_HOME\nTonal art maps that were drawn, and pipelines "
            "that the driver compiled, are kept in \\fIestampe\\fR below it, or below \\fI~/.cache\\fR.\n";
    return page;
}

} // namespace estampe::app
