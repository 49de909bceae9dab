#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <utility>

#include "holdfast/chaos/block_spectrum.hpp"
#include "holdfast/chaos/classification.hpp"
#include "holdfast/chaos/itinerary_blocks.hpp"
#include "holdfast/chaos/lyapunov_spectrum.hpp"
#include "holdfast/control/gains.hpp"
#include "holdfast/control/sampled_loop.hpp"
#include "holdfast/core/errors.hpp"
#include "holdfast/core/types.hpp"
#include "holdfast/motion/sampled_motion.hpp"

namespace holdfast {

/// The settings of a run that averages Lyapunov exponents along a motion.
struct LyapunovRun {
  std::int64_t samples;      ///< number of samples after the discarded ones, 1 … 9·10¹⁵
  std::int64_t discard = 0;  ///< number of samples left out at the start as transient, 0 … 9·10¹⁵
  LyapunovScope scope = LyapunovScope::all;  ///< all five exponents or only the largest one
};

/// Validates the settings of a run. @throws InvalidParameter where a number is out of its range
inline void validate(const LyapunovRun& run) {
  require_within("samples of the Lyapunov run", static_cast<double>(run.samples), "", 1, 9e15);
  require_within("discarded samples", static_cast<double>(run.discard), "", 0, 9e15);
}

/// The Lyapunov exponents of a motion, natural logarithm per sample: averages over the samples
/// after the initial transient, which settled_means() detects.
struct LyapunovResult {
  /// Whether a state became infinite or NaN. The exponents are then averages up to that sample, or
  /// NaN if that sample was one of those discarded.
  bool diverged;
  /// The exponents λ₁ … λ₅, in descending order once converged; −∞ for a direction in which
  /// deviations become exactly zero. λ₂ … λ₅ are NaN where only λ₁ was computed.
  Vector<double, 5> exponents;
  /// The standard errors of the exponents by settled_means(), with an estimate of the bias due to
  /// the transient; 0 for an exponent −∞, NaN with fewer than four complete batches.
  Vector<double, 5> standard_errors;
  std::int64_t samples;       ///< number of samples averaged
  std::int64_t settling = 0;  ///< samples left out as transient in addition to LyapunovRun::discard

  /// Whether the sign of λ₁ is known: the 99 % interval of λ₁ excludes zero, or λ₁ = −∞.
  bool sign_is_known() const {
    if (exponents[0] == -std::numeric_limits<double>::infinity()) return true;
    if (!std::isfinite(exponents[0]) || !std::isfinite(standard_errors[0])) return false;
    const ExponentEstimate first = exponent_estimate(exponents[0], standard_errors[0]);
    return first.positive() || first.negative();
  }
};

namespace detail {

/// The result of a Lyapunov run, from the five leading exponents of a spectrum.
/// @tparam Size  ≥ 5
template <int Size>
LyapunovResult lyapunov_result(bool diverged, const LyapunovSpectrum<double, Size>& spectrum,
                               const LyapunovRun& run) {
  const SettledMeans<Size> settled = spectrum.settled();
  LyapunovResult result{diverged, settled.means.template head<5>(),
                        settled.standard_errors.template head<5>(), settled.steps,
                        settled.left_out};
  if (run.scope == LyapunovScope::largest) {
    result.exponents.tail<4>().setConstant(std::numeric_limits<double>::quiet_NaN());
    result.standard_errors.tail<4>().setConstant(std::numeric_limits<double>::quiet_NaN());
  }
  return result;
}

/// Averages the exponents of one motion: discards the first samples, then continues until the
/// samples are used up or the motion diverges.
/// @param pause  called every 2¹² samples
/// @tparam Lyapunov  type with sense(), advance() and state() of the motion, and with restart() and
///                   spectrum() of the exponents
template <class Lyapunov>
LyapunovResult run_average(Lyapunov& motion, const LyapunovRun& run,
                           const std::function<void()>& pause) {
  constexpr std::int64_t samples_between_pauses = 1 << 12;
  bool diverged = false;
  const auto advance = [&](std::int64_t samples) {
    for (std::int64_t taken = 0; taken < samples && !diverged; ++taken) {
      if (pause && taken % samples_between_pauses == 0) pause();
      motion.sense();
      diverged = !std::isfinite(motion.state().sum());
      if (diverged) return;
      motion.advance();
    }
  };
  advance(run.discard);
  motion.restart();
  advance(run.samples);
  return lyapunov_result(diverged, motion.spectrum(), run);
}

}  // namespace detail

/// An observer for run_trajectory() that computes the Lyapunov spectrum of the motion. The tangent
/// map of a sample is S if the drive transmits its force, S* in the backlash (`SampledLoop`).
///
/// S and S* should belong to the loop of the motion. To reproduce Table 2 of Kollár 2022, however,
/// pass a loop whose processing delay δ is one sampling period, while the motion has δ = 0.
/// @tparam Scalar  number type, `double`
template <class Scalar>
class LyapunovObserver {
 public:
  /// @param tangent_loop  loop whose maps S (force transmitted) and S* (in the backlash) are used
  /// @param gains         controller gains P (N/m) and D (N s/m) of the motion
  LyapunovObserver(const SampledLoop<Scalar>& tangent_loop, const PdGains<Scalar>& gains)
      : LyapunovObserver(std::make_shared<const ItineraryBlocks>(tangent_loop, gains)) {}

