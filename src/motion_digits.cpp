#include "motion_digits.hpp"

#include <algorithm>
#include <cmath>

#include "holdfast/attractor/deviation.hpp"
#include "holdfast/core/trusted_digits.hpp"
#include "holdfast/motion/instant.hpp"
#include "loop_of_case.hpp"

namespace holdfast::program {
namespace {

using Wide = long double;

SampledMotion<Wide> wide_motion(const ForcedLoop<double>& loop, const Vector<double, 4>& state) {
  return harmonically_forced_motion(converted<Wide>(loop), Vector<Wide, 4>(state.cast<Wide>()));
}

int whole(double digits) { return static_cast<int>(std::floor(digits)); }

/// The fewest of several quantities and the name of the one that has them.
class Fewest {
 public:
  void take(const std::string& name, double value, Wide reference) {
    const double digits = holdfast::trusted_digits(value, reference);
    if (!(digits < least_)) return;
    least_ = digits;
    name_ = name;
  }
  TrustedDigits result() const { return {whole(least_), std::nullopt, name_}; }

 private:
  double least_ = most_trusted_digits;
  std::string name_;
};

void take_root(Fewest& fewest, const ReducedMasses& found, const FrequencyReduction<Wide>& asked,
               bool larger) {
  const std::string which = larger ? "_other_root" : "";
  const Wide stiffness = absorber_stiffness_root(asked, larger);
  fewest.take("absorber_stiffness" + which, found.absorber_stiffness, stiffness);
  fewest.take("conductor_mass" + which, found.conductor_mass,
              reduced_conductor_mass(asked, stiffness));
}

}  // namespace

MotionDigits::MotionDigits(const ForcedLoop<double>& loop, const Vector<double, 4>& initial_state,
                           const std::optional<Kick>& kick, double from)
    : reference_(wide_motion(loop, initial_state)),
      kick_(kick),
      from_(from),
      least_(most_trusted_digits) {}

void MotionDigits::operator()(const MotionSample<double>& sample) {
  const bool settled = lost_ && least_ < 1.0;
  if (settled || compared_ == most_compared_samples) return;
  if (kick_ && not_before(sample.time, kick_->time)) {
    reference_.displace_conductor(kick_->displacement);
    kick_.reset();
  }
  const double digits = digits_of(sample.state, reference_.sense().state);
  if (not_before(sample.time, from_)) least_ = std::min(least_, digits);
  lost_ = lost_ || digits < digits_taken_for_granted;
  if (!lost_) until_ = sample.time;
  reference_.advance();
  ++compared_;
}

double MotionDigits::digits_of(const Vector<double, 4>& state, const Vector<Wide, 4>& reference) {
  const Vector<Wide, 4> size = reference.cwiseAbs();
  scale_ = scale_.cwiseMax(size.head<2>()).cwiseMax(size.tail<2>());
  // The largest share first: one logarithm a sample.
  Wide largest = 0.0L;
  for (int i = 0; i < 4; ++i) {
    const Wide difference = std::abs(static_cast<Wide>(state[i]) - reference[i]);
    if (difference > 0.0L) largest = std::max(largest, difference / scale_[i % 2]);
  }
  return holdfast::trusted_digits(static_cast<double>(largest), 0.0L, 1.0L);
}

TrustedDigits MotionDigits::result() const {
  return {whole(least_), lost_ ? std::optional<double>(until_) : std::nullopt, ""};
}

TrustedDigits trusted_digits_of_motion(const Case& the_case, Switching switching,
                                       std::int64_t samples, double from) {
  if (!is_of_the_paper(the_case, switching)) return {};
  MotionDigits digits(forced_loop_of(the_case), initial_state_of(the_case), std::nullopt, from);
  auto motion = motion_of(the_case);
  run_trajectory(motion, std::min(samples, most_compared_samples), std::nullopt, digits);
  return digits.result();
}

TrustedDigits trusted_digits_of_deviation(const Case& the_case, Switching switching, double offset,
                                          std::int64_t samples) {
  if (!is_of_the_paper(the_case, switching)) return {};
  auto first = motion_of(the_case), second = first;
  auto wide_first = wide_motion(forced_loop_of(the_case), initial_state_of(the_case));
  auto wide_second = wide_first;
  second.displace_conductor(offset);
  wide_second.displace_conductor(offset);
  double least = most_trusted_digits, until = 0.0;
  bool lost = false;
  for (std::int64_t j = 0; j < std::min(samples, most_compared_samples) && least >= 1.0; ++j) {
    const Vector<double, 4> difference = second.sense().state - first.sense().state;
    const Vector<Wide, 4> reference = wide_second.sense().state - wide_first.sense().state;
    if (!difference.allFinite()) break;
    least = std::min(least, holdfast::trusted_digits(difference, reference));
    lost = lost || least < digits_taken_for_granted;
    if (!lost) until = first.time();
    first.advance();
    second.advance();
    wide_first.advance();
    wide_second.advance();
  }
  return {whole(least), lost ? std::optional<double>(until) : std::nullopt, ""};
}

TrustedDigits trusted_digits_of_reduction(const FrequencyReduction<double>& asked) {
  const FrequencyReduction<Wide> wide{asked.conductor_stiffness, asked.absorber_mass,
                                      asked.first_frequency, asked.second_frequency};
  const ReductionResult found = reduce_to_frequencies(asked);
  Fewest fewest;
  fewest.take("discriminant", found.discriminant, reduction_discriminant(wide));
  fewest.take("largest_absorber_mass", found.largest_absorber_mass, largest_absorber_mass(wide));
  if (found.outcome == ReductionOutcome::no_solution) return fewest.result();
  take_root(fewest, found.solutions[0], wide, false);
  take_root(fewest, found.solutions[1], wide, true);
  return fewest.result();
}

}  // namespace holdfast::program
