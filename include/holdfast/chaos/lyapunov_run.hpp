#pragma once

#include <cmath>
#include <cstddef>
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

/// How long a Lyapunov spectrum is averaged.
struct LyapunovRun {
  std::int64_t most_samples;  ///< ≥ 1, after those left out
  std::int64_t discard = 0;   ///< ≥ 0, left out at the start while motion and basis settle
  double standard_error = 0;  ///< ≥ 0, per sample: the mean that is accurate enough; 0 never is
  LyapunovScope scope = LyapunovScope::all;  ///< what is computed
  /// What has to be accurate enough: the largest exponent, or all that are finite.
  LyapunovScope classified = LyapunovScope::largest;
};

/// @throws InvalidParameter where a field is not admissible
inline void validate(const LyapunovRun& run) {
  require_within("samples of a Lyapunov run", static_cast<double>(run.most_samples), "", 1, 9e15);
  require_within("samples left out", static_cast<double>(run.discard), "", 0, 9e15);
  require_non_negative("standard error asked for", run.standard_error, "");
}

/// How a Lyapunov run ended.
enum class LyapunovOutcome {
  accurate,      ///< the standard error asked for was reached
  sample_limit,  ///< all samples were taken before that
  diverged,      ///< the state left the range of the number type; the exponents are those of the
                 ///< samples before that, NaN where it happened among those left out
};

/// The Lyapunov exponents of a motion, natural logarithm per sample.
struct LyapunovResult {
  LyapunovOutcome outcome;  ///< why no more samples were taken
  /// λ₁ … λ₅ in the order of the QR, −∞ for a null direction; NaN but for the first
  /// where that alone was asked for.
  Vector<double, 5> exponents;
  /// By batch means, the larger of those from the batches and from pairs of them; 0 for −∞.
  Vector<double, 5> standard_errors;
  std::int64_t samples;  ///< averaged over

  /// Whether the 95 % interval of λ₁ leaves out zero: whether it is known if neighbours separate.
  bool sign_is_known() const {
    if (exponents[0] == -std::numeric_limits<double>::infinity()) return true;
    if (!std::isfinite(exponents[0]) || !std::isfinite(standard_errors[0])) return false;
    const ExponentEstimate indicators = exponent_estimate(exponents[0], standard_errors[0]);
    return indicators.positive() || indicators.negative();
  }
};

/// Fewest complete batches on which a run may end early.
inline constexpr std::size_t fewest_batches = 32;

/// Whether a spectrum is known as well as a run asks for.
/// @param standard_errors  of λ₁ … λ₅
/// @param run              which of them count, and how well
template <class Scalar>
bool accurate_enough(const Vector<Scalar, 5>& standard_errors, const LyapunovRun& run) {
  const bool all = run.classified == LyapunovScope::all && run.scope == LyapunovScope::all;
  const double error = all ? standard_errors.maxCoeff() : standard_errors[0];
  return error <= run.standard_error && !standard_errors.hasNaN();
}

/// The five leading exponents of a spectrum as the result of a run.
/// @tparam Size  ≥ 5
template <int Size>
LyapunovResult lyapunov_result(LyapunovOutcome outcome,
                               const LyapunovSpectrum<double, Size>& spectrum,
                               const LyapunovRun& run) {
  LyapunovResult result{outcome, spectrum.exponents().template head<5>(),
                        spectrum.cautious_standard_errors().template head<5>(), spectrum.steps()};
  if (run.scope == LyapunovScope::largest) {
    result.exponents.tail<4>().setConstant(std::numeric_limits<double>::quiet_NaN());
    result.standard_errors.tail<4>().setConstant(std::numeric_limits<double>::quiet_NaN());
  }
  return result;
}

namespace detail {

/// Tells when a run that averages exponents has new batches to be judged by.
class JudgingTimes {
 public:
  explicit JudgingTimes(const LyapunovRun& run) : asked_(run.standard_error > 0) {}

  /// Whether the exponents are to be judged now. @param batches  complete so far
  bool have_come(std::size_t batches) {
    if (batches == classified_ || batches < fewest_batches || !asked_) return false;
    classified_ = batches;
    return true;
  }

