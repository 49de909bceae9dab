#pragma once

#include "holdfast/contact/hysteresis.hpp"
#include "holdfast/control/gains.hpp"
#include "holdfast/control/loop_input.hpp"
#include "holdfast/control/sampled_loop.hpp"
#include "holdfast/motion/ideal_loop.hpp"
#include "holdfast/motion/observers.hpp"
#include "holdfast/motion/sampled_motion.hpp"
#include "holdfast/motion/trajectory.hpp"
#include "holdfast/plant/two_mass.hpp"
#include "support/testing.hpp"

namespace holdfast::test {

/// The case of Kollár 2022, §4.2: 0.5 N at 10 Hz, P = −557 N/m, D = −13 N s/m, from rest.
struct KollarCase {
  double sampling_period = 0.001;
  double width = 0.0005;
  PdGains<double> gains{-557.0, -13.0};
  double processing_delay = 0.0;
  Vector<double, 4> initial_state = Vector<double, 4>::Zero();
  HarmonicExcitation<double> excitation{0.5, 10.0};

  KollarCase without_control() const {
    KollarCase other = *this;
    other.gains = {0.0, 0.0};
    return other;
  }

  SampledLoop<double> loop() const {
    return sampled_loop(kollar2022_plant(), Sampling<double>{sampling_period, processing_delay});
  }

  IdealLoop<double> ideal_loop() const {
    return {kollar2022_plant(), {sampling_period, processing_delay}, gains, excitation, width};
  }

  template <class Law = Backlash<double>>
  SampledMotion<double, Law> motion() const {
    const SampledLoop<double> sampled = loop();
    return {sampled, gains, held_harmonic(sampled), excitation, Law(width), initial_state};
  }
};

/// The case with another period (s) and width (m).
inline KollarCase kollar_case(double period, double width) {
  KollarCase which;
  which.sampling_period = period;
  which.width = width;
  return which;
}

/// Its loop with another period (s), width (m) and δ/τ.
inline IdealLoop<double> kollar_loop(double period, double width, double delay_fraction = 0.0) {
  KollarCase which = kollar_case(period, width);
  which.processing_delay = delay_fraction * period;
  return which.ideal_loop();
}

/// Every sample of a case from rest to `duration` (s).
template <class Law = Backlash<double>>
std::vector<MotionSample<double>> record(const KollarCase& which, double duration,
                                         const std::optional<Kick>& kick = std::nullopt) {
  auto motion = which.motion<Law>();
  const std::int64_t samples = samples_within(duration, which.sampling_period);
  Recorder recorder(samples);
  run_trajectory(motion, samples, kick, recorder);
  return recorder.samples();
}

}  // namespace holdfast::test
