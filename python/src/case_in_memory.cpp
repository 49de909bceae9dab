#include "case_in_memory.hpp"

#include <nlohmann/json.hpp>
#include <utility>

#include "arrays.hpp"
#include "case/case_file.hpp"
#include "case/model/loop_of_case.hpp"
#include "case/model/modal/modal_plant_of_case.hpp"
#include "case/model/plant_of_case.hpp"
#include "case/model/resolved_plant.hpp"
#include "holdfast/core/errors.hpp"
#include "kernels/instruction_set.hpp"
#include "output/metadata.hpp"
#include "process/errors.hpp"

namespace holdfast::python {
namespace {

Vector<double, Eigen::Dynamic> column_of(const Row& row, std::size_t size, const char* name) {
  if (row.shape(0) != size)
    throw program::WrongInput(std::string(name) + " has " + std::to_string(row.shape(0)) +
                              " entries; admissible: one for each of the plant's " +
                              std::to_string(size) + " states");
  return Eigen::Map<const Vector<double, Eigen::Dynamic>>(row.data(),
                                                          static_cast<Eigen::Index>(size));
}

LinearPlant<double> plant_of(const Square& matrix, const Row& command, const Row& excitation,
                             const Row& displacement, const Row& velocity,
                             const Row& relative_displacement, const Row& relative_velocity,
                             const Row& displacement_lift, const Row& velocity_lift) {
  const std::size_t n = matrix.shape(0);
  if (n < 1 || matrix.shape(1) != n)
    throw program::WrongInput("the state matrix is " + std::to_string(n) + " x " +
                              std::to_string(matrix.shape(1)) + "; admissible: square");
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const auto states = static_cast<Eigen::Index>(n);
  const auto column = [n](const Row& row, const char* name) { return column_of(row, n, name); };
  return {Eigen::Map<const RowMajor>(matrix.data(), states, states),
          column(command, "the command's input"),
          Vector<double, Eigen::Dynamic>::Zero(states),
          column(excitation, "the excitation's input"),
          RowVector<double, Eigen::Dynamic>::Zero(states),
          1.0,
          {column(displacement, "the displacement").transpose(),
           column(velocity, "the velocity").transpose(),
           column(displacement, "the displacement").transpose(),
           column(velocity, "the velocity").transpose(),
           column(relative_displacement, "the relative displacement").transpose(),
           column(relative_velocity, "the relative velocity").transpose(),
           column(displacement_lift, "the displacement's lift"),
           column(velocity_lift, "the velocity's lift")}};
}

template <class Matrix>
nb::object array_of_matrix(const Matrix& matrix, bool as_column) {
  double* numbers = nullptr;
  const auto rows = static_cast<std::size_t>(matrix.rows());
  const auto columns = static_cast<std::size_t>(matrix.cols());
  nb::object array = as_column ? empty_array<double>({rows * columns}, numbers)
                               : empty_array<double>({rows, columns}, numbers);
  for (Eigen::Index i = 0; i < matrix.rows(); ++i)
    for (Eigen::Index j = 0; j < matrix.cols(); ++j) *numbers++ = matrix(i, j);
  return array;
}

}  // namespace

PlantArrays::PlantArrays(const Square& state_matrix, const Row& command_input,
                         const Row& excitation_input, const Row& displacement, const Row& velocity,
                         const Row& relative_displacement, const Row& relative_velocity,
                         const Row& displacement_lift, const Row& velocity_lift,
                         const Row& initial_state)
    : plant(plant_of(state_matrix, command_input, excitation_input, displacement, velocity,
                     relative_displacement, relative_velocity, displacement_lift, velocity_lift)),
      state(column_of(initial_state, state_matrix.shape(0), "the initial state")) {}

OwnPlant::OwnPlant(const PlantArrays& arrays) {
  validate(arrays.plant);
  require_finite("sum of the initial state", arrays.state.sum(), "");
  auto parts = std::make_shared<program::OwnParts>();
  parts->plant = arrays.plant;
  parts->state = arrays.state;
  parts_ = std::move(parts);
}

CaseInMemory::CaseInMemory(program::CaseSource source)
    : source_(std::move(source)), case_(source_.load()) {
  source_.attach_record(case_);
}

CaseInMemory::CaseInMemory(std::optional<std::string> text, std::string name,
                           std::vector<std::string> overrides, const OwnPlant* plant)
    : CaseInMemory([&] {
        program::CaseSource source;
        source.text = std::move(text);
        source.name = std::move(name);
        source.overrides = std::move(overrides);
        if (plant != nullptr) source.own = plant->parts();
        return source;
      }()) {}

CaseInMemory CaseInMemory::with(const std::vector<std::string>& overrides) const {
  program::CaseSource source = source_;
  source.overrides.insert(source.overrides.end(), overrides.begin(), overrides.end());
  return CaseInMemory(std::move(source));
}

std::string CaseInMemory::toml() const { return program::case_to_toml(case_); }

std::string CaseInMemory::json() const { return program::case_to_json(case_).dump(); }

std::string CaseInMemory::origin(const std::string& job,
                                 const std::vector<std::pair<std::string, std::string>>& options,
                                 const std::string& instructions) const {
  program::JobContext context;
  context.job = job;
  context.options = options;
  context.on_packs = true;
  context.instructions = program::chosen_instruction_set(instructions);
  context.case_data = settled();
  return program::origin_text(context, {});
}

bool CaseInMemory::has_own_plant() const { return program::has_own_plant(case_); }

const program::Case& CaseInMemory::settled() const {
  std::call_once(settled_->once, [this] {
    program::Case settled = case_;
    program::settle_plant(settled);
    settled_->settled = std::move(settled);
  });
  return settled_->settled;
}

nb::dict CaseInMemory::plant_matrices() const {
  const program::Case& the_case = settled();
  const LinearPlant<double> plant =
      !program::is_of_masses(program::motion_kind_of(the_case, Switching::sampled))
          ? program::modal_plant_of(the_case)
          : [&] {
              const LinearPlant<double, 4> four = linear_plant(program::plant_of(the_case));
              const Ports<double, 4>& ports = four.connections;
              return LinearPlant<double>{
                  four.released_matrix,
                  four.force_input,
                  four.command_input,
                  four.excitation,
                  four.drive_force,
                  four.direct_transmission,
                  {ports.displacement, ports.velocity, ports.measured_displacement,
                   ports.measured_velocity, ports.relative_displacement, ports.relative_velocity,
                   ports.displacement_lift, ports.velocity_lift}};
            }();
  nb::dict arrays;
  arrays["state_matrix"] = array_of_matrix(plant.state_matrix(), false);
  arrays["command_input"] = array_of_matrix(plant.control_input(), true);
  arrays["excitation_input"] = array_of_matrix(plant.excitation_input(), true);
  const Ports<double, Eigen::Dynamic>& ports = plant.ports();
  arrays["displacement"] = array_of_matrix(ports.displacement, true);
  arrays["velocity"] = array_of_matrix(ports.velocity, true);
  arrays["measured_displacement"] = array_of_matrix(ports.measured_displacement, true);
  arrays["measured_velocity"] = array_of_matrix(ports.measured_velocity, true);
  arrays["relative_displacement"] = array_of_matrix(ports.relative_displacement, true);
  arrays["relative_velocity"] = array_of_matrix(ports.relative_velocity, true);
  arrays["displacement_lift"] = array_of_matrix(ports.displacement_lift, true);
  arrays["velocity_lift"] = array_of_matrix(ports.velocity_lift, true);
  const PdGains<double> gains = program::gains_of(the_case);
  arrays["proportional_gain"] = gains.proportional;
  arrays["differential_gain"] = gains.differential;
  const Sampling<double> sampling = program::sampling_of(the_case);
  arrays["sampling_period"] = sampling.period;
  arrays["processing_delay"] = sampling.processing_delay;
  return arrays;
}

}  // namespace holdfast::python
