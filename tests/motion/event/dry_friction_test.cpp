#include "holdfast/contact/contact.hpp"
#include "motion/event/kollar_event.hpp"
#include "support/random.hpp"

namespace holdfast {
namespace {

using test::MotionSwitch;
using test::SwitchNotes;

/// A block of mass m on a belt of speed v_b, held by a spring k: dry friction with a static limit
/// F_s and a kinetic force F_k < F_s.
struct BeltBlock {
  double mass, stiffness, belt_speed, static_limit, kinetic_force;
};

/// The block as a contact: z = [x, ẋ, x, v_b], so that Δż = v_b − ẋ.
///
///     m ẍ + k x = F_k    slipping back, ẋ < v_b
///     ẋ = v_b            sticking, while |k x| ≤ F_s
///     m ẍ + k x = −F_k   slipping forward, ẋ > v_b
class BeltContact {
 public:
  using Plant = TwoMass<double>;
  static constexpr int modes = 3;
  static constexpr int back = 0, stick = 1, forward = 2;

  /// Its energy is that of the block and the belt: conserved while it slips; while it sticks every
  /// guard is linear in time.
  explicit BeltContact(const BeltBlock& block)
      : plant_{block.mass, block.stiffness, 0.0, 1.0, 1.0, 0.0}, block_(block) {}

  PortReadings<Plant> readings() const { return {}; }
  const Plant& plant(int) const { return plant_; }
  double commanded(double command) const { return command; }
  bool changes_between_samples() const { return true; }
  void sample(const Vector<double, 4>&) {}
  void jumped(const ContactInstant&) {}
  void keep(const Vector<double, 4>&, Vector<double, 4>&) const {}
  void learn_sign(int, double) {}

  AffineDynamics dynamics(int mode) const {
    AffineDynamics moving{Matrix<double, 4>::Zero(), Vector<double, 4>::Zero(),
                          Vector<double, 4>::Zero()};
    if (mode == stick) {
      moving.state(0, 3) = moving.state(2, 3) = 1.0;
      return moving;
    }
    moving.state(0, 1) = moving.state(2, 1) = 1.0;
    moving.state(1, 0) = -block_.stiffness / block_.mass;
    moving.drift[1] = (mode == back ? 1.0 : -1.0) * block_.kinetic_force / block_.mass;
    return moving;
  }

  int mode() const { return mode_; }
  ContactMode word() const {
    return mode_ == stick  ? ContactMode::stick
           : mode_ == back ? ContactMode::engaged
                           : ContactMode::gap;
  }
  double transmitted(const ContactInstant&) const { return 0.0; }

  Guards guards() const {
    Guards result;
    result.count = 1;
    if (mode_ != stick) {
      result.guard[0] = {velocity_row() * (mode_ == back ? 1.0 : -1.0), 0.0, 0.0, 0.0, zeros_};
      return result;
    }
    const Vector<double, 4> spring(block_.stiffness, 0.0, 0.0, 0.0);
    result.guard[0] = {-spring, 0.0, 0.0, block_.static_limit};
    result.guard[1] = {spring, 0.0, 0.0, block_.static_limit};
    result.count = 2;
    return result;
  }

  void flowed() { zeros_ = 0; }

  void reached(int guard, ContactInstant& now) {
    zeros_ = 1;
    if (mode_ == stick) {
      mode_ = guard == 0 ? back : forward;
      return;
    }
    now.state[1] = now.state[3];
    const double pull = block_.stiffness * now.state[0];
    mode_ = std::abs(pull) <= block_.static_limit ? stick : pull > 0.0 ? back : forward;
  }

