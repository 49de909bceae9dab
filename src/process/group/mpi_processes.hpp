#pragma once

#include <memory>

#include "process/group/process_group.hpp"

namespace holdfast::program {

/// Starts MPI and joins the processes that its launcher started together. Where MPI cannot start
/// at all it says so itself and ends the process.
///
/// Throws NoAnswer where the program is built without MPI, and in MPI's words where it fails;
/// std::logic_error at the second call, since MPI starts once per process.
std::unique_ptr<ProcessGroup> mpi_processes();

}  // namespace holdfast::program
