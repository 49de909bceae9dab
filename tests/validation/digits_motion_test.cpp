// How many digits of a motion with backlash may be trusted: the same motion in double and in long
// double, over the motions of Kollár 2022 (Figs. 6–9, Table 2) and an irregular one.
//
// Between two samples the motion is affine, so its rounding errors travel by the tangent maps S and
// S* alone, as long as both number types decide every contact alike.

#include "holdfast/chaos/lyapunov_spectrum.hpp"
#include "holdfast/sweep/metric_observer.hpp"
#include "support/digits.hpp"
#include "support/kollar_case.hpp"

namespace holdfast::motion_digits {
namespace {

using test::kollar_case;
using test::KollarCase;
using test::six;
using Wide = long double;

class MotionDigits : public test::Digits {};

constexpr double rounding = std::numeric_limits<double>::epsilon() / 2.0;

/// One motion in both number types, one sample at a time.
class Pair {
 public:
  explicit Pair(const IdealLoop<double>& loop)
      : narrow_(harmonically_forced_motion(loop, Vector<double, 4>(Vector<double, 4>::Zero()))),
        wide_(harmonically_forced_motion(converted<Wide>(loop),
                                         Vector<Wide, 4>(Vector<Wide, 4>::Zero()))) {}

  /// Takes a sample of both. @return whether they decide the contact alike
  bool take() {
    sample_ = narrow_.sense();
    reference_ = wide_.sense();
    const Vector<Wide, 4> size = reference_.state.cwiseAbs();
    scale_ = scale_.cwiseMax(size.head<2>()).cwiseMax(size.tail<2>());
    narrow_.advance();
    wide_.advance();
    return sample_.engaged == reference_.engaged;
  }

  /// Of the sample: displacements and velocities relative to the largest so far.
  double digits() const {
    double least = most_trusted_digits;
    for (int i = 0; i < 4; ++i)
      least = std::min(least, trusted_digits(sample_.state[i], reference_.state[i], scale_[i % 2]));
    return least;
  }

  const MotionSample<double>& sample() const { return sample_; }
  const MotionSample<Wide>& reference() const { return reference_; }
  const Vector<Wide, 2>& scale() const { return scale_; }

 private:
  SampledMotion<double> narrow_;
  SampledMotion<Wide> wide_;
  MotionSample<double> sample_{};
  MotionSample<Wide> reference_{};
  Vector<Wide, 2> scale_ = Vector<Wide, 2>::Zero();
};

/// Variance of the rounding errors of z̃ = [z; u] when each step adds an independent one of a unit
/// in the last place of each component: V ← M V Mᵀ + W.
class RoundingSpread {
 public:
  explicit RoundingSpread(const IdealLoop<double>& loop)
      : sampled_(sampled_loop(loop.plant, loop.sampling)), gains_(loop.gains) {}

  /// Goes on to the sample that the motion has just taken.
  void take(const Pair& motion) {
    variance_ = (map_ * variance_ * map_.transpose()).eval();
    const Vector<double, 2> scale = motion.scale().cast<double>();
    force_ = std::max(force_, std::abs(motion.sample().control_force));
    Vector<double, 5> unit;
    unit << scale[0], scale[1], scale[0], scale[1], force_;
    variance_ += (rounding * unit).cwiseAbs2().asDiagonal();
    map_ = motion.reference().engaged ? sampled_.engaged_map(gains_) : sampled_.backlash_map();
  }

  /// The largest share of displacements and velocities.
  double share(const Vector<Wide, 2>& scale) const {
    double largest = 0.0;
    for (int i = 0; i < 4; ++i)
      largest = std::max(largest, std::sqrt(variance_(i, i)) / static_cast<double>(scale[i % 2]));
    return largest;
  }

