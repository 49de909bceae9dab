#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "case/case.hpp"
#include "holdfast/control/gains.hpp"
#include "holdfast/control/sampled_loop.hpp"
#include "holdfast/core/axis.hpp"
#include "holdfast/core/interval.hpp"
#include "holdfast/stability/boundary/boundary_point.hpp"
#include "holdfast/stability/design/max_delay.hpp"
#include "holdfast/stability/design/minimax_amplitude.hpp"
#include "holdfast/stability/design/minimum_amplitude.hpp"
#include "holdfast/stability/design/minimum_amplitude_gains.hpp"
#include "holdfast/stability/design/minimum_radius.hpp"
#include "holdfast/stability/margins/margins.hpp"
#include "holdfast/stability/response/response.hpp"

namespace holdfast::program {

/// The gains of least largest steady amplitude over a band of frequencies.
struct MinimaxGains {
  double proportional_gain;   ///< P (N/m); NaN where no gain is admissible
  MinimaxAmplitude quietest;  ///< D and its largest amplitude
};

/// The linear loop of a case, with the characteristic equation 1 = P G_z + D G_v and the sampled
/// transfer functions G_z, G_v from force to displacement and velocity readings. Filters, lags,
/// delays and a velocity by difference are included; play, quanta, force limit and jitter are not.
///
/// This class alone decides the method: closed forms for a loop of order 4 + 1, else sums over the
/// poles from the command to the readings. Thread-safe.
class LinearLoop {
 public:
  /// Prepares the loop; throws MissingKeys. The functions for best gains, margins and longest
  /// periods throw NoAnswer if two poles nearly coincide.
  /// @param the_case  case, which must outlive the loop
  explicit LinearLoop(const Case& the_case);
  explicit LinearLoop(Case&&) = delete;
  LinearLoop(const LinearLoop&) = default;
  LinearLoop& operator=(const LinearLoop&) = delete;
  ~LinearLoop();

  /// Whether the limits of τ and δ are found in steps, not in closed form.
  bool walks() const { return !closed_; }

  /// The open intervals of one gain, the other being fixed, in which the loop is stable.
  std::vector<Interval<double>> stable_gains(FreeGain free, const PdGains<double>& gains) const;
  /// A function that writes, at a given P, 1 (stable) or 0 for each D of the axis.
  std::function<void(double p, std::uint8_t* flags)> stable_rows(const Axis& differential) const;
  /// The spectral radius, the largest modulus of the characteristic roots.
  double radius(const PdGains<double>& gains) const;
  /// The stability boundary in the plane of P and D over a range of P (N/m).
  std::vector<BoundaryPoint<double>> boundary(const Interval<double>& proportional) const;

  /// The steady response at f (Hz), relative to that without control under the true force.
  SteadyResponse<double> response(double frequency) const;
  /// The D of least steady amplitude at f (Hz) and P.
  MinimumAmplitude quietest(const AmplitudeOptions& options, double frequency, double p) const;
  /// The P and D of least steady amplitude at f (Hz), with the modulus margin of the options.
  MinimumAmplitudeGains quietest_pair(const AmplitudeOptions& options, double frequency) const;
  /// The D at P whose largest steady amplitude over a band is least.
  MinimaxAmplitude quietest_over(const AmplitudeOptions& options, double p,
                                 const FrequencyBand& band) const;
  /// The gains whose largest steady amplitude over several loops and a band (or one frequency) is
  /// least, among the gains with the modulus margin of the options in every loop.
  /// @param options  options of each loop
  /// @param p        P (N/m); none: P is optimised too
  static MinimaxGains quietest_for_all(const std::vector<LinearLoop>& loops,
                                       const std::vector<AmplitudeOptions>& options,
                                       const FrequencyBand& band, std::optional<double> p);
  /// The lowest natural frequency of the conductor (Hz).
  double first_frequency() const;
  /// The D of least spectral radius at P.
  MinimumRadius fastest(double p) const;
  /// The largest feasible sampling period, for the δ/τ and criterion of the question.
  MaxDelay longest_period(const MaxDelayOptions& question) const;
  /// The stable intervals of D at another sampling period (s), for the δ/τ of the question.
  std::vector<Interval<double>> stable_gains(const MaxDelayOptions& question, double period) const;
  /// The spectral radius minus 1 at another sampling period and delay.
  double excess(const Sampling<double>& sampling, const PdGains<double>& gains) const;

  /// Stability limits of D, P, τ and δ, each changed alone; by poles, up to 100 times the case's τ.
  StabilityMargins margins(const PdGains<double>& gains, bool of_delay = true) const;
  /// Gain, phase and delay margins of the whole loop.
  LoopMargins whole_margins(const PdGains<double>& gains) const;

 private:
  struct ByPoles;

  /// Throws NoAnswer if the loop is not a sum over its poles, since two poles nearly coincide.
  void require_poles() const;
  /// The intervals of D at P that keep the modulus margin and the radius of the options.
  std::vector<Interval<double>> gains_of_modulus(const AmplitudeOptions& options, double p) const;
  /// The initial search range of P (N/m), around the P tuned to f (Hz).
  Interval<double> range_about_tuned(double frequency) const;

  const Case& case_;
  std::optional<SampledLoop<double>> closed_;
  std::shared_ptr<const ByPoles> by_poles_;
};

}  // namespace holdfast::program
