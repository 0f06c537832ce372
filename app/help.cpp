// SPDX-License-Identifier: MIT
#include "help.hpp"

#include <algorithm>
#include <set>
#include <sstream>
#include <string_view>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <estampe/style.hpp>
#include <estampe/views.hpp>

#include "features/common/style_tables.hpp"
#include "piped_scene.hpp"
#include "world/registry.hpp"
#include "worlds.hpp"

namespace estampe::app {
namespace {

constexpr const char* script_head = R"bash(# bash completion for estampe; written by estampe --completion

# _estampe_files PATTERN...: files with these endings, and folders; without one, all files
_estampe_files() {
    local IFS=$'\n' ending
    compopt -o filenames
    COMPREPLY=($(compgen -d -- "$word"))
    [[ $# -gt 0 ]] || COMPREPLY+=($(compgen -f -- "$word"))
    for ending in "$@"; do
        COMPREPLY+=($(compgen -f -X "!*.$ending" -- "$word"))
    done
}

# _estampe_words WORD...
_estampe_words() {
    COMPREPLY+=($(compgen -W "$*" -- "$word"))
}

# _estampe_value COMMAND OPTION-OR-ARGUMENT: completes its value
_estampe_value() {
    case "$1 $2" in
)bash";

constexpr const char* script_tail = R"bash(
_estampe() {
    local word="${COMP_WORDS[COMP_CWORD]}" before="${COMP_WORDS[COMP_CWORD - 1]}" command="" i
    COMPREPLY=()
    # --style=pencil comes as three words
    if [[ $word == "=" ]]; then
        word=""
    elif [[ $before == "=" ]]; then
        before="${COMP_WORDS[COMP_CWORD - 2]}"
        [[ $before == -* ]] || return 0
    fi
    [[ ${COMP_WORDS[COMP_CWORD]} != "=" || $before == -* ]] || return 0
    for ((i = 1; i < COMP_CWORD; i++)); do
        [[ " $(_estampe_commands "$command") " == *" ${COMP_WORDS[i]} "* ]] || continue
        command="${command:+$command }${COMP_WORDS[i]}"
    done
    if [[ $before == -* ]] && [[ " $(_estampe_taking "$command") " == *" $before "* ]]; then
        _estampe_value "$command" "$before"
    elif [[ $word == -* ]]; then
        _estampe_words "$(_estampe_options "$command")"
    elif [[ -n $(_estampe_commands "$command") ]]; then
        _estampe_words "$(_estampe_commands "$command")"
    else
        _estampe_value "$command" argument
    fi
}
complete -F _estampe estampe
)bash";

std::string joined(const std::vector<std::string>& words)
{
    return fmt::format("{}", fmt::join(words, " "));
}

/// Returns the keys of all style parameters for completion, as "hatch.width_mm=".
std::vector<std::string> style_keys()
{
    std::vector<std::string> keys;
    for (const style::Section& section : features::style_schema().sections()) {
        for (const style::Parameter& parameter : section.parameters) {
            keys.push_back(fmt::format("{}.{}=", section.name, parameter.key));
        }
    }
    return keys;
}

std::vector<std::string> style_sections()
{
    std::vector<std::string> names;
    for (const style::Section& section : features::style_schema().sections()) {
        names.push_back(section.name);
    }
    return names;
}

/// Returns the keys of all worlds' options for completion, as "seed=".
std::vector<std::string> world_keys()
{
    std::set<std::string> keys;
    for (const worlds::Description& world : worlds::registry().all()) {
        for (const worlds::Option& option : world.options) {
            keys.insert(option.key + "=");
        }
    }
    return {keys.begin(), keys.end()};
}

/// Finds the file extensions in a description: "Scene: .gltf .glb" has "gltf" and "glb".
std::vector<std::string> endings_in(const std::string& description)
{
    std::vector<std::string> endings;
    std::istringstream words(description);
    for (std::string word; words >> word;) {
        if (word.starts_with('.') && word.size() > 1) {
            endings.push_back(word.substr(1));
        }
    }
    return endings;
}

/// Returns the name of the bash function that completes a value of `option`; empty if the value cannot be
/// completed.
std::string completer(const CLI::Option& option)
{
    const std::string type = option.get_type_name();
    if (type == "STYLE" || type == "STYLE|SCENE") {
        return fmt::format("_estampe_files toml; _estampe_words {}; "
                           R"([[ $word != *+* ]] || _estampe_words "${{word%+*}}+"{{{}}})",
                           joined(Style::presets()), fmt::join(Style::additions(), ","));
    }
    if (option.check_lname("help-style")) {
        return "_estampe_words all " + joined(style_sections());
    }
    if (option.check_lname("world")) {
        return fmt::format("compopt -o nospace; _estampe_words {}", joined(world_keys()));
    }
    if (type == "KEY=VALUE") {
        return fmt::format("compopt -o nospace; _estampe_words {}", joined(style_keys()));
    }
    if (option.check_lname("raster")) {
        return "_estampe_words auto hardware compute";
    }
    if (option.check_lname("up")) {
        return "_estampe_words x y z -x -y -z";
    }
    if (option.check_lname("view")) {
        return fmt::format("_estampe_words {}", fmt::join(view_names(), " "));
    }
    if (option.check_lname("input-format")) {
        return fmt::format("_estampe_words {}", fmt::join(input_formats(), " "));
    }
    if (option.check_lname("format")) {
        return "_estampe_words png jpg webp exr ora svg";
    }
    const auto is_of_words = [](char letter) { return letter == '|' || (letter >= 'a' && letter <= 'z'); };
    // The type lists the allowed words: "up|down".
    if (type.find('|') != std::string::npos && std::ranges::all_of(type, is_of_words)) {
        std::string words = type;
        std::ranges::replace(words, '|', ' ');
        return "_estampe_words " + words;
    }
    if (type == "DEVICE") {
        return "_estampe_words auto cpu";
    }
    if (type == "EXR" || type == "PNG") {
        return type == "EXR" ? "_estampe_files exr" : "_estampe_files png";
    }
    if (type == "FILE" || type == "PATH" || type == "DIR") {
        const std::string files = "_estampe_files " + joined(endings_in(option.get_description()));
        return option.check_name("SCENE") ? files + "; _estampe_words " + joined(world_names()) : files;
    }
    return {};
}

/// Parts of the bash completion script for one command and its subcommands.
struct Tables {
    std::string values;   ///< Cases of the script's function _estampe_value
    std::string commands; ///< Cases of the script for subcommands
    std::string options;
    std::string taking; ///< Cases of the script for options that take a value
};

void add_command(const CLI::App& command, const std::string& typed, Tables& tables)
{
    std::vector<std::string> options;
    std::vector<std::string> taking;
    for (const CLI::Option* option : command.get_options()) {
        std::vector<std::string> names;
        for (const std::string& name : option->get_snames()) {
            names.push_back("-" + name);
        }
        for (const std::string& name : option->get_lnames()) {
            names.push_back("--" + name);
        }
        options.insert(options.end(), names.begin(), names.end());
        const bool takes = option->get_items_expected_max() > 0;
        if (takes && !option->get_positional()) {
            taking.insert(taking.end(), names.begin(), names.end());
        }
        const std::string values = takes ? completer(*option) : std::string();
        if (option->get_positional()) {
            names.emplace_back("argument");
        }
        for (const std::string& name : names) {
            tables.values += values.empty() ? "" : fmt::format("    '{} {}') {} ;;\n", typed, name, values);
        }
    }
    std::vector<std::string> below;
    for (const CLI::App* child : command.get_subcommands([](const CLI::App*) { return true; })) {
        below.push_back(child->get_name());
        add_command(*child, typed.empty() ? child->get_name() : typed + " " + child->get_name(), tables);
    }
    tables.commands += fmt::format("    '{}') echo {} ;;\n", typed, joined(below));
    tables.options += fmt::format("    '{}') echo {} ;;\n", typed, joined(options));
    tables.taking += fmt::format("    '{}') echo {} ;;\n", typed, joined(taking));
}

std::string lookup(const std::string& name, const std::string& cases)
{
    return fmt::format("{}() {{\n    case \"$1\" in\n{}    esac\n}}\n", name, cases);
}

} // namespace

std::string bash_completion(const CLI::App& app)
{
    Tables tables;
    add_command(app, "", tables);
    return script_head + tables.values + "    esac\n}\n\n" + lookup("_estampe_commands", tables.commands) +
           lookup("_estampe_options", tables.options) + lookup("_estampe_taking", tables.taking) +
           script_tail;
}

namespace {

/// Escapes `text` for roff: no line becomes a request, and hyphens can be copied as minus signs.
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

/// Writes the heading of an option in roff: "-o, --output FILE", with names in bold and the value in italics.
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

/// Lists all commands, each with the words that run it.
std::vector<std::pair<std::string, const CLI::App*>> list_commands(const CLI::App& app)
{
    std::vector<std::pair<std::string, const CLI::App*>> found;
    for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
        found.emplace_back(app.get_name() + " " + command->get_name(), command);
    }
    return found;
}

/// Returns the usage line of a command: "render [OPTION]... SCENE -o FILE".
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

/// Returns the end of a command's help, without the line on exit status.
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
            const bool is_help = option->check_lname("help") || option->check_lname("help-all");
            page += is_help ? "" : entry(*option);
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
