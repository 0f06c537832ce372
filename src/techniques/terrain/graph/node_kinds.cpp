// SPDX-License-Identifier: MIT
#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "style/names.hpp"
#include "techniques/terrain/graph/language.hpp"
#include "techniques/terrain/terrain.glsl.h"

namespace estampe::terrain {
namespace {

NodeParameter value(std::string_view name)
{
    return {.name = name};
}

NodeParameter number(std::string_view name, std::optional<double> by_default, double minimum, double maximum)
{
    return {.name = name,
            .form = ParameterForm::number,
            .default_number = by_default,
            .minimum = minimum,
            .maximum = maximum};
}

NodeParameter text(std::string_view name, std::string_view by_default = {},
                   std::vector<std::string_view> words = {})
{
    return {.name = name, .form = ParameterForm::text, .default_text = by_default, .words = std::move(words)};
}

NodeParameter wavelength()
{
    return number("wavelength", {}, 0.001, 1e6);
}

NodeParameter seed()
{
    return number("seed", 0.0, 0.0, 65535.0);
}

std::vector<NodeParameter> octaves()
{
    return {wavelength(), number("octaves", 5.0, 1.0, 16.0), number("gain", 0.4472136, 0.0, 1.0), seed()};
}

std::vector<NodeKind> made_kinds()
{
    using namespace shared; // NOLINT(google-build-using-namespace): the names of the operations
    using enum NodeForm;
    return {
        {"+", arithmetic, height_add, {value("a"), value("b")}, "a + b"},
        {"-", arithmetic, height_subtract, {value("a"), value("b")}, "a - b, or -a"},
        {"*", arithmetic, height_multiply, {value("a"), value("b")}, "a * b"},
        {"/", arithmetic, height_divide, {value("a"), value("b")}, "a / b"},
        {"^",
         arithmetic,
         height_power,
         {value("a"), number("exponent", {}, -64.0, 64.0)},
         "a to the power of a number; 0 if a is not positive"},
        {"min", arithmetic, height_minimum, {value("a"), value("b")}, "The smaller of a and b"},
        {"max", arithmetic, height_maximum, {value("a"), value("b")}, "The larger of a and b"},
        {"lerp",
         arithmetic,
         height_lerp,
         {value("a"), value("b"), value("share")},
         "Linear blend: a for share 0, b for share 1, in proportion between and beyond"},
        {"smoothstep",
         arithmetic,
         height_smoothstep,
         {value("low"), value("high"), value("a")},
         "0 if a is below low, 1 if above high, a smooth rise between"},
        {"sin", arithmetic, height_sine, {value("a")}, "Sine of a in radians"},
        {"cos", arithmetic, height_cosine, {value("a")}, "Cosine of a in radians"},
        {"abs", arithmetic, height_absolute, {value("a")}, "Absolute value of a"},
        {"sqrt", arithmetic, height_root, {value("a")}, "Square root of a; 0 if a is negative"},
        {"curve",
         curve,
         height_curve,
         {value("a")},
         "Smooth curve of a through points x1, y1, x2, y2, ... that does not overshoot; level beyond the "
         "last points"},
        {"sine", leaf, height_wave, {wavelength()}, "Sine wave from -1 to 1 along x"},
        {"noise", leaf, height_noise, {wavelength(), seed()}, "Gradient noise of about -1 to 1"},
        {"fbm", leaf, height_fbm, octaves(),
         "Fractal noise: octaves of noise, each 2.24 times as fine as the one before"},
        {"ridged", leaf, height_ridged, octaves(), "Fractal noise with sharp crests"},
        {"cellular",
         leaf,
         height_cellular,
         {wavelength(), seed()},
         "Distance to the nearest of scattered points, in wavelengths"},
        {"texture",
         texture,
         height_texture,
         {text("file"), number("size", {}, 0.001, 1e7), text("filter", "bicubic", {"bicubic", "bilinear"}),
          text("wrap", "repeat", {"repeat", "mirror", "clamp"})},
         "Picture of 8 or 16 bits, or of floats, with black 0 and white 1, `size` metres wide"},
        {"mask",
         mask,
         height_texture,
         {text("name"), number("size", {}, 0.001, 1e7), number("texels", 256.0, 2.0, 4096.0)},
         "Mask that a program paints by Terrain::paint_mask(): a square around the origin, 0 until painted "
         "and outside"},
        {"sand",
         sand,
         height_texture,
         {number("side", 256.0, 64.0, 1024.0), number("cell", 1.0, 0.05, 20.0),
          number("depth", 4.0, 0.0, 100.0), number("start", 400.0, 0.0, 100000.0),
          number("rate", 0.5, 0.0, 120.0), seed()},
         "Sand that the wind moves in slabs, simulated on a square of `side` cells that repeats; no sand is "
         "lost. `depth` is the mean depth. `start` steps have passed at time 0, then `rate` steps per "
         "second."},
        {"dunes",
         dunes,
         height_dunes,
         {wavelength(), number("height", {}, 0.0, 1000.0), number("celerity", 0.0, -1000.0, 1000.0),
          number("repose", 32.0, 5.0, 60.0), number("windward", 0.8, 0.05, 2.0),
          number("meander", 0.25, 0.0, 0.45), number("variation", 0.6, 0.0, 1.0),
          number("crest", 0.0, 0.0, 1e6), seed()},
         "Dunes across the wind: a gentle rise, a brink, and a slip face at the angle of repose in degrees. "
         "Dunes move with the wind at the celerity in metres per second."},
        {"translate", translate, 0, {value("a"), value("x"), value("z")}, "a moved by x and z metres"},
        {"rotate",
         rotate,
         0,
         {value("a"), number("degrees", {}, -36000.0, 36000.0)},
         "a turned about the origin, from x towards z"},
        {"scale",
         scale,
         0,
         {value("a"), number("x", {}, 1e-6, 1e6), number("z", 0.0, 0.0, 1e6)},
         "a enlarged x times along x and z times along z; without z, x times in both"},
        {"polar",
         polar,
         0,
         {value("a"), number("x", 0.0, -1e7, 1e7), number("z", 0.0, -1e7, 1e7),
          number("radius", 100.0, 0.001, 1e7)},
         "a in polar coordinates around (x, z): x is the distance from there, z the way around at the "
         "radius"},
        {"warp", warp, 0, {value("a"), value("x"), value("z")}, "a looked up x and z metres further on"},
        {"downwind", downwind, 0, {value("a")}, "a turned so that x runs with the wind"},
    };
}

std::string shown(const NodeParameter& parameter)
{
    if (parameter.default_number) {
        return fmt::format("{} = {:.3g}", parameter.name, *parameter.default_number);
    }
    if (!parameter.default_text.empty()) {
        return fmt::format("{} = \"{}\"", parameter.name, parameter.default_text);
    }
    return std::string(parameter.name);
}

} // namespace

std::span<const NodeKind> node_kinds()
{
    static const std::vector<NodeKind> kinds = made_kinds();
    return kinds;
}

std::string signature(const NodeKind& kind)
{
    if (kind.name.size() == 1) {
        return std::string(kind.name);
    }
    std::string arguments;
    for (const NodeParameter& parameter : kind.parameters) {
        arguments += (arguments.empty() ? "" : ", ") + shown(parameter);
    }
    return fmt::format("{}({})", kind.name, arguments);
}

const NodeKind* find_node_kind(std::string_view name)
{
    const auto kinds = node_kinds();
    const auto found = std::ranges::find(kinds, name, &NodeKind::name);
    return found == kinds.end() ? nullptr : &*found;
}

namespace {

/// The arguments of one call while they are assigned to the parameters of its function.
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
