// SPDX-License-Identifier: MIT
#include "techniques/terrain/graph/arguments.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "style/suggest.hpp"

namespace estampe::terrain {
namespace {

/// One call, being sorted.
struct Binding {
    const NodeKind& kind;
    const Expression& call;
    const std::function<double(const Expression&)>& number_of;
    const std::function<void(const Expression&, const std::string&)>& fail;
    Arguments arguments = {};

    [[nodiscard]] std::vector<std::string> names() const
    {
        std::vector<std::string> result;
        for (const NodeParameter& parameter : kind.parameters) {
            result.emplace_back(parameter.name);
        }
        return result;
    }

    [[nodiscard]] const NodeParameter* named(const Argument& argument) const
    {
        const auto found = std::ranges::find(kind.parameters, argument.name, &NodeParameter::name);
        if (found == kind.parameters.end()) {
            const std::string meant = style::nearest(argument.name, names());
            fail(*argument.value, meant.empty() ? fmt::format("{} takes no \"{}\", but {}", kind.name,
                                                              argument.name, fmt::join(names(), ", "))
                                                : fmt::format("{} takes no \"{}\"; did you mean \"{}\"?",
                                                              kind.name, argument.name, meant));
        }
        return &*found;
    }

    [[nodiscard]] bool is_given(const NodeParameter& parameter) const
    {
        return arguments.values.contains(parameter.name) || arguments.numbers.contains(parameter.name) ||
               arguments.texts.contains(parameter.name);
    }

    void take_text(const NodeParameter& parameter, const Expression& given)
    {
        if (given.kind != Expression::Kind::text) {
            fail(given, fmt::format("{} wants a text in quotes for {}", kind.name, parameter.name));
        }
        if (!parameter.words.empty() &&
            std::ranges::find(parameter.words, given.word) == parameter.words.end()) {
            fail(given, fmt::format("{} is one of {}", parameter.name, fmt::join(parameter.words, ", ")));
        }
        arguments.texts[parameter.name] = given.word;
    }

    void take_number(const NodeParameter& parameter, const Expression& given)
    {
        const double number = number_of(given);
        if (!(number >= parameter.minimum && number <= parameter.maximum)) {
            fail(given, fmt::format("{} of {} lies between {} and {}, not at {}", parameter.name, kind.name,
                                    parameter.minimum, parameter.maximum, number));
        }
        arguments.numbers[parameter.name] = number;
    }

    void take(const NodeParameter& parameter, const Argument& argument)
    {
        if (is_given(parameter)) {
            fail(*argument.value, fmt::format("{} is given {} twice", kind.name, parameter.name));
        }
        switch (parameter.form) {
        case ParameterForm::value:
            arguments.values[parameter.name] = argument.value.get();
            break;
        case ParameterForm::number:
            take_number(parameter, *argument.value);
            break;
        case ParameterForm::text:
            take_text(parameter, *argument.value);
            break;
        }
    }

    void fill_in(const NodeParameter& parameter)
    {
        if (is_given(parameter)) {
            return;
        }
        if (parameter.form == ParameterForm::number && parameter.default_number) {
            arguments.numbers[parameter.name] = *parameter.default_number;
        } else if (parameter.form == ParameterForm::text && !parameter.default_text.empty()) {
            arguments.texts[parameter.name] = parameter.default_text;
        } else {
            fail(call, fmt::format("{} wants {}", kind.name, fmt::join(names(), ", ")));
        }
    }
};

} // namespace

Arguments bind_arguments(const NodeKind& kind, const Expression& call,
                         const std::function<double(const Expression&)>& number_of,
                         const std::function<void(const Expression&, const std::string&)>& fail)
{
    Binding binding{.kind = kind, .call = call, .number_of = number_of, .fail = fail};
    size_t place = 0;
    for (const Argument& argument : call.arguments) {
        if (!argument.name.empty()) {
            binding.take(*binding.named(argument), argument);
        } else if (place < kind.parameters.size()) {
            binding.take(kind.parameters[place++], argument);
        } else if (kind.form == NodeForm::curve) {
            binding.arguments.rest.push_back(number_of(*argument.value));
        } else {
            fail(*argument.value,
                 fmt::format("{} takes no more than {}", kind.name, fmt::join(binding.names(), ", ")));
        }
    }
    for (const NodeParameter& parameter : kind.parameters) {
        binding.fill_in(parameter);
    }
    return std::move(binding.arguments);
}

} // namespace estampe::terrain
