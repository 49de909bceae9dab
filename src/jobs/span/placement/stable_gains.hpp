#pragma once

#include <vector>

#include "case/case.hpp"
#include "case/model/modal/modal_plant_of_case.hpp"
#include "holdfast/control/gains.hpp"
#include "holdfast/stability/boundary/boundary_point.hpp"
#include "holdfast/stability/response/loop_response.hpp"

namespace holdfast::program {

/// The gains with which the computer's loop of a case is stable on the taut string with all its
/// devices at a modulus margin: min |1 − P G_z − D G_v| over the unit circle. They are so by the
/// judge of loops (`judged_loop_of`), and by the same string without the modes above twice the
/// sampling rate: gains that hang on how many modes are kept are not recommended.
class StableGains {
 public:
  /// @param margin  0 … 1; 0: stability alone
  /// Throws what `judged_loop_of` throws.
  StableGains(const Case& the_case, double margin);

  bool is_stable(const PdGains<double>& gains) const {
    return judge_.is_stable(gains) && cut_.is_stable(gains);
  }

  int judged_modes() const { return judge_.modes; }            ///< one by one
  double highest_frequency() const { return judge_.highest; }  ///< Hz, of the last of them

  /// Whether gains are stable and keep the margin.
  bool admits(const PdGains<double>& gains) const;

  /// The bounded open intervals of one gain, the other being held, that are stable and keep the
  /// margin, or 0.01 where it is less; ascending.
  std::vector<Interval<double>> along(FreeGain free, const PdGains<double>& held) const;

  /// About all that are admitted on lines through the gains without control: by turns the D of some
  /// P and the P of some D, and a tenth beyond.
  /// @param most  bounds of |P| and |D| where there are no others
  GainWindow around(const PdGains<double>& most) const;

 private:
  JudgedLoop judge_, cut_;
  std::vector<CommandResponse<double>> responses_;  // at the angles of both
  double margin_;
};

}  // namespace holdfast::program
