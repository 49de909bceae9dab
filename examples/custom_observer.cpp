// How hard does the drive work? An observer is anything that can be called with a sample.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <optional>

#include "holdfast/motion/ideal_loop.hpp"
#include "holdfast/motion/observers.hpp"
#include "holdfast/motion/trajectory.hpp"
#include "holdfast/plant/two_mass.hpp"

using namespace holdfast;

class DriveDuty {
 public:
  void operator()(const MotionSample<double>& sample) {
    const double velocity = relative_velocity(sample.state);
    reversals_ += velocity * previous_velocity_ < 0.0 ? 1 : 0;
    previous_velocity_ = velocity;
    largest_force_ = std::max(largest_force_, std::abs(sample.control_force));
    ++(sample.engaged ? engaged_ : idle_);
  }

  std::int64_t reversals() const { return reversals_; }
  double largest_force() const { return largest_force_; }
  double idle_share() const {
    return static_cast<double>(idle_) / static_cast<double>(idle_ + engaged_);
  }

 private:
  std::int64_t reversals_ = 0, engaged_ = 0, idle_ = 0;
  double previous_velocity_ = 0.0, largest_force_ = 0.0;
};

int main() {
  IdealLoop<double> loop;
  loop.plant = kollar2022_plant();
  loop.sampling = {0.001};
  loop.gains = {-557.0, -13.0};
  loop.excitation = {0.5, 10.0};
  loop.backlash_width = 0.0005;
  auto motion = harmonically_forced_motion<double>(loop, Vector<double, 4>::Zero());

  DriveDuty duty;
  double travelled = 0.0;  // by the absorber, past the conductor
  const auto odometer = [&](const MotionSample<double>& sample) {
    travelled += std::abs(relative_velocity(sample.state)) * loop.sampling.period;
  };
  SwitchLog log(9.06);  // one of the library's own, from this instant (s) on
  run_trajectory(motion, samples_within(10.0, loop.sampling.period), std::nullopt, duty, odometer,
                 log);

  std::printf("%lld reversals, largest force %.3f N, idle %.1f %% of the samples\n",
              static_cast<long long>(duty.reversals()), duty.largest_force(),
              100.0 * duty.idle_share());
  std::printf("the absorber travelled %.3f m along the conductor\n", travelled);
  for (std::size_t k = 0; k < 4; ++k)
    std::printf("%s its gap at %.3f s\n", log.switches()[k].entered ? "enters" : "leaves",
                log.switches()[k].time);
}
