#include "jobs/family/family_design.hpp"

#include "case/case_keys.hpp"
#include "case/model/loop_of_case.hpp"
#include "case/model/plant_of_case.hpp"
#include "holdfast/math/linalg/spectral_radius.hpp"
#include "program/case/case_text.hpp"
#include "program/jobs/answer_in_memory.hpp"
#include "support/random.hpp"

namespace holdfast::program {
namespace {

using tests::answer_of, tests::AnswerInMemory;
using Words = std::vector<std::string>;

/// A two-mass loop at many angles, by resolvents and eigenvalues.
class DenseLoop {
 public:
  using Phasors = Vector<std::complex<double>, 4>;

  DenseLoop(const Case& of, double from, double to) : map_(loop_of(of)) {
    const TwoMass<double> plant = plant_of(of);
    const Matrix<std::complex<double>, 4> states =
        plant.state_matrix().cast<std::complex<double>>();
    const double period = map_.sampling.period;
    for (int k = 0; k <= 3000; ++k) {
      const double angle = std::exp(std::log(1e-3) + k * std::log(pi<double> / 1e-3) / 3000);
      commands_.push_back(phasors(std::polar(1.0, angle), map_.present_force));
    }
    for (int k = 0; k <= 40; ++k) {
      const double omega = 2.0 * pi<double> * (from + (to - from) * k / 40);
      const std::complex<double> turn = std::polar(1.0, omega * period);
      const Matrix<std::complex<double>, 4> still =
          std::complex<double>(0.0, omega) * Matrix<std::complex<double>, 4>::Identity() - states;
      const Phasors input = plant.excitation_input().cast<std::complex<double>>();
      at_.push_back({phasors(turn, map_.present_force), phasors(turn, map_.held_excitation),
                     std::abs(Phasors(still.fullPivLu().solve(input))[0])});
    }
  }

  double modulus(const PdGains<double>& gains) const {
    double least = 1e300;
    for (const Phasors& g : commands_) least = std::min(least, std::norm(1.0 - command(gains, g)));
    return std::sqrt(least);
  }
  double radius(const PdGains<double>& gains) const {
    return spectral_radius<double, 5>(map_.engaged_map(gains));
  }
  double ratio(const PdGains<double>& gains) const {
    double largest = 0.0;
    for (const auto& [command_there, force, still] : at_) {
      const std::complex<double> u = command(gains, force) / (1.0 - command(gains, command_there));
      largest = std::max(largest, std::abs(force[0] + command_there[0] * u) / still);
    }
    return largest;
  }

 private:
  struct Frequency {
    Phasors command, force;
    double still;  // amplitude without control under the true force
  };

  static std::complex<double> command(const PdGains<double>& gains, const Phasors& of) {
    return gains.proportional * of[0] + gains.differential * of[1];
  }
  Phasors phasors(std::complex<double> turn, const Vector<double, 4>& input) const {
    const Matrix<std::complex<double>, 4> system =
        turn * Matrix<std::complex<double>, 4>::Identity() -
        map_.transition.cast<std::complex<double>>();
    return system.fullPivLu().solve(input.cast<std::complex<double>>());
  }

