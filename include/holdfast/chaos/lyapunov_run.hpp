#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>

#include "holdfast/chaos/block_spectrum.hpp"
#include "holdfast/chaos/classification.hpp"
#include "holdfast/chaos/itinerary_blocks.hpp"
#include "holdfast/chaos/lyapunov_spectrum.hpp"
#include "holdfast/core/errors.hpp"
#include "holdfast/core/types.hpp"

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
/// @param average  take(samples, ends) takes up to so many samples, fewer where `ends()` says so at
///                 one of them, and tells whether the motion kept within the range of numbers;
///                 restart(), spectrum() and complete_batches() are those of the exponents
template <class Average>
LyapunovResult run_average(Average& average, const LyapunovRun& run) {
  const bool settled = average.take(run.discard, [] { return false; });
  average.restart();
  if (!settled) return lyapunov_result(LyapunovOutcome::diverged, average.spectrum(), run);
  JudgingTimes judging(run);
  bool accurate = false;
  const bool stayed = average.take(run.most_samples, [&] {
    if (!judging.have_come(average.complete_batches())) return false;
    const Vector<double, 5> errors =
        average.spectrum().cautious_standard_errors().template head<5>();
    accurate = accurate_enough(errors, run);
    return accurate;
  });
  const auto outcome = !stayed    ? LyapunovOutcome::diverged
                       : accurate ? LyapunovOutcome::accurate
                                  : LyapunovOutcome::sample_limit;
  return lyapunov_result(outcome, average.spectrum(), run);
}

/// The contacts of the next `samples` samples of a motion; fewer if it diverges.
template <class Motion>
LaneBlocks<double> next_blocks(Motion& motion, std::int64_t samples) {
  ItineraryBlock block = 1;
  for (std::int64_t taken = 0; taken < samples; ++taken) {
    const bool engaged = motion.sense().engaged;
    if (!std::isfinite(motion.state().sum())) break;
    block = followed_by(block, engaged);
    motion.advance();
  }
  return {block};
}

/// How a series of blocks ended.
struct OpenBlock {
  LaneBlocks<double> block;  ///< the last one, incomplete
  bool diverged;             ///< whether the motion did, after that block
};

/// Goes through `samples` samples of a motion: whole blocks to `take`, which may end it by
/// returning false.
template <class Motion, class Take>
OpenBlock run_blocks(Motion& motion, std::int64_t samples, const Take& take) {
  while (samples > 0) {
    const std::int64_t wanted = std::min<std::int64_t>(samples, ItineraryBlocks::length);
    const LaneBlocks<double> block = next_blocks(motion, wanted);
    if (!is_whole(block[0])) return {block, samples_of(block[0]) < wanted};
    samples -= ItineraryBlocks::length;
    if (!take(block)) break;
  }
  return {empty_blocks<double>(), false};
}

/// The average of run_average() over the contacts of a motion.
template <class Motion>
class BlockAverage {
 public:
  BlockAverage(Motion& motion, const std::shared_ptr<const ItineraryBlocks>& blocks,
               LyapunovScope scope)
      : motion_(motion), spectrum_(blocks, scope) {}

  template <class Ends>
  bool take(std::int64_t samples, const Ends& ends) {
    const OpenBlock open = run_blocks(motion_, samples, [&](const auto& block) {
      spectrum_.push(block);
      return !ends();
    });
    open_ = open.block;
    return !open.diverged;
  }

  void restart() {
    spectrum_.restart(open_);
    open_ = empty_blocks<double>();
  }
  auto spectrum() const { return spectrum_.spectrum(open_); }
  std::size_t complete_batches() const { return spectrum_.complete_batches(); }

 private:
  Motion& motion_;
  BlockSpectrum<double> spectrum_;
  LaneBlocks<double> open_ = empty_blocks<double>();
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
  detail::BlockAverage<Motion> average(motion, blocks, run.scope);
  return detail::run_average(average, run);
}

}  // namespace holdfast
