// SPDX-License-Identifier: MIT
#pragma once

// The parameters of a style: their descriptions, their values, and overrides for single surfaces.

#include <algorithm>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include <glm/glm.hpp>

namespace estampe::style {

/// Converts an sRGB-encoded colour to a linear one, components 0..1 (IEC 61966-2-1).
[[nodiscard]] glm::vec3 linear_from_srgb(const glm::dvec3& srgb);

/// Converts a linear colour to sRGB encoding, components 0..1.
[[nodiscard]] glm::dvec3 srgb_from_linear(const glm::vec3& linear);

/// Converts 0xrrggbb in sRGB to a linear colour: `glm::vec3 ink = style::srgb(0x1b1a22);`
[[nodiscard]] glm::vec3 srgb(uint32_t rrggbb);

/// Returns the linear colour of a CSS colour name such as "ivory" (CSS Color Module Level 4); nothing for an
/// unknown name.
[[nodiscard]] std::optional<glm::vec3> named_color(std::string_view name);

/// Returns the CSS colour name nearest to `name`; empty if no name is similar enough.
[[nodiscard]] std::string nearest_color_name(std::string_view name);

/// Formats a linear colour as a TOML value: a quoted "#rrggbb" if this gives exactly the same colour,
/// otherwise [r, g, b] in sRGB with enough digits to read back the same three floats.
[[nodiscard]] std::string format_color(const glm::vec3& linear);

enum class Kind : uint8_t { number, integer, toggle, color, choice, text, file };

/// Where a parameter may have another value than for the whole picture: nowhere, by object, or by object and
/// material.
enum class Overridable : uint8_t {
    nowhere,
    by_object,  ///< The parameter may differ for single objects and lights
    by_surface, ///< The parameter may differ for single objects and single materials
};

/// A parameter's value without its C++ type. A colour is linear; a choice is stored as its name, a file as
/// its path.
using Value = std::variant<float, int64_t, bool, glm::vec3, std::string>;

/// Range of a numeric parameter's allowed values, both ends included.
struct Range {
    float minimum = 0.0F;
    float maximum = 1.0F;
};

struct IntegerRange {
    int64_t minimum = 0;
    int64_t maximum = 1;
};

/// A switch that may depend on the scene. Style files write its values as true, false and "auto".
enum class AutoToggle : uint8_t { automatic, on, off };

/// Accesses the member `inner` of the member `outer` of a style struct. Use it with the methods of Table:
/// `.number("outline.width_mm", within(&ContourStyle::outline, &LineStyle::width_mm), ...)`.
template <typename Style, typename Outer, typename Inner>
[[nodiscard]] auto within(Outer Style::*outer, Inner Outer::*inner)
{
    return [ outer, inner ](auto& style) -> auto&
    {
        return (style.*outer).*inner;
    };
}

/// The description of one style parameter. `get` and `set` take a pointer to the style struct of the
/// parameter's table; `set` requires a value of the right kind and within the range.
struct Parameter {
    /// Name of the parameter without its section; "outline.width_mm" is in the table `outline` of the
    /// section.
    std::string key;
    Kind kind = Kind::number;
    Range range;           ///< allowed values of a number; unused for other parameters
    IntegerRange integers; ///< allowed values of an integer; unused for other parameters
    /// Names that are allowed: for a choice all of its values, in the order of the table; for a file or
    /// colour the names accepted instead of a path or a colour.
    std::vector<std::string> choices;
    std::string unit; ///< unit of the value, such as "mm", "px" or "deg"; empty for none
    std::string help; ///< help text as a full clause, because it is also shown as a tooltip
    Overridable overridable = Overridable::nowhere;
    Value default_value;
    std::function<Value(const void*)> get;
    std::function<void(void*, const Value&)> set;
};

/// The parameters of one style struct, each described once, in the order in which the manual lists them.
///
///     struct HatchStyle {
///         float width_mm = 0.35F;
///         bool cross = true;
///         glm::vec3 ink = style::srgb(0x1b1a22);
///     };
///
///     inline const style::Table<HatchStyle>& hatch_table()
///     {
///         static const auto table = style::Table<HatchStyle>("hatch", "Pen strokes that carry the tone")
///             .number("width_mm", &HatchStyle::width_mm, {0.02F, 10.0F}, "mm", "Width of one stroke")
///             .toggle("cross", &HatchStyle::cross, "Turns crossing layers of strokes on")
///             .color("ink", &HatchStyle::ink, "Colour of the ink");
///         return table;
///     }
///
/// A member is a pointer to a member of the struct, or the result of within(). The defaults are those of a
/// default-constructed Style; they must lie within the ranges (Schema asserts it).
template <typename Style>
class Table {
public:
    Table(std::string section, std::string help) : section_(std::move(section)), help_(std::move(help)) {}

