#include "run.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "arrays.hpp"
#include "case/model/loop_of_case.hpp"
#include "holdfast/excitation/recorded_force.hpp"
#include "host/job_host.hpp"
#include "job.hpp"
#include "jobs/charts/chart_rows.hpp"
#include "kernels/instruction_set.hpp"
#include "process/errors.hpp"
#include "work.hpp"

namespace holdfast::python {
namespace {

using program::JobHost;
using program::OwnParts;
using program::ReceivedColumn;
using program::ReceivedTable;

/// Tells how far the job is.
void tell_progress(const JobHost& host, const nb::object& watch) {
  const std::uint64_t all = host.steps;
  if (all > 0 && !watch.is_none()) watch(std::min(host.steps_done.load(), all), all);
}

/// Runs `work` under the host, in a thread of its own.
template <class Work>
void do_hosted(JobHost& host, const nb::object& watch, const Work& work) {
  do_without_lock(
      [&] {
        const program::HostScope here(host);
        work();
      },
      [&] { tell_progress(host, watch); });
}

/// Runs `work` under the host in this thread.
template <class Work>
void do_hosted_here(JobHost& host, const Work& work) {
  do_here([&] {
    const program::HostScope here(host);
    work();
  });
}

/// A controller in Python: slow, since every sample takes the interpreter's lock. It looks after
/// signals, for it is called in the thread that asked for the job.
class PythonController {
 public:
  explicit PythonController(nb::object callable) : callable_(std::move(callable)) {}
  PythonController(const PythonController&) = delete;
  PythonController& operator=(const PythonController&) = delete;
  ~PythonController() {
    const nb::gil_scoped_acquire held;
    callable_.reset();
  }

  double operator()(std::int64_t k, double t, double displacement, double velocity) const {
    const nb::gil_scoped_acquire held;
    const CallsPython calls;
    if (PyErr_CheckSignals() != 0) throw nb::python_error();
    const nb::object force = callable_(k, t, displacement, velocity);
    const double value = PyFloat_AsDouble(force.ptr());
    if (value == -1.0 && PyErr_Occurred() != nullptr) throw nb::python_error();
    if (!std::isfinite(value))
      throw program::WrongInput("the controller gives " + std::to_string(value) + " N at sample " +
                                std::to_string(k) + "; admissible: finite");
    return value;
  }