 private:
  SampledLoop<double> sampled_;
  PdGains<double> gains_;
  double force_ = 0.0;
  Matrix<double, 5> map_ = Matrix<double, 5>::Identity();  // from the last sample to the next
  Matrix<double, 5> variance_ = Matrix<double, 5>::Zero();
};

std::string short_text(double value) {
  std::ostringstream text;
  text << value;
  return text.str();
}

std::string name_of(const KollarCase& which) {
  return short_text(which.sampling_period * 1e3) + " ms, " + short_text(which.width * 1e3) + " mm";
}

std::vector<KollarCase> motions() {
  return {kollar_case(0.001, 0.0005), kollar_case(0.001, 0.002), kollar_case(0.001, 0.0028),
          kollar_case(0.003, 0.002),  kollar_case(0.010, 0.002), kollar_case(0.011, 0.002),
          kollar_case(0.011, 0.001)};
}

TEST_F(MotionDigits, OfTheMotionsOfThePaperAreThoseOfThePhaseOfTheForce) {
  // All their exponents are negative: old errors die out. What grows is the phase 2π f τ j, whose
  // f τ is rounded once: after N cycles the force is late by up to 2π N of such a rounding.
  constexpr double duration = 100.0;
  for (const KollarCase& which : motions()) {
    Pair motion(which.ideal_loop());
    double least = most_trusted_digits;
    const std::int64_t samples = samples_within(duration, which.sampling_period);
    for (std::int64_t j = 0; j < samples; ++j) {
      ASSERT_TRUE(motion.take()) << "the contacts part at sample " << j;
      least = std::min(least, motion.digits());
    }
    const double late = 1.0 + 2.0 * pi<double> * which.excitation.frequency * duration;
    report("100 s of motion", name_of(which), least, -std::log10(1000.0 * rounding * late));
    EXPECT_GE(least, six);
  }
}

/// D beyond the stable ones: the motion grows while the force acts and dies down in the backlash,
/// which keeps it bounded and irregular.
KollarCase irregular() {
  KollarCase which = kollar_case(0.01, 0.0005);
  which.gains.differential = -20.0;
  which.excitation.frequency = 6.0;
  return which;
}

TEST_F(MotionDigits, OfAnIrregularMotionAreLostAtTheRateOfItsTangentMaps) {
  const IdealLoop<double> loop = irregular().ideal_loop();
  Pair motion(loop);
  RoundingSpread spread(loop);
  std::int64_t parted = -1, predicted = -1;
  double digits = most_trusted_digits;
  double least = most_trusted_digits;
  for (std::int64_t j = 0; j < 4000; ++j) {
    const bool alike = motion.take();
    const double now = motion.digits();
    least = std::min(least, now);
    if (!alike && parted < 0) parted = j;
    if (parted >= 0) continue;
    digits = now;
    spread.take(motion);
    const double promised = -std::log10(1000.0 * spread.share(motion.scale()));
    if (j > 0 && promised > 1.0) {
      ASSERT_GE(now, promised) << "at sample " << j;
    }
    if (predicted < 0 && promised < six) predicted = j;
  }
  std::printf("  contacts part at sample %ld with %.1f digits; below six expected from %ld on\n",
              static_cast<long>(parted), digits, static_cast<long>(predicted));
  ASSERT_GT(parted, 0) << "the motion is meant to be irregular";
  ASSERT_GT(predicted, 0);
  EXPECT_GT(parted, predicted) << "contacts are alike while there are digits";
  EXPECT_LT(digits, six) << "and part when they are lost";
  EXPECT_LT(least, 1.0) << "of which none is left";
}

/// The metrics of `sweep` over the second half of a run.
template <class Scalar>
MetricObserver<Scalar> metrics_of(const KollarCase& which, double duration) {
  auto motion = harmonically_forced_motion(converted<Scalar>(which.ideal_loop()),
                                           Vector<Scalar, 4>(Vector<Scalar, 4>::Zero()));
  MetricObserver<Scalar> metrics;
  const std::int64_t samples = samples_within(duration, which.sampling_period);
  Scalar velocity(0);
  for (std::int64_t j = 0; j < samples; ++j) {
    const auto sample = motion.sense();
    const Scalar now = relative_velocity(sample.state);
    metrics.observe_extremum(sample.state[0]);
    metrics.observe_load(sample.control_force, relative_displacement(sample.state));
    if (2 * j >= samples)
      metrics.observe_steady(sample.state[0], sample.control_force, sample.engaged,
                             is_reversal(velocity, now));
    velocity = now;
    motion.advance();
  }
  return metrics;
}

TEST_F(MotionDigits, OfTheMetricsOfAMotion) {
  constexpr double promised = 9.0;  // of the phase after 200 cycles, see above, and of a sum
  for (const KollarCase& which : motions()) {
    const auto narrow = metrics_of<double>(which, 20.0);
    const auto wide = metrics_of<Wide>(which, 20.0);
    const std::string of = name_of(which);
    const auto tell = [&](const char* quantity, double found, Wide reference) {
      report(quantity, of, trusted_digits(found, reference), promised);
    };
    tell("first_peak", narrow.first_peak, wide.first_peak);
    tell("steady_peak", narrow.steady_peak, wide.steady_peak);
    tell("steady_rms", std::sqrt(narrow.squares), std::sqrt(wide.squares));
    tell("force_peak", narrow.force_peak, wide.force_peak);
    tell("force_rms", std::sqrt(narrow.force_squares), std::sqrt(wide.force_squares));
    tell("absorber_stroke", narrow.highest - narrow.lowest, wide.highest - wide.lowest);
    EXPECT_EQ(narrow.engaged, static_cast<double>(wide.engaged)) << of;
    EXPECT_EQ(narrow.reversals, static_cast<double>(wide.reversals)) << of;
  }
}

template <class Scalar>
Vector<Scalar, 5> exponents_of(const KollarCase& which, std::int64_t samples) {
  const auto loop = converted<Scalar>(which.ideal_loop());
  const auto sampled = sampled_loop(loop.plant, loop.sampling);
  const Matrix<Scalar, 5> engaged = sampled.engaged_map(loop.gains);
  const Matrix<Scalar, 5> backlash = sampled.backlash_map();
  auto motion = harmonically_forced_motion(loop, Vector<Scalar, 4>(Vector<Scalar, 4>::Zero()));
  LyapunovSpectrum<Scalar, 5> spectrum;
  for (std::int64_t j = 0; j < samples; ++j) {
    spectrum.push(motion.sense().engaged ? engaged : backlash, 4);
    motion.advance();
  }
  return spectrum.exponents();
}

TEST_F(MotionDigits, OfTheExponentsOfTable2) {
  // A mean of logarithms near 1 of numbers that are right to ε: ε over the exponent. δ = 0: S and
  // S* have rank four.
  for (const KollarCase& which : {kollar_case(0.001, 0.002), kollar_case(0.011, 0.002)}) {
    const std::int64_t samples = 9091;
    const auto narrow = exponents_of<double>(which, samples);
    const auto wide = exponents_of<Wide>(which, samples);
    for (int i = 0; i < 4; ++i)
      report("exponent " + std::to_string(i + 1), name_of(which),
             trusted_digits(narrow[i], wide[i]), 9.0);
    EXPECT_EQ(narrow[4], static_cast<double>(wide[4])) << "minus infinity in both";
  }
}

}  // namespace
}  // namespace holdfast::motion_digits
