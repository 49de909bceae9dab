#include <dlfcn.h>
#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "case/case_file.hpp"
#include "case_in_memory.hpp"
#include "explorer/explorer_page.hpp"
#include "job.hpp"
#include "process/errors.hpp"
#include "process/interrupt.hpp"
#include "run.hpp"

// What holdfast._core has: cases in memory, plants of the user's own, and the program's jobs on
// them. The pythonic layer of the package stands on it.

namespace holdfast::python {
namespace {

using namespace nb::literals;

void translate_errors(nb::module_& module) {
  const nb::object no_answer =
      nb::exception<program::NoAnswer>(module, "NoAnswer", PyExc_RuntimeError);
  no_answer.attr("__doc__") =
      "The question is fair and the computation has no answer to it; the message says why.";
  no_answer.attr("__module__") = "holdfast";
  nb::register_exception_translator([](const std::exception_ptr& fault, void*) {
    try {
      std::rethrow_exception(fault);
    } catch (const program::WrongInput& error) {
      PyErr_SetString(PyExc_ValueError, error.what());
    } catch (const InvalidParameter& error) {
      PyErr_SetString(PyExc_ValueError, error.what());
    } catch (const program::OutputError& error) {
      PyErr_SetString(PyExc_OSError, error.what());
    } catch (const program::Interrupted&) {
      PyErr_SetNone(PyExc_KeyboardInterrupt);
    }
  });
}

/// The folder of this extension; empty where the system does not tell.
std::filesystem::path own_folder() {
  Dl_info found;
  if (dladdr(reinterpret_cast<const void*>(&translate_errors), &found) == 0) return {};
  return std::filesystem::absolute(found.dli_fname).parent_path();
}

/// The whole program on a command line, with its own output and signals; its exit code.
int run_program(std::vector<std::string> words) {
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  const nb::gil_scoped_release released;
  program::install_signal_handlers();
  return program::run_program(static_cast<int>(arguments.size()), arguments.data());
}

}  // namespace

NB_MODULE(_core, module) {
  module.doc() = "The compiled part of holdfast: its names may change, those of holdfast do not.";
  translate_errors(module);
  program::look_for_explorer_page_in(own_folder());
  module.attr("version") = HOLDFAST_VERSION;
  module.def("run_program", &run_program, "arguments"_a,
             "The command-line program; its exit code. arguments[0] is its name.");

  nb::class_<OwnPlant>(module, "OwnPlant",
                       "A linear plant of the user's own: matrices and ports, checked.")
      .def(nb::init<const PlantArrays&>(), "arrays"_a);
  nb::class_<PlantArrays>(module, "PlantArrays", "What an OwnPlant is made of.")
      .def(nb::init<Square, Row, Row, Row, Row, Row, Row, Row, Row, Row>(), "state_matrix"_a,
           "command_input"_a, "excitation_input"_a, "displacement"_a, "velocity"_a,
           "relative_displacement"_a, "relative_velocity"_a, "displacement_lift"_a,
           "velocity_lift"_a, "initial_state"_a);

  nb::class_<CaseInMemory>(module, "Case", "A case, checked: what a case file says.")
      .def(nb::init<std::optional<std::string>, std::string, std::vector<std::string>,
                    const OwnPlant*>(),
           "text"_a.none(), "name"_a, "overrides"_a, "plant"_a.none() = nb::none())
      .def("with_overrides", &CaseInMemory::with, "overrides"_a,
           "The case with further key=value texts behind its own.")
      .def("toml", &CaseInMemory::toml, "The whole case as a case file.")
      .def("json", &CaseInMemory::json, "The whole case as JSON.")
      .def("origin", &CaseInMemory::origin, "job"_a, "options"_a, "instructions"_a,
           "What made a table of a job on packs, as JSON.")
      .def("has_own_plant", &CaseInMemory::has_own_plant)
      .def(
          "source",
          [](const CaseInMemory& the_case) {
            const program::CaseSource& source = the_case.source();
            return std::make_tuple(source.text, source.name, source.overrides);
          },
          "What the case is read from: text of a case file or None, its name, key=value texts.")
      .def("plant_matrices", &CaseInMemory::plant_matrices,
           "The linear plant of the case with filter and drive: arrays by name.");

  module.def("run_job", &run_job, "case"_a, "arguments"_a, "watch"_a.none() = nb::none(),
             "controller"_a.none() = nb::none(), "force"_a.none() = nb::none(),
             "A job by its command line: its tables and its warnings.");
  module.def(
      "chart", &chart, "case"_a, "proportional"_a, "differential"_a, "radius"_a, "threads"_a,
      "instructions"_a, "watch"_a.none() = nb::none(),
      "The chart of the job stability, straight into arrays: stable, radius, warnings, axes.");
}

}  // namespace holdfast::python
