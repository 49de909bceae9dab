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

/// The gains that serve a band of frequencies best.
struct MinimaxGains {
  double proportional_gain;  ///< N/m; NaN where none is admissible
  MinimaxAmplitude quietest;
};

/// The loop of a case without play, 1 = P G_z + D G_v, as charts, boundaries, margins, design and
/// responses have it: filters, lags, late forces and a velocity by difference are in it; quanta,
/// the largest force and jitter are not, which texts/support.toml tells.
///
/// Which way a question is answered is settled here and nowhere else: in closed form where the loop
/// is of order 4 + 1, else by the poles from the command to the readings. May be asked from many
/// threads.
class LinearLoop {
 public:
  /// Throws MissingKeys. Best gains, margins and longest periods throw NoAnswer where natural
  /// motions cannot be told apart.
  /// @param the_case  must outlive this
  explicit LinearLoop(const Case& the_case);
  explicit LinearLoop(Case&&) = delete;
  LinearLoop(const LinearLoop&) = default;
  LinearLoop& operator=(const LinearLoop&) = delete;
  ~LinearLoop();

  /// Whether ends of τ and δ are walked to, which the closed forms need not.
  bool walks() const { return !closed_; }

  /// The open intervals of one gain, the other being held, in which the loop is stable.
  std::vector<Interval<double>> stable_gains(FreeGain free, const PdGains<double>& gains) const;
  /// Writes which of some D are stable, 1 or 0, at one P after another.
  std::function<void(double p, std::uint8_t* flags)> stable_rows(const Axis& differential) const;
  /// The largest modulus of its roots.
  double radius(const PdGains<double>& gains) const;
  /// The boundary of stability over a range of P.
  std::vector<BoundaryPoint<double>> boundary(const Interval<double>& proportional) const;

  /// The steady response at f (Hz), relative to no control under the true force.
  SteadyResponse<double> response(double frequency) const;
  /// The D of least steady amplitude at f (Hz) and P.
  MinimumAmplitude quietest(const AmplitudeOptions& options, double frequency, double p) const;
  /// The P and D of least steady amplitude at f (Hz), with the modulus margin of the options.
  MinimumAmplitudeGains quietest_pair(const AmplitudeOptions& options, double frequency) const;
  /// The D of least largest amplitude over a band.
  MinimaxAmplitude quietest_over(const AmplitudeOptions& options, double p,
                                 const FrequencyBand& band) const;
  /// The gains of least largest amplitude over several loops and a band, or one frequency, of those
  /// that each of them admits as `quietest_pair` does.
  /// @param options  of each loop
  /// @param p        none: the best P too
  static MinimaxGains quietest_for_all(const std::vector<LinearLoop>& loops,
                                       const std::vector<AmplitudeOptions>& options,
                                       const FrequencyBand& band, std::optional<double> p);
  /// The lowest natural frequency of the conductor (Hz).
  double first_frequency() const;
  /// The D of least spectral radius at P.
  MinimumRadius fastest(double p) const;
  /// The largest sampling period, δ/τ being the question's.
  MaxDelay longest_period(const MaxDelayOptions& question) const;
  /// The D that stabilise at another sampling period, δ/τ being the question's.
  std::vector<Interval<double>> stable_gains(const MaxDelayOptions& question, double period) const;
  /// ρ − 1 at another sampling.
  double excess(const Sampling<double>& sampling, const PdGains<double>& gains) const;

  /// How far D, P, τ and δ may go; by poles τ and δ are walked, τ up to a hundred times its own.
  StabilityMargins margins(const PdGains<double>& gains) const;
  /// Gain, phase and delay that the loop as a whole can bear.
  LoopMargins whole_margins(const PdGains<double>& gains) const;

 private:
  struct ByPoles;

  /// Throws NoAnswer where the loop has no sum over its poles.
  void require_poles() const;
  /// The D that leave a modulus margin and keep a radius at P, as `quietest_pair` has them.
  std::vector<Interval<double>> gains_of_modulus(const AmplitudeOptions& options, double p) const;
  /// The range in which P is looked for first, about that tuned to f (Hz).
  Interval<double> range_about_tuned(double frequency) const;

  const Case& case_;
  std::optional<SampledLoop<double>> closed_;
  std::shared_ptr<const ByPoles> by_poles_;
};

}  // namespace holdfast::program
