#include "jobs/motion/motion_digits.hpp"

#include <algorithm>
#include <cmath>

#include "holdfast/math/stats/trusted_digits.hpp"
#include "holdfast/motion/instant.hpp"
#include "text/text.hpp"

namespace holdfast::program {
namespace {

using Wide = long double;

SampledMotion<Wide> wide_motion(const IdealLoop<double>& loop, const Vector<double, 4>& state) {
  return harmonically_forced_motion(converted<Wide>(loop), Vector<Wide, 4>(state.cast<Wide>()));
}

constexpr Wide largest_share = 1e-6L;  // of digits_taken_for_granted

int whole_digits(double digits) { return static_cast<int>(std::floor(digits)); }

/// The smallest number of trusted digits of several quantities, and the name of that quantity.
class Fewest {
 public:
  void take(const std::string& name, double value, Wide reference) {
    const double digits = holdfast::trusted_digits(value, reference);
    if (!(digits < least_)) return;
    least_ = digits;
    name_ = name;
  }
  TrustedDigits result() const { return {whole_digits(least_), std::nullopt, name_}; }

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

std::string trust_warning(const TrustedDigits& trusted) {
  if (!is_worth_telling(trusted)) return "";
  const std::string few =
      std::string("fewer than six digits that ") +
      (trusted.by_rounding ? "a run with other rounding errors" : "a run in extended precision") +
      " confirms";
  if (trusted.until)
    return "after t = " + format_number(*trusted.until) + " s the result has " + few +
           ": rounding errors dominate (trusted_digits in the metadata)";
  return (trusted.least.empty() ? "the result" : trusted.least) + " has " + few +
         " (trusted_digits in the metadata)";
}

MotionDigits::MotionDigits(const IdealLoop<double>& loop, const Vector<double, 4>& initial_state,
                           const std::optional<Kick>& kick, double from)
    : reference_(wide_motion(loop, initial_state)), kick_(kick), from_(from) {}

MotionDigits::MotionDigits(const CaseMotion& motion, const std::optional<Kick>& kick, double from)
    : reference_(RoundedMotion(motion)), kick_(kick), from_(from) {}

void MotionDigits::operator()(const MotionSample<double>& sample) {
  const bool settled = lost_ && largest_ >= 0.1L;  // no whole digit
  if (settled || compared_ == most_compared_samples) return;
  const Vector<Wide, 4> other = std::visit(
      [&](auto& reference) {
        if (kick_ && not_before(sample.time, kick_->time)) {
          reference.displace_conductor(kick_->displacement);
          kick_.reset();
        }
        const Vector<Wide, 4> state = reference.sense().state.template cast<Wide>();
        reference.advance();
        return state;
      },
      reference_);
  const Wide share = share_of(sample.state, other);
  if (not_before(sample.time, from_)) largest_ = std::max(largest_, share);
  lost_ = lost_ || share > largest_share;
  if (!lost_) until_ = sample.time;
  ++compared_;
}

MotionDigits::Wide MotionDigits::share_of(const Vector<double, 4>& state,
                                          const Vector<Wide, 4>& reference) {
  const Vector<Wide, 4> size = reference.cwiseAbs();
  const Vector<Wide, 4> difference = (state.cast<Wide>() - reference).cwiseAbs();
  Wide share = 0.0L;
  for (int i = 0; i < 2; ++i) {  // displacements, velocities
    scale_[i] = std::max({scale_[i], size[i], size[i + 2]});
    const Wide larger = std::max(difference[i], difference[i + 2]);
    if (larger > 0.0L) share = std::max(share, larger / scale_[i]);
  }
  return share;
}

TrustedDigits MotionDigits::result() const {
  const double digits = holdfast::trusted_digits(static_cast<double>(largest_), 0.0L, 1.0L);
  return {whole_digits(digits), lost_ ? std::optional<double>(until_) : std::nullopt, "",
          std::holds_alternative<RoundedMotion>(reference_)};
}

EventSample RoundedMotion::sense() {
  constexpr double rounding = 0x1.0p-52;
  largest_ = std::max(largest_, std::abs(motion_.state()[0]));
  // Up or down as the golden section has it.
  const auto bits = static_cast<std::uint64_t>(motion_.index()) * 0x9e3779b97f4a7c15U;
  motion_.displace_conductor((bits >> 63U) != 0 ? rounding * largest_ : -rounding * largest_);
  return motion_.sense();
}

std::optional<MotionDigits> digits_beside(const MovingLoop& moving, const std::optional<Kick>& kick,
                                          double from) {
  if (const auto* masses = std::get_if<SampledMasses>(&moving))
    return MotionDigits(masses->loop, masses->state, kick, from);
  if (std::holds_alternative<BuiltMasses>(moving))
    return MotionDigits(CaseMotion(moving), kick, from);
  return std::nullopt;
}

TrustedDigits trusted_digits_of_motion(const MovingLoop& moving, const BuiltLoop& built,
                                       std::int64_t samples, double from) {
  auto digits = digits_beside(moving, {}, from);
  if (!digits) return {};
  auto motion = motion_of(std::get<BuiltMasses>(built));
  run_trajectory(motion, std::min(samples, most_compared_samples), std::nullopt, *digits);
  return digits->result();
}

TrustedDigits trusted_digits_of_deviation(const MovingLoop& moving, double offset,
                                          std::int64_t samples) {
  const auto* masses = std::get_if<SampledMasses>(&moving);
  if (masses == nullptr) return {};
  auto first = motion_of(*masses), second = first;
  auto wide_first = wide_motion(masses->loop, masses->state);
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
  return {whole_digits(least), lost ? std::optional<double>(until) : std::nullopt, ""};
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
