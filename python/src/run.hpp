#pragma once

#include <nanobind/nanobind.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include <string>
#include <tuple>
#include <vector>

#include "case_in_memory.hpp"

namespace holdfast::python {

/// Runs a job by its command line (`["orbit", "--trace"]`) on a case.
/// @param watch       None, or called with the steps done and all of them while the job runs
/// @param controller  None; a callable (k, t, displacement, velocity) -> force; or a tuple of the
///                    address of a compiled one and that of its data or None
/// @param force       None, or a tuple of instants (s), forces (N) and whether they are held
/// @return tables, each a dict, and warnings
nb::tuple run_job(const CaseInMemory& the_case, std::vector<std::string> arguments,
                  nb::object watch, nb::object controller, nb::object force);

/// The numbers of an axis: its ends and how many there are.
using AxisTuple = std::tuple<double, double, std::int64_t>;

/// The chart of the job `stability` over P and D, straight into arrays: stable (bool), spectral
/// radius or None; warnings; and the values of the two axes.
nb::tuple chart(const CaseInMemory& the_case, AxisTuple proportional, AxisTuple differential,
                bool radius, int threads, const std::string& instructions, nb::object watch);

}  // namespace holdfast::python