 private:
  nb::object callable_;
};

using Compiled = double (*)(std::int64_t, double, double, double);
using CompiledWithData = double (*)(std::int64_t, double, double, double, void*);

bool is_compiled(const nb::object& controller) { return nb::isinstance<nb::tuple>(controller); }

program::OwnForce controller_of(const nb::object& controller) {
  if (is_compiled(controller)) {
    const auto address = nb::cast<std::uintptr_t>(controller[0]);
    if (address == 0) throw program::WrongInput("the controller's address is 0");
    if (controller[1].is_none()) return reinterpret_cast<Compiled>(address);
    const auto data = nb::cast<std::uintptr_t>(controller[1]);
    return [call = reinterpret_cast<CompiledWithData>(address), data](std::int64_t k, double t,
                                                                      double z, double v) {
      return call(k, t, z, v, reinterpret_cast<void*>(data));
    };
  }
  const auto called = std::make_shared<const PythonController>(controller);
  return [called](std::int64_t k, double t, double z, double v) { return (*called)(k, t, z, v); };
}

void attach_controller(program::CaseSource& source, const nb::object& controller) {
  if (controller.is_none()) return;
  auto own = std::make_shared<OwnParts>();
  if (source.own != nullptr) *own = *source.own;
  own->controller = controller_of(controller);
  source.own = std::move(own);
}

void attach_force(program::CaseSource& source, const nb::object& force) {
  if (force.is_none()) return;
  const auto times = nb::cast<Row>(force[0]), forces = nb::cast<Row>(force[1]);
  source.force_record = std::make_shared<const RecordedForce>(
      std::vector<double>(times.data(), times.data() + times.shape(0)),
      std::vector<double>(forces.data(), forces.data() + forces.shape(0)),
      nb::cast<bool>(force[2]) ? RecordInterpolation::held : RecordInterpolation::linear);
}

/// (name, unit, description, array, words or None)
nb::tuple tuple_of(ReceivedColumn& column, const std::vector<std::size_t>& shape) {
  const program::Column& about = column.about();
  nb::object array = column.kind() == ReceivedColumn::Kind::numbers
                         ? array_of(std::move(column.numbers()), shape)
                         : array_of(std::move(column.whole_numbers()), shape);
  nb::object words = nb::none();
  if (about.datatype == "string") words = nb::cast(column.words());
  return nb::make_tuple(about.name, about.unit, about.description, array, words);
}

nb::dict dict_of(ReceivedTable& table) {
  nb::list axes, columns;
  std::vector<std::size_t> shape;
  for (program::ReceivedAxis& axis : table.axes) {
    shape.push_back(axis.values.size());
    axes.append(nb::make_tuple(axis.about.name, axis.about.unit, axis.about.description,
                               array_of(std::move(axis.values))));
  }
  for (ReceivedColumn& column : table.columns)
    columns.append(
        tuple_of(column, shape.empty() ? std::vector<std::size_t>{column.rows()} : shape));
  nb::dict result;
  result["axes"] = axes;
  result["columns"] = columns;
  result["origin"] = table.origin;
  return result;
}

nb::object values_of(const Axis& axis) {
  std::vector<double> values(static_cast<std::size_t>(axis.count));
  for (std::int64_t i = 0; i < axis.count; ++i) values[static_cast<std::size_t>(i)] = axis.at(i);
  return array_of(std::move(values));
}

Axis axis_of(const AxisTuple& axis) {
  return {std::get<0>(axis), std::get<1>(axis), std::get<2>(axis)};
}

/// Whether a chart takes a few milliseconds at most, so that a thread of its own would cost more
/// than it spares: one of two masses of so many cells, once it is known what its case is warned of.
bool is_short(const CaseInMemory& the_case, const GainGrid& grid, bool radius) {
  if (!the_case.is_asked_for_charts() || !program::has_closed_forms(the_case.settled()))
    return false;
  const std::int64_t rows = grid.proportional.count, columns = grid.differential.count;
  if (rows > 5000 || columns > 1'000'000) return false;
  return rows * columns <= (radius ? 2'000'000 : 4'000'000);
}

}  // namespace

nb::tuple run_job(const CaseInMemory& the_case, std::vector<std::string> arguments,
                  nb::object watch, nb::object controller, nb::object force) {
  arguments.emplace_back("--quiet");
  JobHost host;
  host.source = std::make_shared<program::CaseSource>(the_case.source());
  attach_controller(*host.source, controller);
  attach_force(*host.source, force);
  const auto work = [&] { program::do_job(arguments); };
  if (controller.is_none() || is_compiled(controller))
    do_hosted(host, watch, work);
  else
    do_hosted_here(host, work);
  nb::list tables;
  for (ReceivedTable& table : host.tables) tables.append(dict_of(table));
  return nb::make_tuple(tables, nb::cast(host.warnings));
}

nb::tuple chart(const CaseInMemory& the_case, AxisTuple proportional, AxisTuple differential,
                bool radius, int threads, const std::string& instructions, nb::object watch) {
  const GainGrid grid{axis_of(proportional), axis_of(differential)};
  validate(grid);
  const program::InstructionSet set = program::chosen_instruction_set(instructions);
  const std::vector<std::size_t> shape = {static_cast<std::size_t>(grid.proportional.count),
                                          static_cast<std::size_t>(grid.differential.count)};
  bool* stable = nullptr;
  double* radii = nullptr;
  nb::object stable_array = empty_array<bool>(shape, stable);
  nb::object radius_array = radius ? empty_array<double>(shape, radii) : nb::none();
  JobHost host;
  const auto work = [&] {
    // What the job refuses or doubts of a case it does of one cell too.
    host.warnings = the_case.warnings_of_charts([&] {
      host.source = std::make_shared<program::CaseSource>(the_case.source());
      program::do_job({"stability", "--p=0", "--d=0", "--quiet"});
      return std::move(host.warnings);
    });
    program::ChartMemory memory{shape[1], reinterpret_cast<std::uint8_t*>(stable), {}};
    if (radius) memory.first_numbers.push_back(radii);
    program::fill_chart(program::stability_chart_of(the_case.settled(), grid, radius, set), memory,
                        threads);
  };
  if (is_short(the_case, grid, radius)) {
    do_hosted_here(host, work);
  } else {
    do_hosted(host, watch, work);
  }
  return nb::make_tuple(stable_array, radius_array, nb::cast(host.warnings),
                        nb::make_tuple(values_of(grid.proportional), values_of(grid.differential)));
}

}  // namespace holdfast::python
