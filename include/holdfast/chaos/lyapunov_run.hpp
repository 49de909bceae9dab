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
  LyapunovScope judged = LyapunovScope::largest;
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
  /// λ₁ … λ₅ in the order of the QR, −∞ where a direction is annihilated; NaN but for the first
  /// where that alone was asked for.
  Vector<double, 5> exponents;
  /// By batch means, the larger of those from the batches and from pairs of them; 0 for −∞.
  Vector<double, 5> standard_errors;
  std::int64_t samples;  ///< averaged over

  /// Whether the 95 % interval of λ₁ leaves out zero: whether it is known if neighbours separate.
  bool sign_is_known() const {
    if (exponents[0] == -std::numeric_limits<double>::infinity()) return true;
    if (!std::isfinite(exponents[0]) || !std::isfinite(standard_errors[0])) return false;
    const ExponentEvidence evidence = exponent_evidence(exponents[0], standard_errors[0]);
    return evidence.positive() || evidence.negative();
  }
};

/// Fewest complete batches on which a run may end early.
inline constexpr std::size_t batches_to_judge = 32;

/// Whether a spectrum is known as well as a run asks for.
inline bool accurate_enough(const Vector<double, 5>& standard_errors, const LyapunovRun& run) {
  const bool all = run.judged == LyapunovScope::all && run.scope == LyapunovScope::all;
  const double error = all ? standard_errors.maxCoeff() : standard_errors[0];
  return error <= run.standard_error && !standard_errors.hasNaN();
}

/// What a run makes of a spectrum.
inline LyapunovResult lyapunov_result(LyapunovOutcome outcome,
                                      const LyapunovSpectrum<double, 5>& spectrum,
                                      const LyapunovRun& run) {
  LyapunovResult result{outcome, spectrum.exponents(), spectrum.cautious_standard_errors(),
                        spectrum.steps()};
  if (run.scope == LyapunovScope::largest) {
    result.exponents.tail<4>().setConstant(std::numeric_limits<double>::quiet_NaN());
    result.standard_errors.tail<4>().setConstant(std::numeric_limits<double>::quiet_NaN());
  }
  return result;
}

namespace detail {

/// The contacts of the next `samples` samples of a motion; fewer if it diverges.
template <class Motion>
LaneWords<double> next_contacts(Motion& motion, std::int64_t samples) {
  ContactWord word = 1;
  for (std::int64_t taken = 0; taken < samples; ++taken) {
    const bool engaged = motion.sense().engaged;
    if (!std::isfinite(motion.state().sum())) break;
    word = followed_by(word, engaged);
    motion.advance();
  }
  return {word};
}

/// How a series of words ended.
struct OpenContacts {
  LaneWords<double> word;  ///< the last one, incomplete
  bool diverged;           ///< whether the motion did, after that word
};

/// Goes through `samples` samples of a motion: whole words to `take`, which may end it by returning
/// false.
template <class Motion, class Take>
OpenContacts run_contacts(Motion& motion, std::int64_t samples, const Take& take) {
  while (samples > 0) {
    const std::int64_t wanted = std::min<std::int64_t>(samples, ContactWords::length);
    const LaneWords<double> word = next_contacts(motion, wanted);
    if (!is_whole(word[0])) return {word, samples_of(word[0]) < wanted};
    samples -= ContactWords::length;
    if (!take(word)) break;
  }
  return {no_contacts<double>(), false};
}

}  // namespace detail

/// The Lyapunov exponents of the sampled loop with backlash along a motion, from where it stands.
///
///     auto words = std::make_shared<const ContactWords>(loop, gains);
///     const LyapunovResult result = run_lyapunov(motion, words, {1000000, 1000, 1e-5});
///
/// @param motion  SampledMotion on scalars; left after the last sample taken
/// @param words   of the loop whose S and S* are the tangents
/// @param run     how long, and with what accuracy, is averaged
/// @throws InvalidParameter where `run` is not admissible
template <class Motion>
LyapunovResult run_lyapunov(Motion& motion, const std::shared_ptr<const ContactWords>& words,
                            const LyapunovRun& run) {
  validate(run);
  ContactSpectrum<double> spectrum(words, run.scope);
  const auto discarded = detail::run_contacts(motion, run.discard, [&](const auto& word) {
    spectrum.push(word);
    return true;
  });
  spectrum.restart(discarded.word);
  if (discarded.diverged)
    return lyapunov_result(LyapunovOutcome::diverged, spectrum.spectrum(), run);

  std::size_t judged = 0;
  bool accurate = false;
  const auto open = detail::run_contacts(motion, run.most_samples, [&](const auto& word) {
    spectrum.push(word);
    const std::size_t batches = spectrum.complete_batches();
    if (batches == judged || batches < batches_to_judge || run.standard_error == 0) return true;
    judged = batches;
    accurate = accurate_enough(spectrum.spectrum().cautious_standard_errors(), run);
    return !accurate;
  });
  const auto outcome = open.diverged ? LyapunovOutcome::diverged
                       : accurate    ? LyapunovOutcome::accurate
                                     : LyapunovOutcome::sample_limit;
  return lyapunov_result(outcome, spectrum.spectrum(open.word), run);
}

}  // namespace holdfast