    [[nodiscard]] const std::string& section() const { return section_; }

    [[nodiscard]] const std::string& help() const { return help_; }

    [[nodiscard]] const std::vector<Parameter>& parameters() const { return parameters_; }

    /// Adds a parameter that is a number. Style files may also write an integer for it. A value that is not
    /// finite or out of `range` is an error.
    template <typename Member>
    Table& number(std::string key, Member member, Range range, std::string unit, std::string help)
    {
        Parameter& parameter = add(std::move(key), Kind::number, std::move(unit), std::move(help));
        parameter.range = range;
        connect<float>(parameter, member);
        return *this;
    }

    /// Adds a parameter that is a whole number, with an int or uint32_t member.
    template <typename Member>
    Table& integer(std::string key, Member member, IntegerRange range, std::string unit, std::string help)
    {
        Parameter& parameter = add(std::move(key), Kind::integer, std::move(unit), std::move(help));
        parameter.integers = range;
        connect<int64_t>(parameter, member);
        return *this;
    }

    /// Adds a parameter that is a switch, with the values true and false.
    template <typename Member>
    Table& toggle(std::string key, Member member, std::string help)
    {
        connect<bool>(add(std::move(key), Kind::toggle, {}, std::move(help)), member);
        return *this;
    }

    /// Adds a parameter that is a switch with the values true, false and "auto"; with "auto" the scene
    /// decides.
    Table& auto_toggle(std::string key, AutoToggle Style::*member, std::string help)
    {
        return choice(std::move(key), member,
                      {{"auto", AutoToggle::automatic}, {"true", AutoToggle::on}, {"false", AutoToggle::off}},
                      std::move(help));
    }

    /// Adds a colour parameter: linear in the struct; in style files "#rrggbb", a CSS colour name, or sRGB
    /// [r, g, b] from 0 to 1.
    template <typename Member>
    Table& color(std::string key, Member member, std::string help)
    {
        connect<glm::vec3>(add(std::move(key), Kind::color, {}, std::move(help)), member);
        return *this;
    }

    /// Adds a colour parameter that may be "auto". The member has the type std::optional<glm::vec3>, and is
    /// empty if the value is "auto".
    template <typename Member>
    Table& color_or_auto(std::string key, Member member, std::string help)
    {
        Parameter& parameter = add(std::move(key), Kind::color, {}, std::move(help));
        parameter.choices = {"auto"};
        parameter.get = [member](const void* style) -> Value {
            const std::optional<glm::vec3>& held = std::invoke(member, *static_cast<const Style*>(style));
            return held ? Value(*held) : Value(std::string("auto"));
        };
        parameter.set = [member](void* style, const Value& value) {
            const auto* const color = std::get_if<glm::vec3>(&value);
            std::invoke(member, *static_cast<Style*>(style)) = color ? std::optional(*color) : std::nullopt;
        };
        parameter.default_value = parameter.get(&defaults_);
        return *this;
    }

    /// Adds a parameter that is a choice between names, one name per value of an enumeration.
    template <typename Member,
              typename Enum = std::remove_cvref_t<std::invoke_result_t<const Member&, Style&>>>
    Table& choice(std::string key, Member member, std::vector<std::pair<std::string, Enum>> names,
                  std::string help)
    {
        Parameter& parameter = add(std::move(key), Kind::choice, {}, std::move(help));
        for (const auto& name : names) {
            parameter.choices.push_back(name.first);
        }
        parameter.get = [member, names](const void* style) -> Value {
            const Enum held = std::invoke(member, *static_cast<const Style*>(style));
            for (const auto& [name, value] : names) {
                if (value == held) {
                    return name;
                }
            }
            return std::string();
        };
        parameter.set = [member, names](void* style, const Value& chosen) {
            for (const auto& [name, value] : names) {
                if (name == std::get<std::string>(chosen)) {
                    std::invoke(member, *static_cast<Style*>(style)) = value;
                }
            }
        };
        parameter.default_value = parameter.get(&defaults_);
        return *this;
    }

