// Gains that `place` recommends, on random lines and stays, against the eigenvalues of the whole
// loop: every mode up to twice the sampling rate as two states of a dense matrix.

#include "case/model/plant_of_case.hpp"
#include "case/model/span/span_loop.hpp"
#include "jobs/span/placement/placed_device.hpp"
#include "program/case/case_text.hpp"
#include "support/dense_routes.hpp"
#include "support/property.hpp"

#ifdef HOLDFAST_HAS_CERES

namespace holdfast::program {
namespace {

/// A line or a stay with an absorber near its end and a slow computer.
struct DrawnSpan {
  double length, mass, tension, damping, place;  // m, kg/m, N, 1, m
  double heavy, stiffness, dashpot;              // kg, N/m, N s/m
  double period, delay;                          // s

  double fundamental() const { return std::sqrt(tension / mass) / (2.0 * length); }
  /// Modes up to twice the sampling rate.
  int modes() const { return static_cast<int>(2.0 / (period * fundamental())); }

  std::string text() const {
    std::ostringstream text;
    text.precision(17);
    text << "[conductor]\nmass_per_length = " << mass << "\nspan = " << length
         << "\ntension = " << tension << "\ndamping_ratio = " << damping
         << "\narea = " << mass / 5000.0 << "\nyoungs_modulus = 1e11\n[absorber]\nmass = " << heavy
         << "\nposition = " << place << "\n[plant]\nmodel = \"string\"\nabsorber_mass = " << heavy
         << "\nabsorber_stiffness = " << stiffness << "\nabsorber_damping = " << dashpot
         << "\n[control]\nproportional_gain = 0\ndifferential_gain = 0\nsampling_period = "
         << period << "\nprocessing_delay = " << delay << "\n[backlash]\nwidth = 0\n";
    return text.str();
  }
};

DrawnSpan drawn_span(test::Random& random) {
  const bool is_stay = random.sign() > 0.0;
  DrawnSpan span{};
  span.length = is_stay ? random.log_uniform(40.0, 200.0) : random.log_uniform(80.0, 300.0);
  span.mass = is_stay ? random.log_uniform(20.0, 80.0) : random.log_uniform(0.5, 2.5);
  const double speed = is_stay ? random.uniform(150.0, 300.0) : random.uniform(90.0, 150.0);
  span.tension = span.mass * speed * speed;
  span.damping = random.log_uniform(1e-4, 3e-3);
  span.place = span.length * random.log_uniform(0.005, 0.2);
  span.period = random.log_uniform(0.002, 0.02);
  span.delay = random.uniform(0.0, 1.0) * span.period;
  span.heavy = span.mass * random.log_uniform(0.5, 5.0);
  const double omega = 2.0 * pi<double> * random.log_uniform(2.0, 0.3 / span.period);
  span.stiffness = span.heavy * omega * omega;
  span.dashpot = 2.0 * span.heavy * omega * random.log_uniform(0.03, 0.5);
  return span;
}

/// e^{A h} and ∫ e^{As} ds b over h, by Taylor's series of a small part, squared.
std::pair<Eigen::MatrixXd, Eigen::VectorXd> stepped(const Eigen::MatrixXd& a,
                                                    const Eigen::VectorXd& b, double h) {
  const Eigen::Index n = a.rows();
  Eigen::MatrixXd whole = Eigen::MatrixXd::Zero(n + 1, n + 1);
  whole.topLeftCorner(n, n) = h * a;
  whole.topRightCorner(n, 1) = h * b;
  const int squarings =
      std::max(0, static_cast<int>(std::log2(whole.cwiseAbs().colwise().sum().maxCoeff())) + 3);
  whole /= std::exp2(squarings);
  Eigen::MatrixXd term = Eigen::MatrixXd::Identity(n + 1, n + 1), sum = term;
  for (int k = 1; k <= 14; ++k) {
    term = (term * whole / k).eval();
    sum += term;
  }
  for (int k = 0; k < squarings; ++k) sum = (sum * sum).eval();
  return {sum.topLeftCorner(n, n), sum.topRightCorner(n, 1)};
}

/// The largest modulus of the loop's roots.
double radius_of(const DrawnSpan& span, const PdGains<double>& gains) {
  const int count = span.modes();
  const Eigen::Index n = 2 * count + 2, z2 = n - 2, v2 = n - 1;
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(n, n);
  Eigen::VectorXd force = Eigen::VectorXd::Zero(n), here = Eigen::VectorXd::Zero(n),
                  speed = Eigen::VectorXd::Zero(n);
  const double modal = 0.5 * span.mass * span.length;
  for (int k = 0; k < count; ++k) {
    const double omega = 2.0 * pi<double> * (k + 1) * span.fundamental();
    const double shape = std::sin((k + 1) * pi<double> * span.place / span.length);
    here[2 * k] = speed[2 * k + 1] = shape;
    force[2 * k + 1] = shape / modal;
    a(2 * k, 2 * k + 1) = 1.0;
    a(2 * k + 1, 2 * k) = -omega * omega;
    a(2 * k + 1, 2 * k + 1) = -2.0 * span.damping * omega;
  }
  force[v2] = -1.0 / span.heavy;
  a(z2, v2) = 1.0;
  // Spring and dashpot press both with k (z2 − z1) + c (v2 − v1), as the drive does.
  Eigen::RowVectorXd pressed =
      -span.stiffness * here.transpose() - span.dashpot * speed.transpose();
  pressed[z2] += span.stiffness;
  pressed[v2] += span.dashpot;
  a += force * pressed;

  const auto [first, late] = stepped(a, force, span.delay);
  const auto [last, prompt] = stepped(a, force, span.period - span.delay);
  Eigen::MatrixXd loop = Eigen::MatrixXd::Zero(n + 1, n + 1);
  const Eigen::RowVectorXd law =
      gains.proportional * here.transpose() + gains.differential * speed.transpose();
  loop.topLeftCorner(n, n) = last * first + prompt * law;
  loop.topRightCorner(n, 1) = last * late;
  loop.bottomLeftCorner(1, n) = law;
  return test::moduli_of(loop)[0];
}

PlacementQuestion question_of(const DrawnSpan& span, test::Random& random) {
  PlacementQuestion question;
  question.goal = random.sign() > 0.0 ? PlacementGoal::ratio : PlacementGoal::modes;
  const double lowest = random.log_uniform(1.0, 0.1 / span.period);
  question.frequencies = {lowest, random.uniform(1.1, 3.0) * lowest, 5};
  question.first_mode = 1;
  question.last_mode = 1 + static_cast<int>(random.index(6));
  question.margin = random.uniform(0.05, 0.6);
  return question;
}

TEST(PlacedGains, AreStableByTheEigenvaluesOfAllModesToTwiceTheSamplingRate) {
  const std::int64_t wanted = test::property_draws(4);
  const int most_modes = wanted > 100 ? 250 : 60;
  int judged = 0, refused = 0;
  test::Random random(4711);
  while (judged + refused < wanted) {
    const DrawnSpan span = drawn_span(random);
    const PlacementQuestion question = question_of(span, random);
    if (span.modes() > most_modes || span.modes() < 8) continue;
    try {
      const PlacedDevice placed = placed_device(tests::from_text(span.text()), question);
      EXPECT_TRUE(is_stable_span(placed.the_case));
      EXPECT_LT(radius_of(span, gains_of(placed.the_case)), 1.0 + 1e-10)
          << span.text() << "P = " << gains_of(placed.the_case).proportional
          << ", D = " << gains_of(placed.the_case).differential;
      ++judged;
    } catch (const NoAnswer&) {
      ++refused;
    }
  }
  EXPECT_LE(refused, wanted / 2);
  if (wanted > 100) std::cout << judged << " judged, " << refused << " without an answer\n";
}

/// The other way: gains well beyond the boundary are called unstable by both.
TEST(PlacedGains, BeyondTheBoundaryAreStableByNeither) {
  test::Random random(815);
  int judged = 0;
  while (judged < 4) {
    const DrawnSpan span = drawn_span(random);
    if (span.modes() > 60 || span.modes() < 8) continue;
    const double impedance = std::sqrt(span.tension * span.mass);
    for (const double d : {-100.0 * impedance, 100.0 * impedance}) {
      Case the_case = tests::from_text(span.text());
      the_case.plant.absorber_mass = span.heavy;
      the_case.control.differential_gain = d;
      EXPECT_GT(radius_of(span, {0.0, d}), 1.0);
      EXPECT_FALSE(is_stable_span(the_case));
    }
    ++judged;
  }
}

}  // namespace
}  // namespace holdfast::program

#endif
