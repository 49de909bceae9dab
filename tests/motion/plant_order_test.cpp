// Motions of a plant of another order than that of the two masses: two masses, a measurement filter
// of first order and a drive that lags by second order, x = [z₁, ż₁, z₂, ż₂, z_f, s, ṡ/ω_d].

#include "holdfast/contact/contact.hpp"
#include "holdfast/motion/implemented_loop.hpp"
#include "holdfast/motion/variational_flow.hpp"
#include "support/lagging_plant.hpp"
#include "support/move_samples.hpp"
#include "support/random_loop.hpp"

namespace holdfast {
namespace {

using Order7 = LinearPlant<double, 7>;
using State7 = Vector<double, 7>;

struct Extras {
  double filter, bandwidth, damping;  // Hz, Hz, ζ_d
};

Order7 order_seven(const TwoMass<double>& plant, const Extras& extras) {
  return test::filtered_and_lagging_plant(extras.filter, extras.bandwidth, plant, extras.damping);
}

/// A loop whose drive lags: far from the edge of stability, with many changes of contact.
struct OrderSetting {
  TwoMass<double> plant = kollar2022_plant();
  Extras extras{80.0, 60.0, 0.7};
  Sampling<double> sampling{0.005, 0.001};
  PdGains<double> gains{-200.0, -5.0};
  HarmonicExcitation<double> excitation{0.5, 10.0};
  double width = 0.0005;
};

template <class Plant>
ImplementedLoopOf<Plant> loop_of(const OrderSetting& setting, const Plant& plant, ContactLaw law,
                                 Switching switching) {
  return {
      plant,
      {setting.sampling, setting.gains, multi_harmonic_force(setting.excitation), ForceHold::exact},
      {law, setting.width, 60.0, 0.2},
      switching};
}

/// The same plant written out, its contact followed by small steps of the classical Runge–Kutta
/// method and bisection.
class DenseReference {
 public:
  DenseReference(const OrderSetting& setting, Switching switching)
      : setting_(setting), exact_(switching == Switching::exact), law_(setting.width) {}

  void take_sample() {
    const double u = setting_.gains.proportional * x_[4] +
                     setting_.gains.differential * filter_rate() * (x_[0] - x_[4]);
    command_ = u;
    if (!exact_ && !law_.step(x_[2] - x_[0], x_[3] - x_[1])) command_ = 0.0;
  }

  void advance() {
    constexpr int steps = 400;
    const double tau = setting_.sampling.period, delay = setting_.sampling.processing_delay;
    const double begin = static_cast<double>(index_) * tau;
    run(previous_, begin, delay, steps);
    run(command_, begin + delay, tau - delay, 4 * steps);
    previous_ = command_;
    ++index_;
  }

  const State7& state() const { return x_; }
  const std::array<int, 3>& entered() const { return entered_; }

 private:
  double filter_rate() const { return 2.0 * pi<double> * setting_.extras.filter; }

  /// The relative acceleration under a force s between the masses.
  double acceleration(const State7& x, double s, double t) const {
    const State7 rate = rate_under(x, s, 0.0, t);
    return rate[3] - rate[1];
  }

  State7 rate_under(const State7& x, double s, double u, double t) const {
    const TwoMass<double>& p = setting_.plant;
    const double spring = p.absorber_stiffness * (x[2] - x[0]) + p.absorber_damping * (x[3] - x[1]);
    const HarmonicExcitation<double>& f = setting_.excitation;
    const double force = f.amplitude * std::cos(f.angular_frequency() * t);
    const double drive = 2.0 * pi<double> * setting_.extras.bandwidth;
    State7 rate;
    rate << x[1],
        (-p.conductor_stiffness * x[0] - p.conductor_damping * x[1] + spring + s + force) /
            p.conductor_mass,
        x[3], (-spring - s) / p.absorber_mass, filter_rate() * (x[0] - x[4]), drive * x[6],
        drive * (u - x[5]) - 2.0 * setting_.extras.damping * drive * x[6];
    return rate;
  }

  State7 rate(const State7& x, double u, double t) const {
    double s = 0.0;
    if (mode_ == ContactMode::engaged) s = x[5];
    if (mode_ == ContactMode::stick) {
      const double none = acceleration(x, 0.0, t);
      s = none / (none - acceleration(x, 1.0, t));
    }
    return rate_under(x, s, u, t);
  }

  State7 step(const State7& x, double u, double t, double h) const {
    const State7 k1 = rate(x, u, t), k2 = rate(x + 0.5 * h * k1, u, t + 0.5 * h),
                 k3 = rate(x + 0.5 * h * k2, u, t + 0.5 * h), k4 = rate(x + h * k3, u, t + h);
    return x + h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
  }