    /// Adds a parameter that is a text. The schema does not check the text; the code of the technique
    /// interprets it.
    template <typename Member>
    Table& text(std::string key, Member member, std::string help)
    {
        connect<std::string>(add(std::move(key), Kind::text, {}, std::move(help)), member);
        return *this;
    }

    /// Adds a parameter that is the path of a file. In a TOML file the path is relative to that file's
    /// folder.
    Table& file(std::string key, std::string Style::*member, std::string help)
    {
        connect<std::string>(add(std::move(key), Kind::file, {}, std::move(help)), member);
        return *this;
    }

    /// Adds a parameter that is one of several names or the path of a file; see file(). An empty text is
    /// allowed.
    template <typename Member>
    Table& file_or_name(std::string key, Member member, std::vector<std::string> names, std::string help)
    {
        Parameter& parameter = add(std::move(key), Kind::file, {}, std::move(help));
        parameter.choices = std::move(names);
        connect<std::string>(parameter, member);
        return *this;
    }

    /// Allows the parameters with the given keys to differ between materials and between objects.
    Table& by_surface(const std::vector<std::string>& keys)
    {
        return allow(Overridable::by_surface, keys, true);
    }

    /// Allows all parameters except the given keys to differ between materials and between objects.
    Table& by_surface_but(const std::vector<std::string>& keys)
    {
        return allow(Overridable::by_surface, keys, false);
    }

    /// Allows the parameters with the given keys to differ between objects.
    Table& by_object(const std::vector<std::string>& keys)
    {
        return allow(Overridable::by_object, keys, true);
    }

    /// Allows all parameters except the given keys to differ between objects.
    Table& by_object_but(const std::vector<std::string>& keys)
    {
        return allow(Overridable::by_object, keys, false);
    }

private:
    Table& allow(Overridable overridable, const std::vector<std::string>& keys, bool is_listed)
    {
        for (Parameter& parameter : parameters_) {
            if ((std::ranges::find(keys, parameter.key) != keys.end()) == is_listed) {
                parameter.overridable = overridable;
            }
        }
        return *this;
    }

    Parameter& add(std::string key, Kind kind, std::string unit, std::string help)
    {
        Parameter& parameter = parameters_.emplace_back();
        parameter.key = std::move(key);
        parameter.kind = kind;
        parameter.unit = std::move(unit);
        parameter.help = std::move(help);
        return parameter;
    }

    template <typename Held, typename Member>
    void connect(Parameter& parameter, Member member)
    {
        parameter.get = [member](const void* style) -> Value {
            return static_cast<Held>(std::invoke(member, *static_cast<const Style*>(style)));
        };
        parameter.set = [member](void* style, const Value& value) {
            auto& held = std::invoke(member, *static_cast<Style*>(style));
            held = static_cast<std::remove_cvref_t<decltype(held)>>(std::get<Held>(value));
        };
        parameter.default_value = parameter.get(&defaults_);
    }

    std::string section_;
    std::string help_;
    Style defaults_{};
    std::vector<Parameter> parameters_;
};

/// The surfaces to which an override of a style applies.
struct Surfaces {
    enum class By : uint8_t {
        all,      ///< all surfaces of the picture
        material, ///< surfaces with a material whose name matches `pattern`
        object,   ///< nodes whose name matches `pattern`, and their children
    };

    By by = By::all;
    std::string pattern; ///< name with wildcards as in a shell: `brick*`, `pane_?`, `[AB]_wall`

    bool operator==(const Surfaces&) const = default;
};

/// Returns whether `name` matches `pattern` with its wildcards.
[[nodiscard]] bool matches(const std::string& pattern, const std::string& name);

/// An override: a parameter's value on some surfaces, used there in place of the value for the whole picture.
/// If several overrides apply to a surface, the last one is used.
struct Override {
    Surfaces surfaces;
    std::string section;
    std::string key;
    Value value;

    bool operator==(const Override&) const = default;
};

} // namespace estampe::style
