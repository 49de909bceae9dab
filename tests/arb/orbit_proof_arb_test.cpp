#include "arb/arb_loop.hpp"
#include "holdfast/orbit/orbit_search.hpp"
#include "holdfast/orbit/proof/orbit_proof.hpp"
#include "support/property.hpp"

namespace holdfast {
namespace {

using test::Ball;
using test::BallMatrix;
using test::BallVector;

/// A loop and its decimals as they are written.
struct WrittenLoop {
  test::DecimalLoop plant;
  std::string proportional, differential, amplitude, frequency, width;

  IdealLoop<double> in_doubles() const {
    std::array<double, 6> m{};
    for (std::size_t k = 0; k < 6; ++k) m.at(k) = std::stod(plant.masses.at(k));
    return {{m[0], m[1], m[2], m[3], m[4], m[5]},
            {std::stod(plant.period), std::stod(plant.delay)},
            {std::stod(proportional), std::stod(differential)},
            {std::stod(amplitude), std::stod(frequency)},
            std::stod(width)};
  }
};

WrittenLoop of_the_paper(const std::string& period, const std::string& width,
                         const std::string& delay = "0") {
  return {{{"0.0767", "50.3", "0.079", "0.16", "74.4", "4.0"}, period, delay},
          "-557",
          "-13",
          "0.5",
          "10",
          width};
}

/// The motion that repeats an itinerary for ever, by 200 bits from the decimals.
class ArbOrbit {
 public:
  ArbOrbit(const WrittenLoop& loop, const PeriodicOrbit& orbit)
      : maps_{loop.plant.gap_map(),
              loop.plant.map(Ball(loop.proportional), Ball(loop.differential))},
        force_(loop.plant.held_force()),
        amplitude_(loop.amplitude) {
    BallMatrix product(5);
    for (slong i = 0; i < 5; ++i) product.set(i, i, Ball(1.0));
    BallVector g(5);
    const std::size_t samples = orbit.states.size();
    for (std::size_t j = 0; j < samples; ++j) {
      const BallMatrix next = maps_.at(orbit.itinerary[j]) * product;
      for (slong i = 0; i < 25; ++i) product.set(i / 5, i % 5, next.at(i / 5, i % 5));
      g = step(g, orbit.itinerary[j], j, orbit.ratio);
    }
    BallVector state(5);
    solved_ = product.solve_fixed_point(g, state);
    for (std::size_t j = 0; j < samples && solved_; ++j) {
      states_.push_back(state);
      state = step(state, orbit.itinerary[j], j, orbit.ratio);
    }
  }

  bool solved() const { return solved_; }
  const std::vector<BallVector>& states() const { return states_; }

 private:
  BallVector step(const BallVector& state, std::uint8_t engaged, std::size_t j,
                  const Rational& ratio) const {
    BallVector next = maps_.at(engaged) * state;
    const auto turn = static_cast<slong>(j) * static_cast<slong>(ratio.numerator);
    const Ball force =
        amplitude_ * Ball::cosine_of_turn(turn, static_cast<slong>(ratio.denominator));
    for (std::size_t i = 0; i < 4; ++i) next[i] = next[i] + force_[i] * force;
    return next;
  }