 private:
  Plant plant_;
  BeltBlock block_;
  int mode_ = stick;
  int zeros_ = 0;
};

/// The changes of a block from x = 0 at the speed of the belt; the samples mean nothing to it.
std::vector<MotionSwitch> changes_of_block(const BeltBlock& block, double period, int samples) {
  const DigitalLoop loop{{period, 0.0}, {0.0, 0.0}, {}, ForceHold::exact};
  const Vector<double, 4> state(0.0, block.belt_speed, 0.0, block.belt_speed);
  EventMotion<BeltContact> motion(loop, BeltContact(block), state);
  SwitchNotes notes(motion);
  notes.move(samples);
  EXPECT_FALSE(motion.counts().accumulates);
  return notes.switches;
}

// Closed form. With x_k = F_k / k, Δ = (F_s − F_k) / k and ω² = k / m the block slips from
// x = x_k + Δ, ẋ = v_b as
//
//     x(t) = x_k + Δ cos ω t + (v_b / ω) sin ω t
//
// until ẋ = v_b again: −ω Δ sin ω t = v_b (1 − cos ω t), so that tan(ω t / 2) = −ω Δ / v_b and
//
//     t_slip = (2π − 2 arctan(ω Δ / v_b)) / ω,
//
// where x = x_k − Δ, which the belt carries back to x_k + Δ in t_stick = 2 Δ / v_b. The system is
// that of R. I. Leine, D. H. van Campen, A. de Kraker, L. van den Steen, Stick-slip vibrations
// induced by alternate friction models, Nonlinear Dynamics 16 (1998), with a kinetic friction that
// does not depend on the speed.
TEST(DryFriction, SticksAndSlipsForAsLongAsTheClosedFormSays) {
  test::Random random(1363);
  for (int draw = 0; draw < 50; ++draw) {
    BeltBlock block{1.0, 1.0, 0.2, 1.0, 0.5};
    if (draw > 0) {
      block = {random.log_uniform(0.1, 10.0), random.log_uniform(0.1, 10.0),
               random.log_uniform(0.05, 2.0), random.log_uniform(0.2, 5.0), 0.0};
      block.kinetic_force = block.static_limit * random.uniform(0.05, 0.95);
    }
    const double omega = std::sqrt(block.stiffness / block.mass);
    const double reach = (block.static_limit - block.kinetic_force) / block.stiffness;
    const double stick = 2.0 * reach / block.belt_speed;
    const double slip =
        (2.0 * pi<double> - 2.0 * std::atan(omega * reach / block.belt_speed)) / omega;
    const double first = block.static_limit / block.stiffness / block.belt_speed;
    const double period = (stick + slip) * random.log_uniform(0.01, 3.0);
    const int samples = static_cast<int>(20.0 * (stick + slip) / period);
    const auto changes = changes_of_block(block, period, samples);
    ASSERT_GT(changes.size(), 30U);
    EXPECT_NEAR(changes[0].time(), first, 1e-10 * first);
    for (std::size_t k = 0; k + 1 < changes.size(); ++k) {
      const bool slips = k % 2 == 0;
      ASSERT_EQ(changes[k].to, slips ? BeltContact::back : BeltContact::stick) << k;
      const double lasted = changes[k + 1].time() - changes[k].time();
      ASSERT_NEAR(lasted, slips ? slip : stick, 1e-10 * (stick + slip)) << "draw " << draw;
    }
  }
}

// Faster than the belt, the block is slowed until it sticks; from then on it is on the same cycle.
TEST(DryFriction, FromAnyStateItComesToTheSameCycle) {
  const BeltBlock block{1.0, 1.0, 0.2, 1.0, 0.5};
  const double slip = 2.0 * pi<double> - 2.0 * std::atan(2.5), stick = 5.0;
  for (const double speed : {1.5, 0.7, -1.0}) {
    const DigitalLoop loop{{0.3, 0.0}, {0.0, 0.0}, {}, ForceHold::exact};
    const Vector<double, 4> state(0.3, speed, 0.3, block.belt_speed);
    BeltContact contact(block);
    ContactInstant begin{state, 0.0, 0.0};
    contact.reached(speed > block.belt_speed ? 1 : 0, begin);
    EventMotion<BeltContact> motion(loop, contact, state);
    SwitchNotes notes(motion);
    notes.move(200);
    const auto& changes = notes.switches;
    ASSERT_GT(changes.size(), 6U);
    const std::size_t last = changes.size() - 1;
    EXPECT_NEAR(changes[last].time() - changes[last - 2].time(), slip + stick, 1e-10) << speed;
  }
}

}  // namespace
}  // namespace holdfast
