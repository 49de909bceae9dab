#pragma once

#include <vector>

#include "case/case.hpp"
#include "case/model/modal/modal_plant_of_case.hpp"
#include "holdfast/control/gains.hpp"
#include "holdfast/stability/boundary/boundary_point.hpp"
#include "holdfast/stability/response/loop_response.hpp"

namespace holdfast::program {

/// Test of the gains P, D of an absorber on the taut string with all devices: the loop must be
/// stable, with a modulus margin min |1 − P G_z − D G_v| over the unit circle (G_z, G_v: transfer
/// functions from force to z₁, ż₁). Two models must pass, so that the result does not depend on the
/// number of modes: `judged_loop_of`, and the string without modes above twice the sampling rate.
class StableGains {
 public:
  /// Prepares the tests. @param margin  modulus margin, 0 … 1; 0: stability alone
  /// Throws what `judged_loop_of` throws.
  StableGains(const Case& the_case, double margin);

  bool is_stable(const PdGains<double>& gains) const {
    return judge_.is_stable(gains) && cut_.is_stable(gains);
  }

  int judged_modes() const { return judge_.modes; }            ///< number of single modes
  double highest_frequency() const { return judge_.highest; }  ///< highest frequency (Hz) of these

  /// Whether gains are stable and keep the margin.
  bool admits(const PdGains<double>& gains) const;

  /// Bounded open intervals of one gain, with the other gain fixed, in which the loop is stable and
  /// keeps the margin, or a margin of 0.01 if that is larger; ascending.
  std::vector<Interval<double>> along(FreeGain free, const PdGains<double>& held) const;

  /// Window of P and D with the admissible gains found, widened by a tenth at each end. The search
  /// starts at gains of 0 and alternates: intervals of D at several P, of P at several D.
  /// @param most  bounds of |P| and |D|
  GainWindow around(const PdGains<double>& most) const;

 private:
  JudgedLoop judge_, cut_;
  std::vector<CommandResponse<double>> responses_;  // at the angles of both
  double margin_;
};

}  // namespace holdfast::program
