#pragma once

#include <string>

#include "case/case.hpp"
#include "holdfast/contact/contact.hpp"

namespace holdfast::program {

/// A warning of too few modes or bars and of keys without effect on the plant; empty otherwise.
std::string modes_warning(const Case& the_case);

/// A warning that a motion beyond the paper's model takes minutes, since its work grows with the
/// third power of the number of modes; empty otherwise.
std::string dense_work_warning(const Case& the_case, Switching switching);

/// Warning that peaks include the rigid drift of a string without ends; else empty.
std::string drift_warning(const Case& the_case);

}  // namespace holdfast::program