  SampledLoop<double> map_;
  std::vector<Phasors> commands_;
  std::vector<Frequency> at_;
};

/// Of random families of two masses, against brute force on ever finer grids of P and D.
TEST(FamilyDesign, IsAsGoodAsAFineSearch) {
  test::Random random(20261130);
  for (int trial = 0; trial < 3; ++trial) {
    const double margin = trial == 1 ? 0.5 : 0.3, from = random.uniform(7.0, 10.0),
                 to = from + random.uniform(0.5, 2.0);
    Words family;
    for (const char* key : {"absorber_mass", "conductor_stiffness"})
      family.push_back("uncertain.plant." + std::string(key) + "=± " +
                       format_number(std::round(random.uniform(5.0, 30.0))) + " %");
    AnswerInMemory answer = answer_of({"design", "--family", "--both-gains", "--draws=5", "--prove",
                                       "--margin=" + format_number(margin),
                                       "--band=" + format_number(from) + ":" + format_number(to)},
                                      "", family);
    const double ratio = answer.numbers("worst_ratio")[0];
    const PdGains<double> ours{answer.numbers("proportional_gain")[0],
                               answer.numbers("differential_gain")[0]};
    EXPECT_EQ(answer.word("stability", 0), "stable");
    std::vector<DenseLoop> loops;
    const Case the_case = load_case(std::nullopt, family);
    for (const FamilyMember& member : family_members(the_case, 5)) {
      Case own = the_case;
      for (const auto& [key, value] : member.values) own = case_with(own, key, value);
      loops.emplace_back(own, from, to);
      EXPECT_GE(loops.back().modulus(ours), margin - 1e-6) << trial;
      EXPECT_LE(loops.back().ratio(ours), ratio * (1.0 + 1e-9)) << trial;
    }
    double best = 1e300, width = 1500.0, height = 20.0;
    PdGains<double> at{-400.0, -5.0};
    for (int zoom = 0; zoom < 6; ++zoom, width /= 5.0, height /= 5.0) {
      const PdGains<double> middle = at;
      for (int i = -20; i <= 20; ++i)
        for (int j = -20; j <= 20; ++j) {
          const PdGains<double> gains{middle.proportional + width * i / 20,
                                      middle.differential + height * j / 20};
          double worst = 0.0;
          for (const DenseLoop& loop : loops)
            worst = worst > best || loop.modulus(gains) < margin || loop.radius(gains) >= 1.0
                        ? 1e300
                        : std::max(worst, loop.ratio(gains));
          if (worst < best) std::tie(best, at) = std::pair(worst, gains);
        }
    }
    EXPECT_LT(ratio, 1.005 * best) << trial;
  }
}

/// A family that no pair of gains serves, and two pieces of it that one pair each does.
TEST(FamilyDesign, MakesAsManyPiecesAsItNeeds) {
  const Words question = {"design",       "--family",    "--both-gains",       "--draws=9",
                          "--margin=0.3", "--band=9:11", "--largest-ratio=0.7"};
  const Words family = {"uncertain.plant.absorber_stiffness=[60, 90]"};
  EXPECT_THROW(answer_of(question, "", family), NoAnswer);
  Words with_schedule = question;
  with_schedule.insert(with_schedule.end(), {"--schedule=plant.absorber_stiffness", "--prove"});
  AnswerInMemory pieces = answer_of(with_schedule, "", family);
  ASSERT_EQ(pieces.numbers("worst_ratio").size(), 2U);
  EXPECT_EQ(pieces.numbers("schedule_from")[0], 60.0);
  EXPECT_EQ(pieces.numbers("schedule_from")[1], pieces.numbers("schedule_to")[0]);
  EXPECT_EQ(pieces.numbers("schedule_to")[1], 90.0);
  for (std::size_t row = 0; row < 2; ++row) {
    EXPECT_LE(pieces.numbers("worst_ratio")[row], 0.7);
    EXPECT_EQ(pieces.word("stability", row), "stable");
  }
}

TEST(FamilyDesign, RefusesWhatIsNoQuestion) {
  const Words family = {"uncertain.plant.absorber_stiffness=± 5 %"};
  const auto ask = [&](Words options, const Words& settings) {
    options.insert(options.begin(), "design");
    answer_of(options, "", settings);
  };
  EXPECT_THROW(ask({"--family"}, {}), WrongInput);
  EXPECT_THROW(ask({"--family", "--schedule=plant.absorber_mass"}, family), WrongInput);
  EXPECT_THROW(ask({"--family", "--frequency=9:11:3"}, family), WrongInput);
  EXPECT_THROW(ask({"--family"}, {"uncertain.control.differential_gain=± 5 %"}), WrongInput);
  for (const char* of_family : {"--schedule=plant.absorber_mass", "--prove", "--largest-ratio=0.5"})
    EXPECT_THROW(ask({of_family}, family), WrongInput);
  EXPECT_THROW(ask({"--both-gains", "--band=9:11"}, family), WrongInput);
  EXPECT_THROW(ask({"--family", "--band=9:2000"}, family), std::exception);
}

}  // namespace
}  // namespace holdfast::program