  /// @param blocks  tangent maps of all blocks of samples, for the loop; not null
  /// @param scope   all five exponents or only the largest one
  explicit LyapunovObserver(std::shared_ptr<const ItineraryBlocks> blocks,
                            LyapunovScope scope = LyapunovScope::all)
      : engine_(std::move(blocks), scope) {}

  /// Adds the next sample; only the member `engaged` is used.
  void operator()(const MotionSample<Scalar>& sample) { push(sample.engaged); }
  /// Adds the next sample. @param engaged  whether the drive transmits its force at that sample
  void push(bool engaged) {
    open_ = followed_by(open_, engaged);
    if (!is_whole(open_)) return;
    engine_.push(open_);
    open_ = empty_block;
  }

  /// The Lyapunov spectrum over all samples since the last restart.
  LyapunovSpectrum<Scalar, 5> spectrum() const { return engine_.spectrum(open_); }
  /// Restarts the averages, but keeps the tangent vectors.
  void restart() {
    engine_.restart(open_);
    open_ = empty_block;
  }

 private:
  BlockSpectrum<Scalar> engine_;
  ItineraryBlock open_ = empty_block;
};

namespace detail {

/// A motion of the sampled loop with its Lyapunov exponents, as required by run_average().
/// @tparam Exponents  LyapunovObserver or ModalSpectrum
template <class Motion, class Exponents>
class SampledLyapunov : public Exponents {
 public:
  SampledLyapunov(Motion& motion, const Exponents& exponents)
      : Exponents(exponents), motion_(motion) {}

  void sense() { engaged_ = motion_.sense().engaged; }
  void advance() {
    Exponents::push(engaged_);
    motion_.advance();
  }
  const auto& state() const { return motion_.state(); }

 private:
  Motion& motion_;
  bool engaged_ = false;
};

/// The Lyapunov exponents of a motion from its present state over a run.
template <class Motion, class Exponents>
LyapunovResult run_sampled(Motion& motion, const Exponents& exponents, const LyapunovRun& run,
                           const std::function<void()>& pause) {
  SampledLyapunov<Motion, Exponents> lyapunov(motion, exponents);
  return run_average(lyapunov, run, pause);
}

}  // namespace detail

/// Computes the Lyapunov exponents of the sampled loop with backlash by running a motion.
///
///     auto blocks = std::make_shared<const ItineraryBlocks>(loop, gains);
///     const LyapunovResult result = run_lyapunov(motion, blocks, {1000000, 1000});
///
/// @param motion  a SampledMotion of `double`; it is advanced from its present state over the run
/// @param blocks  tangent maps of all blocks of samples, for the motion's loop
/// @param run     numbers of samples to discard and to average; choice of exponents
/// @param pause   function called every 2¹² samples, if set; it may throw to end the run
/// @throws InvalidParameter where a number in `run` is out of its range or `blocks` is null
template <class Motion>
LyapunovResult run_lyapunov(Motion& motion, const std::shared_ptr<const ItineraryBlocks>& blocks,
                            const LyapunovRun& run, const std::function<void()>& pause = {}) {
  validate(run);
  require_within("number of itinerary blocks", blocks ? 1.0 : 0.0, "", 1, 1);
  return detail::run_sampled(motion, LyapunovObserver<double>(blocks, run.scope), run, pause);
}

}  // namespace holdfast
