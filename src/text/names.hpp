#pragma once

#include <algorithm>
#include <cstddef>
#include <string_view>

namespace holdfast::program {

/// An enumerator with its name in tables.
template <class Enum>
struct Named {
  Enum value;
  const char* name;
};

/// Name of an enumerator in a list of names; "" if the list lacks the enumerator.
template <class Enum, std::size_t Count>
constexpr const char* name_in(const Named<Enum> (&names)[Count], Enum value) {
  for (const Named<Enum>& one : names)
    if (one.value == value) return one.name;
  return "";
}

/// Pointer to the first element of a list with the given `name`; null if there is none.
template <class List>
auto find_named(const List& list, std::string_view name) {
  const auto found =
      std::find_if(list.begin(), list.end(), [&](const auto& one) { return one.name == name; });
  return found == list.end() ? nullptr : &*found;
}

}  // namespace holdfast::program
