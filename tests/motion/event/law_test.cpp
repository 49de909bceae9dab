#include "holdfast/contact/contact.hpp"
#include "motion/event/kollar_event.hpp"
#include "motion/event/slow_flow.hpp"
#include "support/random_loop.hpp"

namespace holdfast {
namespace {

using test::acceleration_between;
using test::BacklashMotion;
using test::SlowFlow;

/// Follows a motion beside it, part by part, and holds every instant against the law: the words of
/// the law with a direction and a gap of its own.
class LawWatch {
 public:
  LawWatch(BacklashMotion& motion, const TwoMass<double>& plant, double width)
      : motion_(motion), plant_(plant), width_(width), flow_(plant, motion.loop().force.harmonics) {
    mode_ = motion.contact().mode();
  }

  void move_one_sample() {
    begin_ = motion_.time();
    reached_ = 0.0;
    state_ = motion_.state();
    command_ = motion_.previous_command();
    motion_.sense();
    if (motion_.loop().sampling.processing_delay == 0.0) command_ = motion_.command();
    if (motion_.contact().mode() != mode_) jump_to(motion_.contact().mode());
    motion_.advance(*this);
    expect_near((state_ - motion_.state()).cwiseAbs().maxCoeff(), 1e-10 * size_, "the state");
    if (mode_ == 2) expect_near(relative_velocity(motion_.state()), 0.0, "Δż while it sticks");
  }

  // The observer.
  void flowed(int mode, double begin, double length) {
    expect(mode == mode_, "a part is in the mode that the last change brought");
    expect(std::abs(begin - reached_) <= 1e-12 * (begin + length), "the parts join");
    constexpr int parts = 8;
    for (int k = 0; k < parts && length > 0.0; ++k) {
      const double time = begin_ + begin + length * k / parts;
      state_ = flow_.moved(mode_, state_, command_, time, length / parts);
      reached_ = begin + length * (k + 1) / parts;
      size_ = std::max(size_, state_.cwiseAbs().maxCoeff());
      check_inside(k + 1 == parts);
    }
  }
  void commanded() { command_ = motion_.command(); }
  void switched(int from, int to, int guard, const ContactInstant& instant) {
    expect(from == mode_ && from != to, "a change is from the present mode to another one");
    expect_near((state_ - instant.state).cwiseAbs().maxCoeff(), 1e-10 * size_, "the state there");
    ++counts[static_cast<std::size_t>(to)];
    if (guard < 0) return jump_to(to);
    state_ = instant.state;
    if (from == 0) reverse(to);
    if (from == 1) leave_gap(to, guard);
    if (from == 2) leave_stick(to);
    mode_ = to;
  }

  std::array<int, 3> counts{};
  int complaints = 0;

 private:
  void expect(bool fulfilled, const char* words) {
    if (fulfilled || ++complaints > 5) return;
    ADD_FAILURE() << words << ", at " << begin_ << " + " << reached_ << " s";
  }
  void expect_near(double value, double tolerance, const char* words) {
    if (std::abs(value) <= tolerance || ++complaints > 5) return;
    ADD_FAILURE() << words << ": " << value << " against " << tolerance << ", at " << begin_
                  << " + " << reached_ << " s, mode " << mode_;
  }

  /// σ a(s), up to rounding zero.
  double outward(double transmitted) const {
    const auto a =
        acceleration_between(plant_, state_, transmitted, flow_.force_at(begin_ + reached_));
    return std::abs(a.value) <= 1e-9 * a.size ? 0.0 : sign_ * a.value;
  }

  void check_inside(bool at_the_end) {
    const double v = relative_velocity(state_), d = relative_displacement(state_);
    const double rounding = 1e-10 * size_;
    if (mode_ == 0) {
      if (sign_ == 0.0 && std::abs(v) > rounding) sign_ = v > 0.0 ? 1.0 : -1.0;
      expect(sign_ * v >= -rounding, "engaged, it goes on in its direction");
    } else if (mode_ == 1) {
      expect(d >= lower_ - rounding && d <= upper_ + rounding,
             "in the gap, it is between its ends");
    } else {
      expect(std::abs(v) <= rounding, "while it sticks, its sides stay together");
      state_[3] = state_[1];
      if (at_the_end) return;
      expect(outward(0.0) >= 0.0 && outward(command_) <= 0.0,
             "what a stick transmits is between none and the command");
    }
  }