 private:
  bool asked_;
  std::size_t classified_ = 0;
};

/// Averages exponents over a run: leaves out the first samples, then goes on until the mean is
/// accurate enough, the samples are at an end or the motion diverges.
/// @param motion  with its exponents: sense(), advance() and state() are those of the motion,
///                restart(), spectrum() and complete_batches() those of the exponents
/// @param pause   called every 2¹² samples
template <class Lyapunov>
LyapunovResult run_average(Lyapunov& motion, const LyapunovRun& run,
                           const std::function<void()>& pause) {
  // Up to so many samples; whether the motion has kept within the range of numbers.
  const auto take = [&](std::int64_t samples, const auto& ends) {
    constexpr std::int64_t samples_between_pauses = 1 << 12;
    for (std::int64_t taken = 0; taken < samples; ++taken) {
      if (pause && taken % samples_between_pauses == 0) pause();
      motion.sense();
      if (!std::isfinite(motion.state().sum())) return false;
      motion.advance();
      if (ends()) break;
    }
    return true;
  };
  const bool settled = take(run.discard, [] { return false; });
  motion.restart();
  if (!settled) return lyapunov_result(LyapunovOutcome::diverged, motion.spectrum(), run);
  JudgingTimes judging(run);
  bool accurate = false;
  const bool stayed = take(run.most_samples, [&] {
    if (!judging.have_come(motion.complete_batches())) return false;
    const Vector<double, 5> errors =
        motion.spectrum().cautious_standard_errors().template head<5>();
    accurate = accurate_enough(errors, run);
    return accurate;
  });
  const auto outcome = !stayed    ? LyapunovOutcome::diverged
                       : accurate ? LyapunovOutcome::accurate
                                  : LyapunovOutcome::sample_limit;
  return lyapunov_result(outcome, motion.spectrum(), run);
}

}  // namespace detail

/// Observer of a trajectory that accumulates its Lyapunov spectrum: S where the force is
/// transmitted, S* in the backlash.
///
/// The consistent tangent comes from the loop of the motion itself. Kollár 2022 prints S and S*
/// with δ = τ beside a trajectory with δ = 0; passing the loop of δ = τ here gives the exponents of
/// Table 2.
/// @tparam Scalar  `double`, that of the loop
template <class Scalar>
class LyapunovObserver {
 public:
  /// @param tangent_loop  whose S and S* are the tangents
  /// @param gains         P (N/m) and D (N s/m) of the motion
  LyapunovObserver(const SampledLoop<Scalar>& tangent_loop, const PdGains<Scalar>& gains)
      : LyapunovObserver(std::make_shared<const ItineraryBlocks>(tangent_loop, gains)) {}

  /// @param blocks  of the loop whose S and S* are the tangents
  /// @param scope   what is computed
  explicit LyapunovObserver(std::shared_ptr<const ItineraryBlocks> blocks,
                            LyapunovScope scope = LyapunovScope::all)
      : engine_(std::move(blocks), scope) {}

  /// Takes the contact of the next sample, and nothing else of it.
  void operator()(const MotionSample<Scalar>& sample) {
    open_[0] = followed_by(open_[0], sample.engaged);
    if (!is_whole(open_[0])) return;
    engine_.push(open_);
    open_ = empty_blocks<Scalar>();
  }

  /// The spectrum over the samples seen so far, as of QR at every one of them. Reading it, however
  /// often, changes nothing.
  LyapunovSpectrum<Scalar, 5> spectrum() const { return engine_.spectrum(open_); }
  /// Number of batches complete, for the standard errors.
  std::size_t complete_batches() const { return engine_.complete_batches(); }
  /// Forgets all but the directions of the tangent vectors.
  void restart() {
    engine_.restart(open_);
    open_ = empty_blocks<Scalar>();
  }

 private:
  BlockSpectrum<Scalar> engine_;
  LaneBlocks<Scalar> open_ = empty_blocks<Scalar>();
};

namespace detail {

/// A motion of the sampled loop with its exponents.
template <class Motion>
class SampledLyapunov : public LyapunovObserver<double> {
 public:
  SampledLyapunov(Motion& motion, const std::shared_ptr<const ItineraryBlocks>& blocks,
                  LyapunovScope scope)
      : LyapunovObserver(blocks, scope), motion_(motion) {}

  void sense() { sample_ = motion_.sense(); }
  void advance() {
    (*this)(sample_);
    motion_.advance();
  }
  const auto& state() const { return motion_.state(); }

 private:
  Motion& motion_;
  MotionSample<double> sample_{};
};

}  // namespace detail

/// The Lyapunov exponents of the sampled loop with backlash along a motion, from where it stands.
///
///     auto blocks = std::make_shared<const ItineraryBlocks>(loop, gains);
///     const LyapunovResult result = run_lyapunov(motion, blocks, {1000000, 1000, 1e-5});
///
/// @param motion  SampledMotion on scalars; left after the last sample taken
/// @param blocks  of the loop whose S and S* are the tangents
/// @param run     how long, and with what accuracy, is averaged
/// @throws InvalidParameter where `run` is not admissible
template <class Motion>
LyapunovResult run_lyapunov(Motion& motion, const std::shared_ptr<const ItineraryBlocks>& blocks,
                            const LyapunovRun& run) {
  validate(run);
  detail::SampledLyapunov<Motion> lyapunov(motion, blocks, run.scope);
  return detail::run_average(lyapunov, run, {});
}

}  // namespace holdfast
