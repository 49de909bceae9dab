#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
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
  double standard_error = 0;  ///< ≥ 0, of λ₁ per sample, that is accurate enough; 0: none is
  LyapunovScope scope = LyapunovScope::all;  ///< what is computed
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

/// The Lyapunov exponents of a motion, natural logarithm per sample, over the samples from where
/// they have settled (settled_means()).
struct LyapunovResult {
  LyapunovOutcome outcome;  ///< why no more samples were taken
  /// λ₁ … λ₅ in the order of the QR, −∞ for a null direction; NaN but for the first where that
  /// alone was asked for.
  Vector<double, 5> exponents;
  /// Count what the beginning may have left in the means, as settled_means() says; 0 for −∞.
  Vector<double, 5> standard_errors;
  std::int64_t samples;       ///< averaged over
  std::int64_t settling = 0;  ///< left out before them, beyond those of LyapunovRun::discard

  /// Whether the 99 % interval of λ₁ leaves out zero: whether it is known if neighbours separate.
  bool sign_is_known() const {
    if (exponents[0] == -std::numeric_limits<double>::infinity()) return true;
    if (!std::isfinite(exponents[0]) || !std::isfinite(standard_errors[0])) return false;
    const ExponentEstimate first = exponent_estimate(exponents[0], standard_errors[0]);
    return first.positive() || first.negative();
  }
};

/// Fewest complete batches on which a run may end early.
inline constexpr std::size_t fewest_batches = 32;

namespace detail {

/// The five leading exponents of a spectrum as the result of a run.
/// @tparam Size  ≥ 5
template <int Size>
LyapunovResult lyapunov_result(LyapunovOutcome outcome,
                               const LyapunovSpectrum<double, Size>& spectrum,
                               const LyapunovRun& run) {
  const SettledMeans<Size> settled = spectrum.settled();
  LyapunovResult result{outcome, settled.means.template head<5>(),
                        settled.standard_errors.template head<5>(), settled.steps,
                        settled.left_out};
  if (run.scope == LyapunovScope::largest) {
    result.exponents.tail<4>().setConstant(std::numeric_limits<double>::quiet_NaN());
    result.standard_errors.tail<4>().setConstant(std::numeric_limits<double>::quiet_NaN());
  }
  return result;
}

/// Averages the exponents of one motion: leaves out the first samples, then goes on until their
/// mean is accurate enough, the samples are at an end or the motion diverges.
/// @param pause  called every 2¹² samples
/// @tparam Lyapunov  sense(), advance() and state() are those of the motion, restart(), spectrum()
///                   and complete_batches() those of the exponents
template <class Lyapunov>
LyapunovResult run_average(Lyapunov& motion, const LyapunovRun& run,
                           const std::function<void()>& pause) {
  constexpr std::int64_t samples_between_pauses = 1 << 12;
  bool diverged = false;
  const auto advance = [&](std::int64_t samples, const auto& is_enough) {
    for (std::int64_t taken = 0; taken < samples && !diverged; ++taken) {
      if (pause && taken % samples_between_pauses == 0) pause();
      motion.sense();
      diverged = !std::isfinite(motion.state().sum());
      if (diverged) return;
      motion.advance();
      if (is_enough()) return;
    }
  };
  advance(run.discard, [] { return false; });
  motion.restart();
  std::optional<LyapunovResult> accurate;
  std::size_t judged = 0;
  advance(run.most_samples, [&] {
    const std::size_t batches = motion.complete_batches();
    const bool is_new = batches != judged && batches >= fewest_batches;
    if (!is_new || !(run.standard_error > 0.0)) return false;
    judged = batches;
    const auto now = lyapunov_result(LyapunovOutcome::accurate, motion.spectrum(), run);
    if (now.standard_errors[0] <= run.standard_error) accurate = now;
    return accurate.has_value();
  });
  if (accurate) return *accurate;
  const auto ending = diverged ? LyapunovOutcome::diverged : LyapunovOutcome::sample_limit;
  return lyapunov_result(ending, motion.spectrum(), run);
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
  void operator()(const MotionSample<Scalar>& sample) { push(sample.engaged); }
  /// The same.
  void push(bool engaged) {
    open_ = followed_by(open_, engaged);
    if (!is_whole(open_)) return;
    engine_.push(open_);
    open_ = empty_block;
  }

  /// The spectrum over the samples seen so far, as of QR at every one of them. Reading it, however
  /// often, changes nothing.
  LyapunovSpectrum<Scalar, 5> spectrum() const { return engine_.spectrum(open_); }
  /// Number of batches complete, for the standard errors.
  std::size_t complete_batches() const { return engine_.complete_batches(); }
  /// Forgets all but the directions of the tangent vectors.
  void restart() {
    engine_.restart(open_);
    open_ = empty_block;
  }

 private:
  BlockSpectrum<Scalar> engine_;
  ItineraryBlock open_ = empty_block;
};

namespace detail {

/// A motion of the sampled loop with its exponents, as run_average() takes it.
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

/// The exponents of a motion from where it stands, over a run.
template <class Motion, class Exponents>
LyapunovResult run_sampled(Motion& motion, const Exponents& exponents, const LyapunovRun& run,
                           const std::function<void()>& pause) {
  SampledLyapunov<Motion, Exponents> lyapunov(motion, exponents);
  return run_average(lyapunov, run, pause);
}

}  // namespace detail

/// The Lyapunov exponents of the sampled loop with backlash along a motion, from where it stands.
///
///     auto blocks = std::make_shared<const ItineraryBlocks>(loop, gains);
///     const LyapunovResult result = run_lyapunov(motion, blocks, {1000000, 1000, 1e-5});
///
/// @param motion  SampledMotion on scalars; left after the last sample taken
/// @param blocks  of the loop whose S and S* are the tangents
/// @param run     how long, and with what accuracy, is averaged
/// @param pause   called every 2¹² samples; may throw to end the run
/// @throws InvalidParameter where `run` is not admissible or there are no blocks
template <class Motion>
LyapunovResult run_lyapunov(Motion& motion, const std::shared_ptr<const ItineraryBlocks>& blocks,
                            const LyapunovRun& run, const std::function<void()>& pause = {}) {
  validate(run);
  require_within("number of itinerary blocks", blocks ? 1.0 : 0.0, "", 1, 1);
  return detail::run_sampled(motion, LyapunovObserver<double>(blocks, run.scope), run, pause);
}

}  // namespace holdfast