  void reverse(int to) {
    expect_near(relative_velocity(state_), 1e-10 * size_, "Δż where it reverses");
    state_[3] = state_[1];
    const double here = relative_displacement(state_);
    lower_ = sign_ > 0.0 ? here - width_ : here;
    upper_ = sign_ > 0.0 ? here : here + width_;
    const double free = outward(0.0), driven = outward(command_);
    if (free == 0.0 || driven == 0.0) return;
    expect((to == 2) == (free > 0.0 && driven < 0.0), "it sticks exactly where the law says");
  }

  void leave_gap(int to, int guard) {
    expect(to == 0, "a gap is left for contact");
    sign_ = guard == 0 ? 1.0 : -1.0;
    const double end = guard == 0 ? upper_ : lower_;
    expect_near(relative_displacement(state_) - end, 1e-10 * size_, "Δz where the gap ends");
    expect(sign_ * relative_velocity(state_) >= -1e-10 * size_, "the gap is left outwards");
  }

  void leave_stick(int to) {
    if (to == 1) {
      expect(outward(0.0) <= 0.0, "a stick ends in the gap where the spring does not push on");
    } else {
      expect(to == 0 && outward(command_) >= 0.0, "and in contact where the command does not hold");
    }
  }

  void jump_to(int to) {
    expect(mode_ == 2, "a jump of the command ends nothing but a stick");
    leave_stick(to);
    mode_ = to;
  }

  BacklashMotion& motion_;
  TwoMass<double> plant_;
  double width_;
  SlowFlow flow_;
  Vector<double, 4> state_ = Vector<double, 4>::Zero();
  double begin_ = 0.0, reached_ = 0.0, command_ = 0.0;
  double sign_ = 0.0, lower_ = 0.0, upper_ = 0.0;
  double size_ = 0.0;
  int mode_ = 0;
};

/// A drive over decades, its force and gains of the size of the absorber's spring.
struct RandomDrive {
  TwoMass<double> plant;
  DigitalLoop loop;
  double width;
  Vector<double, 4> state;
};

RandomDrive random_drive(test::Random& random) {
  const auto plant = test::random_plant(random);
  const double omega = std::sqrt(plant.absorber_stiffness / plant.absorber_mass);
  const double both =
      plant.conductor_mass * plant.absorber_mass / (plant.conductor_mass + plant.absorber_mass);
  DigitalLoop loop;
  loop.sampling = test::random_sampling(plant, random);
  loop.gains = {random.sign() * both * omega * omega * random.log_uniform(0.01, 2.0),
                random.sign() * both * omega * random.log_uniform(0.01, 1.0)};
  loop.force.harmonics = {{both * omega * omega, omega / 6.3 * random.log_uniform(0.2, 5.0),
                           random.uniform(-3.0, 3.0)}};
  if (random.unit() < 0.3)
    loop.force.harmonics.push_back(
        {0.5 * both * omega * omega, omega / 6.3 * random.log_uniform(0.2, 5.0), 0.4});
  loop.hold = ForceHold::exact;
  Vector<double, 4> state = Vector<double, 4>::Zero();
  if (random.unit() < 0.5) {
    state = random.matrix<Vector<double, 4>>();
    state[1] *= omega;
    state[3] *= omega;
  }
  return {plant, loop, random.log_uniform(1e-3, 1.0), state};
}

TEST(EventMotion, KeepsTheLawAtEveryInstantOfRandomMotions) {
  test::Random random(1361);
  std::array<int, 3> counts{};
  for (int draw = 0; draw < 200; ++draw) {
    const RandomDrive drive = random_drive(random);
    BacklashMotion motion(drive.loop, test::exact_backlash(drive.plant, drive.width), drive.state);
    LawWatch watch(motion, drive.plant, drive.width);
    for (int j = 0; j < 120 && motion.state().norm() < 1e6; ++j) {
      watch.move_one_sample();
      ASSERT_EQ(watch.complaints, 0) << "draw " << draw << ", sample " << j;
    }
    EXPECT_FALSE(motion.counts().accumulates);
    for (std::size_t mode = 0; mode < 3; ++mode) counts[mode] += watch.counts[mode];
  }
  std::cout << counts[0] << " times engaged, " << counts[1] << " gaps, " << counts[2]
            << " sticks\n";
  for (const int count : counts) EXPECT_GT(count, 500);
}

}  // namespace
}  // namespace holdfast
