#pragma once

#include <string>

#include "case/case.hpp"
#include "holdfast/contact/contact.hpp"

namespace holdfast::program {

/// Warning of the modes that are kept, beside half the sampling rate, and of keys that do not count
/// for the case's plant. Empty where there is nothing.
std::string modes_warning(const Case& the_case);

/// That a motion beyond the paper's model takes minutes, its work growing with the third power of
/// the modes; empty where it does not.
std::string dense_work_warning(const Case& the_case, Switching switching);

/// That the peaks of a motion count its drift, of a string without ends; else empty.
std::string drift_warning(const Case& the_case);

}  // namespace holdfast::program
