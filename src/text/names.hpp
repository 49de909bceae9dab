#pragma once

#include <algorithm>
#include <cstddef>
#include <string_view>

namespace holdfast::program {

/// An enumerator and what it is called in tables.
template <class Enum>
struct Named {
  Enum value;
  const char* name;
};

/// Name of the value in the list, which has every enumerator.
template <class Enum, std::size_t Count>
constexpr const char* name_in(const Named<Enum> (&names)[Count], Enum value) {
  for (const Named<Enum>& one : names)
    if (one.value == value) return one.name;
  return "";
}

/// The first of a list that bears the name, or null.
template <class List>
auto find_named(const List& list, std::string_view name) {
  const auto found =
      std::find_if(list.begin(), list.end(), [&](const auto& one) { return one.name == name; });
  return found == list.end() ? nullptr : &*found;
}

}  // namespace holdfast::program
