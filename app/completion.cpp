// SPDX-License-Identifier: MIT
#include "completion.hpp"

#include <algorithm>
#include <set>
#include <sstream>
#include <vector>

#include <CLI/CLI.hpp>
#include <estampe/style.hpp>
#include <estampe/views.hpp>
#include <fmt/format.h>

#include "features/common/style_tables.hpp"
#include "piped_scene.hpp"
#include "world/registry.hpp"
#include "world_options.hpp"

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

/// All parameters, as "hatch.width_mm=".
std::vector<std::string> style_keys()
{
    features::StyleTables tables;
    std::vector<std::string> keys;
    const style::Sheet sheet = features::sheet_of(tables);
    for (const style::Sheet::Section& section : sheet.sections()) {
        for (const style::Parameter& parameter : section.parameters) {
            keys.push_back(fmt::format("{}.{}=", section.name, parameter.key));
        }
    }
    return keys;
}

/// The options of all worlds, as "seed=".
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

/// The endings that a description lists: "Scene: .gltf .glb" has "gltf" and "glb".
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

/// What bash calls to complete a value of `option`; empty where that is for the user to know.
std::string completer(const CLI::Option& option)
{
    const std::string type = option.get_type_name();
    if (type == "STYLE") {
        return fmt::format("_estampe_files toml; _estampe_words {}", joined(Style::presets()));
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

/// What the script says of one command, and of those below it.
struct Tables {
    std::string values;   ///< cases of _estampe_value
    std::string commands; ///< cases of what may follow
    std::string options;
    std::string taking; ///< cases of the options that take a value
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

} // namespace estampe::app