  std::array<BallMatrix, 2> maps_;
  BallVector force_;
  Ball amplitude_;
  std::vector<BallVector> states_;
  bool solved_ = false;
};

/// What the backlash decides over one period in Arb, from the memory of the drive at the start of
/// the second turn; empty where one decision is not certain.
Itinerary decided_by_arb(const ArbOrbit& orbit, const WrittenLoop& loop, bool inside,
                         double previous_velocity, double lower) {
  const Ball width(loop.width);
  Ball low(lower), high = low + width;
  int previous = previous_velocity < 0.0 ? -1 : 1;
  Itinerary contacts;
  for (int turn = 0; turn < 2; ++turn) {
    contacts.clear();
    for (const BallVector& state : orbit.states()) {
      const Ball gap = state[2] - state[0], speed = state[3] - state[1];
      const int sign = speed.is_positive() ? 1 : speed.is_negative() ? -1 : 0;
      if (inside) {
        const Ball above = gap - low, below = high - gap;
        const bool stays = above.is_positive() && below.is_positive();
        if (!stays && !above.is_negative() && !below.is_negative() && turn > 0) return {};
        inside = stays;
      } else if (sign != previous) {
        if (sign == 0) return {};
        inside = true;
        low = previous > 0 ? gap - width : gap;
        high = low + width;
      }
      if (!inside && sign == 0) return {};
      previous = sign;
      contacts.push_back(inside ? 0 : 1);
    }
  }
  return contacts;
}

/// @return whether there was a proof to agree with
bool expect_agreement(const WrittenLoop& written, const PeriodicOrbit& orbit) {
  const OrbitProof proof = prove_orbit(written.in_doubles(), orbit);
  if (proof.outcome != OrbitProofOutcome::proved) return false;
  test::arb_bits = 200 + 3 * static_cast<slong>(orbit.states.size());
  const ArbOrbit arb(written, orbit);
  EXPECT_TRUE(arb.solved());
  for (std::size_t j = 0; j < orbit.states.size(); ++j) {
    for (const std::size_t i : {std::size_t{0}, std::size_t{2}}) {
      const auto at = [&](std::size_t k) {
        return arb.states()[j][k] - Ball(orbit.states[j][static_cast<Eigen::Index>(k)]);
      };
      EXPECT_TRUE(at(i).is_within(proof.displacement_error)) << j;
      EXPECT_TRUE(at(i + 1).is_within(proof.velocity_error)) << j;
    }
  }
  EXPECT_EQ(decided_by_arb(arb, written, orbit.memory.inside, orbit.memory.previous_velocity,
                           orbit.memory.lower),
            orbit.itinerary);
  test::arb_bits = 200;
  return true;
}

PeriodicOrbit found_orbit(const WrittenLoop& loop, double displacement = 0.0) {
  const OrbitResult found = find_periodic_orbit(
      loop.in_doubles(), Vector<double, 4>(displacement, 0.0, 0.0, 0.0), {20000, 0});
  EXPECT_EQ(found.outcome, OrbitOutcome::certified);
  return found.orbit.value();
}

/// The motions of the paper's loop are where Arb finds them and switch as it says.
TEST(OrbitProof, ArbFindsTheSameMotions) {
  for (const auto& [period, width, delay] : {std::array<std::string, 3>{"0.001", "0.0005", "0"},
                                             {"0.001", "0.002", "0"},
                                             {"0.01", "0.002", "0"},
                                             {"0.011", "0.002", "0"},
                                             {"0.011", "0.001", "0"},
                                             {"0.003", "0.002", "0"},
                                             {"0.01", "0.002", "0.005"}}) {
    const WrittenLoop loop = of_the_paper(period, width, delay);
    const PeriodicOrbit orbit = found_orbit(loop);
    EXPECT_EQ(prove_orbit(loop.in_doubles(), orbit).outcome, OrbitProofOutcome::proved);
    expect_agreement(loop, orbit);
  }
  const WrittenLoop coexisting = of_the_paper("0.003", "0.002");
  expect_agreement(coexisting, found_orbit(coexisting, 1e-5));
}

/// The same of loops whose gains and widths are any decimals.
TEST(OrbitProof, ArbRefutesNoneOfRandomMotions) {
  test::Random random(61);
  const std::int64_t wanted = test::property_draws(40);
  std::int64_t asked = 0, proved = 0;
  while (asked < wanted) {
    WrittenLoop loop = of_the_paper("0.01", "0.002");
    loop.plant.period =
        "0.0" + std::to_string(1 + random.index(3)) + std::to_string(random.index(10));
    loop.width = "0.000" + std::to_string(1 + random.index(4000));
    loop.proportional = "-" + std::to_string(random.index(900)) + ".3";
    loop.differential = "-" + std::to_string(random.index(20)) + ".7";
    const OrbitResult found =
        find_periodic_orbit(loop.in_doubles(), Vector<double, 4>::Zero(), {2000, 200'000});
    if (found.outcome != OrbitOutcome::certified) continue;
    ++asked;
    proved += expect_agreement(loop, *found.orbit) ? 1 : 0;
  }
  EXPECT_GE(proved, wanted - 1 - wanted / 100);
}

}  // namespace
}  // namespace holdfast
