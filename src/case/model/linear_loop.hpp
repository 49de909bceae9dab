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

/// Gains that minimise the largest steady amplitude over a frequency band.
struct MinimaxGains {
  double proportional_gain;   ///< P (N/m); NaN where no gain is admissible
  MinimaxAmplitude quietest;  ///< D (N s/m) and the largest amplitude ratio with it
};

/// Linear control loop of a case, for stability and steady response. Its characteristic equation is
/// 1 = P G_z + D G_v: gains P (N/m) and D (N s/m), sampled transfer functions G_z, G_v from command
/// to displacement and velocity readings. τ is the sampling period (s), δ the processing delay (s).
/// Filters, drive lag, delay and a velocity by difference are included; play, quanta, force limit
/// and jitter are not. The class chooses the method: closed forms for two masses with measured
/// velocity (order 4 + 1), else sums over the poles from command to readings. Thread-safe.
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

  /// Whether the stability limits of τ and δ are searched in steps, not computed in closed form.
  bool walks() const { return !closed_; }

  /// Open intervals of one gain (`free`) in which the loop is stable, for a fixed other gain.
  std::vector<Interval<double>> stable_gains(FreeGain free, const PdGains<double>& gains) const;
  /// Function that fills a row of a stability chart: 1 (stable) or 0 for each D of the axis at P.
  std::function<void(double p, std::uint8_t* flags)> stable_rows(const Axis& differential) const;
  /// The spectral radius, the largest modulus of the characteristic roots.
  double radius(const PdGains<double>& gains) const;
  /// The stability boundary in the plane of P and D over a range of P (N/m).
  std::vector<BoundaryPoint<double>> boundary(const Interval<double>& proportional) const;

  /// Steady response at f (Hz), relative to that without control under the continuous (true) force.
  SteadyResponse<double> response(double frequency) const;
  /// D that minimises the steady amplitude at a frequency (Hz), for a given P (N/m).
  MinimumAmplitude quietest(const AmplitudeOptions& options, double frequency, double p) const;
  /// P and D that minimise the steady amplitude at f (Hz), with the options' modulus margin.
  MinimumAmplitudeGains quietest_pair(const AmplitudeOptions& options, double frequency) const;
  /// D that minimises the largest steady amplitude over a band, for a given P (N/m).
  MinimaxAmplitude quietest_over(const AmplitudeOptions& options, double p,
                                 const FrequencyBand& band) const;
  /// Gains that minimise the largest steady amplitude over all loops and a band (or one frequency).
  /// They keep the modulus margin of the options in every loop.
  /// @param options  options of each loop, as many as loops
  /// @param p        P (N/m); none: P is optimised too
  static MinimaxGains quietest_for_all(const std::vector<LinearLoop>& loops,
                                       const std::vector<AmplitudeOptions>& options,
                                       const FrequencyBand& band, std::optional<double> p);
  /// The lowest natural frequency of the conductor (Hz).
  double first_frequency() const;
  /// D that minimises the spectral radius (fastest decay), for a given P (N/m).
  MinimumRadius fastest(double p) const;
  /// Largest feasible sampling period, by the criterion and with the ratio δ/τ of the question.
  MaxDelay longest_period(const MaxDelayOptions& question) const;
  /// Stable intervals of D at another τ (`period`), with P and δ/τ of the question. For two masses
  /// in closed form, D must also meet the question's criterion.
  std::vector<Interval<double>> stable_gains(const MaxDelayOptions& question, double period) const;
  /// Spectral radius minus 1 for another τ and δ; below 0: stable.
  double excess(const Sampling<double>& sampling, const PdGains<double>& gains) const;

  /// Stability limits of D, P, τ and δ, each varied alone; by poles, τ up to 100 times the case's.
  StabilityMargins margins(const PdGains<double>& gains, bool of_delay = true) const;
  /// Gain, phase and delay margins of the loop, opened at the command.
  LoopMargins whole_margins(const PdGains<double>& gains) const;

 private:
  struct ByPoles;

  /// Throws NoAnswer if the loop is not a sum over its poles, since two poles nearly coincide.
  void require_poles() const;
  /// The initial search range of P (N/m), around the P tuned to f (Hz).
  Interval<double> range_about_tuned(double frequency) const;

  const Case& case_;
  std::optional<SampledLoop<double>> closed_;
  std::shared_ptr<const ByPoles> by_poles_;
};

}  // namespace holdfast::program
