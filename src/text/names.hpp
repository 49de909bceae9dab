#pragma once

#include <cstddef>

namespace holdfast::program {

/// An enumerator and what it is called in tables.
template <class Enum>
struct Named {
  Enum value;
  const char* name;
};

/// What the list, which has every enumerator, calls the value.
template <class Enum, std::size_t Count>
constexpr const char* name_in(const Named<Enum> (&names)[Count], Enum value) {
  for (const Named<Enum>& one : names)
    if (one.value == value) return one.name;
  return "";
}

}  // namespace holdfast::program