  /// Whether the mode has ended at a state.
  bool over(const State7& x, double t) const {
    const double d = x[2] - x[0], v = x[3] - x[1];
    if (!exact_) return false;
    if (mode_ == ContactMode::engaged) return sign_ != 0.0 && sign_ * v < 0.0;
    if (mode_ == ContactMode::gap) return d > upper_ + 1e-14 || d < lower_ - 1e-14;
    return !(sign_ * acceleration(x, 0.0, t) > 0.0 && sign_ * acceleration(x, x[5], t) < 0.0);
  }

  void run(double u, double begin, double length, int steps) {
    const double h = length / steps;
    for (int k = 0; k < steps; ++k) {
      double done = 0.0;
      for (int changes = 0; done < h && changes < 20; ++changes) {
        const double t = begin + k * h + done;
        State7 after = step(x_, u, t, h - done);
        if (!over(after, t + h - done)) {
          x_ = after;
          done = h;
          break;
        }
        double low = 0.0, high = h - done;
        for (int half = 0; half < 60; ++half) {
          const double middle = 0.5 * (low + high);
          (over(step(x_, u, t, middle), t + middle) ? high : low) = middle;
        }
        x_ = step(x_, u, t, high);
        done += high;
        change(t + high);
      }
      const double v = x_[3] - x_[1];
      if (mode_ == ContactMode::engaged && sign_ == 0.0 && std::abs(v) > 1e-9)
        sign_ = v > 0.0 ? 1.0 : -1.0;
    }
  }

  void change(double t) {
    const double d = x_[2] - x_[0];
    if (mode_ == ContactMode::engaged) {
      x_[3] = x_[1];
      lower_ = sign_ > 0.0 ? d - setting_.width : d;
      upper_ = lower_ + setting_.width;
      const bool sticks =
          sign_ * acceleration(x_, 0.0, t) > 0.0 && sign_ * acceleration(x_, x_[5], t) < 0.0;
      mode_ = sticks ? ContactMode::stick : ContactMode::gap;
    } else if (mode_ == ContactMode::gap) {
      sign_ = d > upper_ ? 1.0 : -1.0;
      mode_ = ContactMode::engaged;
    } else {
      mode_ = sign_ * acceleration(x_, 0.0, t) > 0.0 ? ContactMode::engaged : ContactMode::gap;
    }
    ++entered_[static_cast<std::size_t>(mode_)];
  }

