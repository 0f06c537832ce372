// SPDX-License-Identifier: MIT
#include "registry.hpp"

#include <algorithm>
#include <set>
#include <utility>

#include <fmt/format.h>

#include <estampe/error.hpp>

namespace worlds {
namespace {

bool is_simple_name(std::string_view name)
{
    const auto is_allowed = [](char letter) {
        return (letter >= 'a' && letter <= 'z') || (letter >= '0' && letter <= '9') || letter == '-';
    };
    return !name.empty() && name.front() != '-' && std::ranges::all_of(name, is_allowed);
}

} // namespace

void Registry::add(Description description)
{
    if (!is_simple_name(description.name)) {
        throw estampe::Error(fmt::format("a world cannot be named \"{}\"", description.name), {},
                             "use lower-case letters, digits and hyphens");
    }
    if (find(description.name) != nullptr) {
        throw estampe::Error("there are two worlds of this name", description.name);
    }
    if (!description.make) {
        throw estampe::Error("the world has no function that makes it", description.name);
    }
    std::set<std::string> keys;
    for (const Option& option : description.options) {
        if (!is_simple_name(option.key) || !keys.insert(option.key).second) {
            throw estampe::Error(
                fmt::format("the option \"{}\" is there twice, or cannot have this key", option.key),
                description.name, "use lower-case letters, digits and hyphens");
        }
    }
    static_cast<void>(Values(description.options, {})); // throws for an initial value that is not allowed
    all_.push_back(std::move(description));
}

const Description* Registry::find(std::string_view name) const
{
    const auto found = std::ranges::find(all_, name, &Description::name);
    return found != all_.end() ? &*found : nullptr;
}

} // namespace worlds
