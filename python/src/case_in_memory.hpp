#pragma once

#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>

#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "case/case_source.hpp"
#include "case/model/own/own_parts.hpp"

namespace holdfast::python {

namespace nb = nanobind;

using Square = nb::ndarray<const double, nb::ndim<2>, nb::c_contig, nb::device::cpu>;
using Row = nb::ndarray<const double, nb::ndim<1>, nb::c_contig, nb::device::cpu>;

/// The arrays of a plant of order N, copied: N × N and N.
struct PlantArrays {
  PlantArrays(const Square& state_matrix, const Row& command_input, const Row& excitation_input,
              const Row& displacement, const Row& velocity, const Row& relative_displacement,
              const Row& relative_velocity, const Row& displacement_lift, const Row& velocity_lift,
              const Row& initial_state);

  LinearPlant<double> plant;
  Vector<double, Eigen::Dynamic> state;
};

/// A plant of the user's own. Throws InvalidParameter where a loop cannot be closed on it.
class OwnPlant {
 public:
  explicit OwnPlant(const PlantArrays& arrays);
  const std::shared_ptr<const program::OwnParts>& parts() const { return parts_; }

 private:
  std::shared_ptr<const program::OwnParts> parts_;
};

/// What a case file says, from its text and further values, checked; it never changes.
class CaseInMemory {
 public:
  /// @param text  of a case file; none: the built-in case
  /// @param name  of that file, for messages and for the files that it names
  CaseInMemory(std::optional<std::string> text, std::string name,
               std::vector<std::string> overrides, const OwnPlant* plant);

  CaseInMemory with(const std::vector<std::string>& overrides) const;

  std::string toml() const;
  std::string json() const;
  std::string origin(const std::string& job,
                     const std::vector<std::pair<std::string, std::string>>& options,
                     const std::string& instructions) const;
  bool has_own_plant() const;
  nb::dict plant_matrices() const;

  const program::CaseSource& source() const { return source_; }

  /// The case with its plant settled, as the jobs on a plant have it.
  const program::Case& settled() const;

  /// What charts of the case warn of, by `find` where nobody has asked yet. One thread at a time.
  template <class Find>
  std::vector<std::string>& warnings_of_charts(const Find& find) const {
    if (!settled_->warnings) settled_->warnings = find();
    return *settled_->warnings;
  }
  bool is_asked_for_charts() const { return settled_->warnings.has_value(); }

 private:
  explicit CaseInMemory(program::CaseSource source);

  program::CaseSource source_;
  program::Case case_;
  struct Settled {
    std::once_flag once;
    program::Case settled;
    std::optional<std::vector<std::string>> warnings;
  };
  std::shared_ptr<Settled> settled_ = std::make_shared<Settled>();
};

}  // namespace holdfast::python
