#pragma once

#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>

#include <cstddef>
#include <initializer_list>
#include <memory>
#include <vector>

#include "host/received_table.hpp"

namespace holdfast::python {

namespace nb = nanobind;

/// A NumPy array that owns the numbers of a vector; nothing is copied.
template <class Number>
nb::object array_of(std::vector<Number>&& numbers, const std::vector<std::size_t>& shape) {
  auto* kept = new std::vector<Number>(std::move(numbers));
  const nb::capsule owner(kept,
                          [](void* of) noexcept { delete static_cast<std::vector<Number>*>(of); });
  return nb::cast(nb::ndarray<nb::numpy, Number>(kept->data(), shape.size(), shape.data(), owner));
}
template <class Number>
nb::object array_of(std::vector<Number>&& numbers) {
  const std::size_t size = numbers.size();
  return array_of(std::move(numbers), {size});
}

/// An array whose numbers are still to be written.
template <class Number>
nb::object empty_array(const std::vector<std::size_t>& shape, Number*& numbers) {
  std::size_t size = 1;
  for (const std::size_t extent : shape) size *= extent;
  numbers = new Number[size > 0 ? size : 1];
  program::prefer_large_pages(numbers, size * sizeof(Number));
  const nb::capsule owner(numbers, [](void* of) noexcept { delete[] static_cast<Number*>(of); });
  return nb::cast(nb::ndarray<nb::numpy, Number>(numbers, shape.size(), shape.data(), owner));
}

}  // namespace holdfast::python
