#include "holdfast/orbit/proof/event_passage.hpp"

#include "holdfast/motion/variational_flow.hpp"
#include "orbit/proof/proved_event_orbits.hpp"
#include "support/random.hpp"

namespace holdfast {
namespace {

using detail::FlowPlace;
using Modes = detail::EnclosedModes<Enclosure>;
using EventSet = detail::SetOfStates<Enclosure>;
using Passage = detail::EventPassage<Enclosure>;
using FlowColumn = Vector<Enclosure, FlowPlace::size>;

constexpr std::array<ContactMode, 3> all_modes{ContactMode::engaged, ContactMode::gap,
                                               ContactMode::stick};

Modes modes_of(const IdealLoop<double>& loop) {
  return {enclosed(loop), forcing_ratio(loop).value()};
}

FlowColumn random_column(test::Random& random) {
  FlowColumn column;
  for (Enclosure& entry : column) entry = Enclosure(random.uniform(-1.0, 1.0));
  return column;
}

bool meet_each_other(const FlowColumn& a, const FlowColumn& b) {
  for (Eigen::Index i = 0; i < FlowPlace::size; ++i)
    if (a[i].lower() > b[i].upper() || b[i].lower() > a[i].upper()) return false;
  return true;
}

/// By one series, by two, and by the exponential.
TEST(EnclosedModes, TheFlowIsTheExponentialOfItsRate) {
  test::Random random(72);
  for (const ForceHold hold : {ForceHold::sampled, ForceHold::exact}) {
    IdealLoop<double> loop = test::proved_loop(0.011, 0.002);
    loop.hold = hold;
    const Modes modes = modes_of(loop);
    for (const ContactMode mode : all_modes) {
      for (int trial = 0; trial < 20; ++trial) {
        const Enclosure length(modes.longest() * random.unit());
        const FlowColumn start = random_column(random);
        const FlowColumn once = modes.flowed<1>(mode, start, length);
        const FlowColumn first = modes.flowed<1>(mode, start, length * Enclosure(0.25));
        EXPECT_TRUE(
            meet_each_other(once, modes.flowed<1>(mode, first, length - length * Enclosure(0.25))));
        const Modes::Rate map = exponential(Modes::Rate(modes.rate(mode) * length));
        EXPECT_TRUE(meet_each_other(once, map * start));
        for (const Enclosure& entry : once) EXPECT_LT(entry.radius(), 1e-11);
        const Enclosure wide(length.lower() * 0.9, length.upper());
        const FlowColumn all = modes.flowed<1>(mode, start, wide);
        const FlowColumn between = modes.flowed<1>(mode, start, Enclosure(0.95 * length.middle()));
        for (Eigen::Index i = 0; i < FlowPlace::size; ++i) {
          EXPECT_LE(all[i].lower(), between[i].lower());
          EXPECT_GE(all[i].upper(), between[i].upper());
        }
      }
    }
  }
}

/// A set about a point in a gap, from which Δz runs towards an end.
EventSet set_towards_an_end(double radius, test::Random& random) {
  EventSet set;
  set.radius = radius;
  const std::array<double, FlowPlace::size> start{1e-4,    2e-4, 5e-4, 4e-3, 0.01, 0.02,
                                                  4.99e-4, 0.3,  0.1,  1.0,  0.0};
  for (std::size_t i = 0; i < start.size(); ++i)
    set.centre[static_cast<Eigen::Index>(i)] = Enclosure(start[i]);
  for (Eigen::Index i = 0; i < 4; ++i)
    for (Eigen::Index k = 0; k < 6; ++k) set.spread(i, k) = Enclosure(random.uniform(-1.0, 1.0));
  return set;
}

Vector<double, 6> on_sphere(test::Random& random) {
  Vector<double, 6> y;
  for (double& entry : y) entry = random.normal();
  return y.normalized();
}

/// One of its motions.
EventSet member_of(const EventSet& set, const Vector<double, 6>& y) {
  EventSet member = set;
  member.radius = 0.0;
  member.centre = set.centre + set.spread * (y * set.radius).cast<Enclosure>();
  return member;
}

TEST(GuardSeries, HoldsItsMotionsAndWhereTheyMeetTheGuard) {
  test::Random random(73);
  const Modes modes = modes_of(test::proved_loop(0.001, 0.0005));
  int met = 0;
  for (const double radius : {1e-9, 1e-7, 3e-6}) {
    const EventSet set = set_towards_an_end(radius, random);
    const auto& guard = modes.guards(ContactMode::gap, 1.0)[0];
    const detail::GuardSeries<Enclosure> all(guard, set, Modes::terms);
    const auto within = all.falls_through_zero(1e-3);
    ASSERT_TRUE(within.has_value()) << radius;
    EXPECT_TRUE(all.is_positive(within->lower(), 0));
    EXPECT_FALSE(all.is_positive(within->upper(), 0));
    for (int trial = 0; trial < 50; ++trial, ++met) {
      const EventSet member = member_of(set, on_sphere(random));
      const detail::GuardSeries<Enclosure> one(guard, member, Modes::terms);
      const auto instant = one.falls_through_zero(within->middle());
      ASSERT_TRUE(instant.has_value());
      EXPECT_GE(instant->lower(), within->lower());
      EXPECT_LE(instant->upper(), within->upper());
      const double s = within->upper() * random.unit();
      const FlowColumn there = modes.flowed<1>(ContactMode::gap, member.centre, Enclosure(s));
      const double value = guard.terms.front().dot(there).middle();
      EXPECT_LE(all.value(Enclosure(s)).lower(), value + 1e-18);
      EXPECT_GE(all.value(Enclosure(s)).upper(), value - 1e-18);
      const double slope =
          guard.terms.front().dot(modes.moved<1>(ContactMode::gap, there)).middle();
      EXPECT_LE(all.slope(Enclosure(s)).lower(), slope + 1e-15);
      EXPECT_GE(all.slope(Enclosure(s)).upper(), slope - 1e-15);
    }
  }
  EXPECT_EQ(met, 150);
}

/// A guard that dips below zero between two ends at which it is positive.
TEST(GuardSeries, SeesADipBetweenTheEnds) {
  const Modes modes = modes_of(test::proved_loop(0.001, 0.0005));
  const auto dips = [&](double least) {
    // Δz̈ > 0 turns Δz after 1 ms, at `least` above the lower end g.
    EventSet set;
    set.centre[2] = Enclosure(0.0);
    set.centre[FlowPlace::one] = Enclosure(1.0);
    set.centre[FlowPlace::force] = Enclosure(-0.8);  // pulls the conductor away: Δz̈ > 0
    const auto& guard = modes.guards(ContactMode::gap, -1.0)[1];
    set.centre[3] = Enclosure(-0.01 / modes.units()[1]);
    double lowest = 1.0;
    for (double s = 0.0; s < 2e-3; s += 2e-6)
      lowest = std::min(
          lowest,
          detail::GuardSeries<Enclosure>(guard, set, Modes::terms).value(Enclosure(s)).middle());
    set.centre[FlowPlace::gap] = Enclosure(lowest - least);
    const detail::GuardSeries<Enclosure> series(guard, set, Modes::terms);
    EXPECT_TRUE(series.value(Enclosure(0.0)).is_positive());
    EXPECT_TRUE(series.value(Enclosure(2e-3)).is_positive());
    return !series.is_positive(2e-3, 0);
  };
  EXPECT_FALSE(dips(1e-7));
  EXPECT_TRUE(dips(-1e-8));
  EXPECT_TRUE(dips(-1e-7));
}

/// The derivative of a sample by the tangent flow of doubles, in the units, of the deviations that
/// the contact has.
Matrix<double, 6> tangent_of_sample(const test::ProposedEventOrbit& proposed,
                                    RepeatingMotion<DriveContact<>>& motion, const Modes& modes,
                                    const Matrix<double, 6>& allowed) {
  VariationalFlow<DriveContact<>> tangent(motion.motion());
  motion.sense();
  tangent.begin_sample(motion.motion());
  motion.advance(tangent);
  Vector<double, 6> units;
  units << modes.units(), 1.0;
  Matrix<double, 6> map = units.cwiseInverse().asDiagonal() * tangent.map().topLeftCorner<6, 6>() *
                          units.asDiagonal() * allowed;
  if (!(proposed.loop.sampling.processing_delay > 0.0)) map.row(4).setZero();
  return map;
}

/// The saltation, in two ways.
TEST(EventPassage, TheDerivativeIsThatOfTheTangentFlow) {
  for (const test::ProposedEventOrbit& proposed : test::event_orbits_to_prove()) {
    const Modes modes = modes_of(proposed.loop);
    const auto path = proposed.recorded(proposed.first);
    auto motion = proposed.motion();
    motion.go_to(proposed.first);
    Passage passage(modes, path, proposed.loop.sampling.processing_delay);
    for (std::size_t j = 0; j < path.samples.size(); ++j) {
      EventSet set = passage.ball(j, Matrix<double, 6>::Identity(), 0.0);
      const Matrix<double, 6> allowed = Passage::deviations(set).cast<double>();
      const Matrix<double, 6> expected = tangent_of_sample(proposed, motion, modes, allowed);
      ASSERT_TRUE(passage.pass(j, set)) << j;
      const Matrix<double, 6> found = Passage::deviations(set).cast<double>();
      EXPECT_LE((found - expected).cwiseAbs().maxCoeff(), 1e-8 * (1.0 + expected.norm()))
          << proposed.loop.sampling.period << ", sample " << j << '\n'
          << found << "\n\n"
          << expected;
    }
  }
}

/// All motions of a ball are in the set, a sample later.
TEST(EventPassage, TheSetHoldsItsMotions) {
  test::Random random(74);
  int tight = 0;
  for (const test::ProposedEventOrbit& proposed : test::event_orbits_to_prove()) {
    const Modes modes = modes_of(proposed.loop);
    const auto path = proposed.recorded(proposed.first);
    Vector<double, 6> units;
    units << modes.units(), 1.0;
    auto along = proposed.motion();
    along.go_to(proposed.first);
    for (std::size_t j = 0; j < path.samples.size(); ++j, along.sense(), along.advance()) {
      if (path.samples[j].switches.empty()) continue;
      const double radius = 1e-8;
      Passage passage(modes, path, proposed.loop.sampling.processing_delay);
      EventSet set = passage.ball(j, Matrix<double, 6>::Identity(), radius);
      const Matrix<double, 6> allowed = Passage::deviations(set).cast<double>();
      if (!passage.pass(j, set)) continue;
      for (int trial = 0; trial < 20; ++trial) {
        auto start = along.point();
        const Vector<double, 6> by = units.asDiagonal() * (allowed * on_sphere(random) * radius);
        start.state += by.head<4>();
        start.previous_command += by[4];
        start.contact.shift_gap(by[5]);
        auto motion = proposed.motion();
        motion.go_to(start);
        motion.sense();
        motion.advance();
        Vector<double, 4> row;
        for (double& entry : row) entry = random.normal();
        const double value = row.dot(motion.motion().state().cwiseQuotient(units.head<4>()));
        detail::FlowRow<Enclosure> functional = detail::FlowRow<Enclosure>::Zero();
        for (Eigen::Index i = 0; i < 4; ++i) functional[i] = Enclosure(row[i]);
        const Enclosure range = set.range(functional);
        EXPECT_LE(range.lower(), value + 1e-15) << j;
        EXPECT_GE(range.upper(), value - 1e-15) << j;
        tight += std::abs(value - range.middle()) > 0.5 * range.radius() ? 1 : 0;
      }
    }
  }
  EXPECT_GT(tight, 100) << "the set is not much larger than what it holds";
}

/// A path that the law does not have is followed nowhere.
TEST(EventPassage, RefusesWhatTheLawDoesNotHave) {
  const test::ProposedEventOrbit proposed =
      test::event_orbit_to_prove(test::proved_loop(0.01, 0.002));
  const Modes modes = modes_of(proposed.loop);
  const auto path = proposed.recorded(proposed.first);
  const auto passes = [&](const detail::RecordedContacts& other) {
    Passage passage(modes, other, 0.0);
    for (std::size_t j = 0; j < other.samples.size(); ++j) {
      EventSet set = passage.ball(j, Matrix<double, 6>::Identity(), 1e-13);
      if (!passage.pass(j, set)) return false;
    }
    return true;
  };
  ASSERT_TRUE(passes(path));
  for (std::size_t j = 0; j < path.samples.size(); ++j) {
    for (std::size_t k = 0; k < path.samples[j].switches.size(); ++k) {
      auto other = path;
      auto& change = other.samples[j].switches[k];
      change.begun.sign = -change.begun.sign;
      EXPECT_FALSE(passes(other)) << "another sign";
      change = path.samples[j].switches[k];
      change.begun.mode =
          change.begun.mode == ContactMode::gap ? ContactMode::stick : ContactMode::gap;
      EXPECT_FALSE(passes(other)) << "another contact";
      change = path.samples[j].switches[k];
      other.samples[j].switches.erase(other.samples[j].switches.begin() +
                                      static_cast<std::ptrdiff_t>(k));
      EXPECT_FALSE(passes(other)) << "one change less";
    }
  }
}

}  // namespace
}  // namespace holdfast
