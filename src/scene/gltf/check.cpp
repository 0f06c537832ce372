// SPDX-License-Identifier: MIT
#include "scene/gltf/check.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <string_view>

#include <fmt/format.h>

#include <estampe/error.hpp>

#include "scene/gltf/check_rules.hpp"

namespace estampe::gltf {
namespace {

using nlohmann::json;

class Checker {
public:
    Checker(const json& root, const std::string& file) : root_(root), place_(file + "#") {}

    void object(json& value, std::string_view schema)
    {
        expect(value.is_object(), "should be an object");
        for (const Rule& rule : rules_of(schema)) {
            const auto member = value.find(rule.key);
            if (member == value.end()) {
                expect(!rule.required, fmt::format("lacks \"{}\"", rule.key));
                continue;
            }
            const Step step(place_, rule.key);
            property(*member, rule);
        }
    }

private:
    /// Adds one step to the JSON pointer while it lives.
    class Step {
    public:
        template <typename Key>
        Step(std::string& place, const Key& key) : place_(place), length_(place.size())
        {
            place_ += '/';
            for (const char character : fmt::format("{}", key)) {
                place_ += character == '~'   ? "~0"
                          : character == '/' ? "~1"
                                             : std::string(1, printable(character));
            }
        }

        ~Step() { place_.resize(length_); }

        Step(const Step&) = delete;
        Step& operator=(const Step&) = delete;

    private:
        static char printable(char character)
        {
            return static_cast<unsigned char>(character) < 0x20 ? '?' : character;
        }

        std::string& place_;
        size_t length_;
    };

    void expect(bool good, const std::string& what) const
    {
        if (!good) {
            throw Error(what, place_);
        }
    }

    void property(json& value, const Rule& rule)
    {
        switch (rule.kind) {
        case Kind::index:
            index(value, rule.target);
            break;
        case Kind::integer:
            integer(value, rule.min, rule.max);
            break;
        case Kind::number:
            number(value, rule.min, rule.max);
            break;
        case Kind::text:
            expect(value.is_string(), "should be a string");
            break;
        case Kind::boolean:
            expect(value.is_boolean(), "should be true or false");
            break;
        case Kind::choice:
            choice(value, rule.target);
            break;
        case Kind::object:
            object(value, rule.target);
            break;
        case Kind::index_map:
            index_map(value, rule.target);
            break;
        case Kind::list:
            list(value, rule);
            break;
        }
    }

    void list(json& value, const Rule& rule)
    {
        expect(value.is_array(), "should be an array");
        if (rule.length >= 0) {
            expect(value.size() == static_cast<size_t>(rule.length),
                   fmt::format("should have {} entries, not {}", rule.length, value.size()));
        }
        Rule entry = rule;
        entry.kind = rule.entry;
        for (size_t i = 0; i < value.size(); ++i) {
            const Step step(place_, i);
            property(value[i], entry);
        }
    }

    void number(const json& value, double min, double max) const
    {
        expect(value.is_number(), "should be a number");
        const auto number = value.get<double>();
        expect(number >= min && number <= max, fmt::format("is {}, outside {} to {}", number, min, max));
    }

    void integer(json& value, double min, double max) const
    {
        expect(value.is_number(), "should be an integer");
        const auto number = value.get<double>();
        expect(std::floor(number) == number, fmt::format("is {}, not an integer", number));
        expect(number >= min && number <= max, fmt::format("is {}, outside {} to {}", number, min, max));
        if (value.is_number_float()) {
            value = static_cast<int64_t>(number);
        }
    }

    /// `target` is a path from the root to an array, such as "extensions/KHR_lights_punctual/lights".
    void index(json& value, const std::string& target) const
    {
        integer(value, -max_count, max_count);
        const json::json_pointer pointer("/" + target);
        const size_t count = root_.contains(pointer) ? root_.at(pointer).size() : 0;
        const auto at = value.get<int64_t>();
        expect(at >= 0 && static_cast<uint64_t>(at) < count,
               fmt::format("index {} is outside \"{}\", which has {}", at, target, count));
    }

    void choice(const json& value, const std::string& allowed) const
    {
        const std::string text = value.is_string() ? value.get<std::string>() : value.dump();
        const bool known = !text.empty() && text.find(' ') == std::string::npos &&
                           (" " + allowed + " ").find(" " + text + " ") != std::string::npos;
        expect(known, fmt::format("is {}, not one of: {}", value.dump(-1, ' ', true).substr(0, 80), allowed));
    }

    void index_map(json& value, const std::string& target)
    {
        expect(value.is_object(), "should be an object");
        for (auto& [key, entry] : value.items()) {
            const Step step(place_, key);
            index(entry, target);
        }
    }

    const json& root_;
    std::string place_;
};

/// A camera carries the object that its type names.
void check_cameras(const json& document, const std::string& file)
{
    const json cameras = document.value("cameras", json::array());
    for (size_t i = 0; i < cameras.size(); ++i) {
        const auto type = cameras[i]["type"].get<std::string>();
        if (!cameras[i].contains(type)) {
            throw Error(fmt::format("lacks \"{}\"", type), fmt::format("{}#/cameras/{}", file, i));
        }
    }
}

void check_strides(const json& document, const std::string& file)
{
    const json views = document.value("bufferViews", json::array());
    for (size_t i = 0; i < views.size(); ++i) {
        const int stride = views[i].value("byteStride", 0);
        if (stride % 4 != 0) {
            throw Error(fmt::format("is {}, not a multiple of 4", stride),
                        fmt::format("{}#/bufferViews/{}/byteStride", file, i));
        }
    }
}

} // namespace

void check_document(json& document, const std::string& file)
{
    Checker(document, file).object(document, "root");
    check_cameras(document, file);
    check_strides(document, file);
}

} // namespace estampe::gltf