  OrderSetting setting_;
  bool exact_;
  PlayBacklash<double> law_;
  State7 x_ = State7::Zero();
  ContactMode mode_ = ContactMode::engaged;
  double sign_ = 0.0, lower_ = 0.0, upper_ = 0.0;
  double previous_ = 0.0, command_ = 0.0;
  int index_ = 0;
  std::array<int, 3> entered_{};
};

/// Largest difference of two motions over some samples, as a share of the larger state.
template <class First, class Second>
double largest_difference(First& first, Second& second, int samples) {
  double apart = 0.0, size = 0.0;
  for (int j = 0; j < samples; ++j) {
    first.sense();
    second.sense();
    first.advance();
    second.advance();
    const Vector<double, 4> here = first.state().template head<4>();
    apart = std::max(apart, (here - second.state().template head<4>()).norm());
    size = std::max(size, here.norm());
  }
  return apart / size;
}

// The two masses have closed forms of their own, by subscripts and by energy; the general route
// goes by ports, projections and a Lyapunov equation.
TEST(PlantOrder, OfFourThroughPortsIsTheTwoMasses) {
  OrderSetting setting;
  setting.sampling = {0.001, 0.0004};
  for (const ContactLaw law : {ContactLaw::play, ContactLaw::kollar, ContactLaw::dead_zone}) {
    for (const Switching switching : {Switching::sampled, Switching::exact}) {
      auto masses =
          event_motion(loop_of(setting, setting.plant, law, switching), Vector<double, 4>::Zero());
      auto general = event_motion(loop_of(setting, linear_plant(setting.plant), law, switching),
                                  Vector<double, 4>::Zero());
      EXPECT_LE(largest_difference(masses, general, 2000), 1e-12)
          << static_cast<int>(law) << ", " << static_cast<int>(switching);
      EXPECT_EQ(masses.counts().entered, general.counts().entered);
    }
  }
}

TEST(PlantOrder, OfSevenIsThatOfADenseSimulation) {
  const OrderSetting setting;
  for (const Switching switching : {Switching::sampled, Switching::exact}) {
    auto motion = event_motion(
        loop_of(setting, order_seven(setting.plant, setting.extras), ContactLaw::play, switching),
        State7::Zero());
    DenseReference reference(setting, switching);
    double apart = 0.0, size = 0.0;
    for (int j = 0; j < 300; ++j) {
      motion.sense();
      reference.take_sample();
      motion.advance();
      reference.advance();
      apart = std::max(apart, (motion.state() - reference.state()).head<5>().norm());
      size = std::max(size, motion.state().head<5>().norm());
    }
    std::cout << "apart by " << apart / size << ", changes of contact "
              << motion.counts().entered[0] << ", " << motion.counts().entered[1] << ", "
              << motion.counts().entered[2] << "\n";
    EXPECT_LE(apart / size, 1e-9);
    if (switching == Switching::exact) {
      for (std::size_t mode = 0; mode < 3; ++mode) {
        EXPECT_GT(motion.counts().entered[mode], 5) << mode;
        EXPECT_EQ(motion.counts().entered[mode], reference.entered()[mode]) << mode;
      }
    }
  }
}

TEST(PlantOrder, KnownAtRunTimeAloneIsTheSame) {
  const OrderSetting setting;
  const Order7 fixed = order_seven(setting.plant, setting.extras);
  for (const ContactLaw law : {ContactLaw::play, ContactLaw::dead_zone}) {
    for (const Switching switching : {Switching::sampled, Switching::exact}) {
      auto first = event_motion(loop_of(setting, fixed, law, switching), State7::Zero());
      auto second = event_motion(loop_of(setting, test::of_dynamic_order(fixed), law, switching),
                                 Vector<double, Eigen::Dynamic>(State7::Zero()));
      EXPECT_LE(largest_difference(first, second, 500), 1e-12);
    }
  }
}

// The tangent over some samples, changes of contact included, against central differences of
// motions that begin a little apart; δg is none while the drive is engaged at both ends.
TEST(PlantOrder, OfSevenHasTheDerivativeOfItsMotion) {
  const OrderSetting setting;
  const Order7 plant = order_seven(setting.plant, setting.extras);
  const auto loop = loop_of(setting, plant, ContactLaw::play, Switching::exact);
  auto motion = event_motion(loop, State7::Zero());
  int compared = 0;
  for (int j = 0; j < 400; ++j) {
    const auto before = motion;
    constexpr int samples = 10;
    VariationalFlow<DriveContact<Order7>> tangent(motion);
    Matrix<double, 10> map = Matrix<double, 10>::Identity();
    auto ahead = motion;
    const auto counted = ahead.counts().entered;
    for (int k = 0; k < samples; ++k) {
      ahead.sense();
      tangent.begin_sample(ahead);
      ahead.advance(tangent);
      map = tangent.map() * map;
    }
    const bool engaged = before.contact().word() == ContactMode::engaged &&
                         ahead.contact().word() == ContactMode::engaged;
    motion.sense();
    motion.advance();
    // At rest, where it begins, the drive has no direction yet, and no derivative.
    if (j < 20 || !engaged || ahead.counts().entered == counted) continue;
    const auto end_from = [&](double step, int k) {
      auto other = before;
      State7 state = before.state();
      state[k] += step;
      other.restore(before.index(), state, before.previous_command(), before.contact());
      test::move_samples(other, samples);
      return other.state();
    };
    for (const int k : {0, 1, 2, 3, 4, 5, 6}) {
      const double step = 1e-7 * (k < 5 ? 0.1 : 1.0);
      const State7 found = (end_from(step, k) - end_from(-step, k)) / (2.0 * step);
      const State7 expected = map.col(k).head<7>();
      EXPECT_LE((found - expected).norm(), 1e-3 * expected.norm() + 1e-4) << j << ", " << k;
    }
    ++compared;
  }
  EXPECT_GT(compared, 20);
}

// ‖e^{At} x‖ ≤ ‖x‖, and ℓᵀx ≤ dual(ℓ) ‖x‖ with equality for some x.
TEST(DecayingNorm, NeverGrowsAlongAStablePlant) {
  test::Random random(1711);
  for (int draw = 0; draw < 200; ++draw) {
    const TwoMass<double> masses = test::random_plant(random);
    if (!(masses.conductor_damping > 0.0 && masses.absorber_damping > 0.0)) continue;
    const Extras extras{random.log_uniform(1.0, 1e3), random.log_uniform(1.0, 1e3), 0.5};
    const Matrix<double, 7> a = order_seven(masses, extras).released_matrix;
    const DecayingNorm<7> norm(a);
    ASSERT_TRUE(norm.exists()) << draw;
    const State7 x = random.matrix<State7>(), functional = random.matrix<State7>();
    EXPECT_LE(std::abs(functional.dot(x)), norm.dual(functional) * norm(x) * (1.0 + 1e-12));
    const double length = random.log_uniform(1e-3, 10.0) / balanced_norm(a);
    const auto step = zero_order_hold<double, 7, 1>(a, State7::Zero(), length);
    EXPECT_LE(norm(State7(step.transition * x)), norm(x) * (1.0 + 1e-9)) << draw;
  }
}

TEST(DecayingNorm, ThereIsNoneOfAnUnstablePlant) {
  TwoMass<double> masses = kollar2022_plant();
  masses.conductor_damping = -20.0;
  const DecayingNorm<4> norm(masses.state_matrix());
  EXPECT_FALSE(norm.exists());
  EXPECT_TRUE(std::isinf(norm(Vector<double, 4>::Zero())));
}

}  // namespace
}  // namespace holdfast
