// SPDX-License-Identifier: MIT
#include "arrays.hpp"

#include <cmath>
#include <cstring>
#include <utility>

#include <fmt/format.h>

namespace estampe::python {
namespace {

std::string shape_text(const py::array& array)
{
    std::string text;
    for (py::ssize_t axis = 0; axis < array.ndim(); ++axis) {
        text += fmt::format("{}{}", axis == 0 ? "" : ", ", array.shape(axis));
    }
    return "(" + text + (array.ndim() == 1 ? ",)" : ")");
}

std::string expected_text(std::initializer_list<py::ssize_t> lengths)
{
    std::string text;
    char name = 'n';
    for (const py::ssize_t length : lengths) {
        if (!text.empty()) {
            text += ", ";
        }
        text += length == any_length ? std::string(1, name++) : std::to_string(length);
    }
    return "(" + text + (lengths.size() == 1 ? ",)" : ")");
}

template <typename T>
Dense<T> dense_of(const py::array& array, const char* argument)
{
    Dense<T> dense = Dense<T>::ensure(array);
    if (!dense) {
        PyErr_Clear();
        throw py::type_error(fmt::format("{}: the array cannot be converted to floats", argument));
    }
    return dense;
}

template <typename T>
void check_finite(const Dense<T>& array, const char* argument)
{
    const T* const numbers = array.data();
    for (py::ssize_t i = 0; i < array.size(); ++i) {
        if (!std::isfinite(static_cast<float>(numbers[i]))) {
            throw py::value_error(fmt::format("{}: number {} of the array is not finite", argument, i));
        }
    }
}

[[noreturn]] void fail_index(const char* argument, const std::string& index, uint64_t limit)
{
    throw py::index_error(limit == 0
                              ? fmt::format("{}: index {}, but there is nothing to refer to", argument, index)
                              : fmt::format("{}: index {} is not 0 to {}", argument, index, limit - 1));
}

/// Copies integers to indices, and checks each.
template <typename T>
std::vector<uint32_t> checked_indices(const Dense<T>& array, const char* argument, uint64_t limit)
{
    std::vector<uint32_t> indices(static_cast<size_t>(array.size()));
    const T* const numbers = array.data();
    for (size_t i = 0; i < indices.size(); ++i) {
        if (std::cmp_less(numbers[i], 0) || std::cmp_greater_equal(numbers[i], limit)) {
            fail_index(argument, std::to_string(numbers[i]), limit);
        }
        indices[i] = static_cast<uint32_t>(numbers[i]);
    }
    return indices;
}

} // namespace

py::array numbers_of(const py::handle& value, const char* argument, const char* kinds)
{
    py::array array = py::array::ensure(value);
    if (!array) {
        PyErr_Clear();
        throw py::type_error(fmt::format("{}: is not an array of numbers", argument));
    }
    const char kind = array.dtype().kind();
    // An empty list has the type float64, whatever it is meant to hold.
    if (array.size() > 0 && std::strchr(kinds, kind) == nullptr) {
        const std::string type = py::str(array.dtype());
        throw py::type_error(fmt::format("{}: has the type {}, which is not {}", argument, type,
                                         std::strchr(kinds, 'f') != nullptr ? "a type of real numbers"
                                                                            : "a type of integers"));
    }
    if (std::strchr("fiub", kind) == nullptr) {
        throw py::type_error(fmt::format("{}: is not an array of numbers", argument));
    }
    return array;
}

void check_shape(const py::array& array, const char* argument,
                 std::initializer_list<py::ssize_t> expected_lengths)
{
    bool is_right = array.ndim() == static_cast<py::ssize_t>(expected_lengths.size());
    py::ssize_t axis = 0;
    for (const py::ssize_t length : expected_lengths) {
        is_right = is_right && (length == any_length || array.shape(axis) == length);
        ++axis;
    }
    if (!is_right) {
        throw py::value_error(fmt::format("{}: has the shape {} instead of {}", argument, shape_text(array),
                                          expected_text(expected_lengths)));
    }
}

Dense<float> finite_floats(const py::handle& value, const char* argument,
                           std::initializer_list<py::ssize_t> expected_lengths)
{
    const py::array array = numbers_of(value, argument, "fiu");
    check_shape(array, argument, expected_lengths);
    if (array.itemsize() > static_cast<py::ssize_t>(sizeof(float))) {
        // Beyond the range of floats numpy would warn; here it is an error.
        const Dense<double> wide = dense_of<double>(array, argument);
        check_finite(wide, argument);
        return dense_of<float>(wide, argument);
    }
    Dense<float> dense = dense_of<float>(array, argument);
    check_finite(dense, argument);
    return dense;
}

Dense<double> finite_doubles(const py::handle& value, const char* argument,
                             std::initializer_list<py::ssize_t> expected_lengths)
{
    const py::array array = numbers_of(value, argument, "fiu");
    check_shape(array, argument, expected_lengths);
    Dense<double> dense = dense_of<double>(array, argument);
    check_finite(dense, argument);
    return dense;
}

std::vector<uint32_t> indices_below(const py::handle& value, const char* argument, py::ssize_t row_width,
                                    uint64_t limit)
{
    const py::array array = numbers_of(value, argument, "iu");
    if (row_width == 1 && array.ndim() == 1) {
        check_shape(array, argument, {any_length});
    } else {
        check_shape(array, argument, {any_length, row_width});
    }
    if (array.dtype().kind() == 'u') {
        return checked_indices(Dense<uint64_t>::ensure(array), argument, limit);
    }
    return checked_indices(Dense<int64_t>::ensure(array), argument, limit);
}

glm::dmat4 placement_of(const py::handle& value, const char* argument)
{
    const Dense<double> array = finite_doubles(value, argument, {4, 4});
    glm::dmat4 matrix(1.0);
    for (int row = 0; row < 4; ++row) {
        for (int column = 0; column < 4; ++column) {
            matrix[column][row] = array.at(row, column);
        }
    }
    if (array.at(3, 0) != 0.0 || array.at(3, 1) != 0.0 || array.at(3, 2) != 0.0 || array.at(3, 3) != 1.0) {
        throw py::value_error(fmt::format(
            "{}: the last row is not 0 0 0 1; the translation belongs into the last column", argument));
    }
    return matrix;
}

glm::dvec3 three_numbers(const py::handle& value, const char* argument)
{
    const Dense<double> array = finite_doubles(value, argument, {3});
    return {array.at(0), array.at(1), array.at(2)};
}

double number_within(double number, const char* argument, double least, double most)
{
    if (!(number >= least && number <= most)) {
        throw py::value_error(
            std::isinf(most)
                ? fmt::format("{}: {} is not a finite number of at least {}", argument, number, least)
                : fmt::format("{}: {} is not {} to {}", argument, number, least, most));
    }
    if (!std::isfinite(number)) {
        throw py::value_error(fmt::format("{}: is not finite", argument));
    }
    return number;
}

py::ssize_t integer_of(const py::handle& value, const char* argument)
{
    if (!PyIndex_Check(value.ptr()) || PyBool_Check(value.ptr())) {
        throw py::type_error(fmt::format("{}: is not an integer", argument));
    }
    const py::ssize_t number = PyNumber_AsSsize_t(value.ptr(), nullptr);
    if (number == -1 && PyErr_Occurred() != nullptr) {
        throw py::error_already_set();
    }
    return number;
}

Index index_of(const py::handle& value, const char* argument, size_t count)
{
    return value.is_none() ? no_index : optional_index(integer_of(value, argument), argument, count);
}

Index optional_index(const std::optional<py::ssize_t>& index, const char* argument, size_t count)
{
    if (!index) {
        return no_index;
    }
    if (*index < 0 || static_cast<size_t>(*index) >= count) {
        fail_index(argument, std::to_string(*index), count);
    }
    return static_cast<Index>(*index);
}

} // namespace estampe::python
