// SPDX-License-Identifier: MIT
#pragma once

// Conversions between numpy arrays and the arrays of the library. Every function that reads an argument names
// the argument in its exception: TypeError for a wrong kind of numbers, ValueError for a wrong shape or
// value, IndexError for an index out of range.

#include <cstdint>
#include <cstring>
#include <initializer_list>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <glm/glm.hpp>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <estampe/scene.hpp>

namespace estampe::python {

namespace py = pybind11;

/// A dense array of floats, in the order of C.
template <typename T>
using Dense = py::array_t<T, py::array::c_style | py::array::forcecast>;

/// Marks a dimension whose length is free in a list of expected lengths.
inline constexpr py::ssize_t any_length = -1;

/// Converts an argument to an array of numbers. `kinds` lists the allowed kinds of numbers as numpy's
/// letters: "f" floats, "i" and "u" integers, "b" booleans. Throws TypeError for anything else.
[[nodiscard]] py::array numbers_of(const py::handle& value, const char* argument, const char* kinds);

/// Checks the shape of an array; `any_length` stands for a free dimension. Throws ValueError.
void check_shape(const py::array& array, const char* argument,
                 std::initializer_list<py::ssize_t> expected_lengths);

/// Converts an argument to dense floats of a shape. Throws ValueError if a number is not
/// finite, or beyond the range of floats.
[[nodiscard]] Dense<float> finite_floats(const py::handle& value, const char* argument,
                                         std::initializer_list<py::ssize_t> expected_lengths);
[[nodiscard]] Dense<double> finite_doubles(const py::handle& value, const char* argument,
                                           std::initializer_list<py::ssize_t> expected_lengths);

/// Converts rows of floats to vectors, such as an array of the shape (n, 3) to n glm::vec3.
template <typename Vector>
std::vector<Vector> rows_of(const py::handle& value, const char* argument, py::ssize_t row_count = any_length)
{
    static_assert(std::is_trivially_copyable_v<Vector> && std::is_same_v<typename Vector::value_type, float>);
    constexpr auto width = static_cast<py::ssize_t>(sizeof(Vector) / sizeof(float));
    const Dense<float> array = finite_floats(value, argument, {row_count, width});
    std::vector<Vector> rows(static_cast<size_t>(array.shape(0)));
    if (!rows.empty()) {
        std::memcpy(static_cast<void*>(rows.data()), array.data(), rows.size() * sizeof(Vector));
    }
    return rows;
}

/// Converts an array of integers to indices below `limit`; `row_width` is the number of columns, and 1 for an
/// array with one dimension. Throws IndexError for an index that is negative or not below `limit`.
[[nodiscard]] std::vector<uint32_t> indices_below(const py::handle& value, const char* argument,
                                                  py::ssize_t row_width, uint64_t limit);

/// Converts a (4, 4) array, which transforms column vectors. Throws ValueError unless its last row is 0 0
/// 0 1.
[[nodiscard]] glm::dmat4 placement_of(const py::handle& value, const char* argument);

/// Converts three numbers, such as a point or a colour.
[[nodiscard]] glm::dvec3 three_numbers(const py::handle& value, const char* argument);

/// Returns the value of a name. Throws ValueError that lists the names if `name` is none of them.
template <typename Value>
Value choice_of(const std::string& name, const char* argument,
                std::initializer_list<std::pair<const char*, Value>> choices)
{
    std::string names;
    for (const auto& [known, value] : choices) {
        if (name == known) {
            return value;
        }
        const char* const separator = names.empty()                         ? ""
                                      : known == (choices.end() - 1)->first ? " or "
                                                                            : ", ";
        names += fmt::format("{}\"{}\"", separator, known);
    }
    throw py::value_error(fmt::format("{}: \"{}\" is not {}", argument, name, names));
}

/// Checks a single number, and returns it. Throws ValueError unless `least` <= number <= `most`.
double number_within(double number, const char* argument, double least, double most);

/// Converts an argument to an integer; a number beyond the range of ssize_t becomes the end of this range.
/// Throws TypeError for a bool and anything else that is no integer; passes on exceptions of __index__().
py::ssize_t integer_of(const py::handle& value, const char* argument);

/// Converts an argument to an index as optional_index() does; None is no_index.
Index index_of(const py::handle& value, const char* argument, size_t count);

/// Checks an index that may be left out. Returns no_index for an empty one. Throws IndexError if the index is
/// not below `count`.
Index optional_index(const std::optional<py::ssize_t>& index, const char* argument, size_t count);

/// Returns an array that owns `values`, without a copy. `values` must hold as many numbers as the shape.
template <typename T, typename Value>
py::array_t<T> array_owning(std::vector<Value>&& values, std::vector<py::ssize_t> shape)
{
    auto owned = std::make_unique<std::vector<Value>>(std::move(values));
    auto* const numbers = reinterpret_cast<T*>(owned->data());
    const py::capsule owner(owned.get(),
                            [](void* pointer) { delete static_cast<std::vector<Value>*>(pointer); });
    // From here on the capsule deletes the vector.
    static_cast<void>(owned.release());
    return py::array_t<T>(std::move(shape), numbers, owner);
}

/// Returns a (height, width, 4) array of an image whose numbers belong to the Python object `owner`.
template <typename T>
py::array_t<T> pixels_within(const T* pixels, uint32_t width, uint32_t height, const py::handle& owner)
{
    return py::array_t<T>({static_cast<py::ssize_t>(height), static_cast<py::ssize_t>(width), py::ssize_t{4}},
                          pixels, owner);
}

} // namespace estampe::python
