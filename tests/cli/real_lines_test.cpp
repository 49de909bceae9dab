// Twelve lines and stays (tests/cases): jobs that answer the same question agree on each, and each
// answer is that of a calculation by hand, from the string's own equation instead of its modes.

#include <complex>

#include "cli/program.hpp"
#include "holdfast/core/types.hpp"

namespace holdfast::tests {
namespace {

using Complex = std::complex<double>;

class RealLines : public testing::TestWithParam<const char*> {
 protected:
  std::string path() const {
    return std::string(HOLDFAST_SOURCE_DIR) + "/tests/cases/" + GetParam() + ".toml";
  }
  std::string of_case() const { return " --quiet --case '" + path() + "'"; }
};

INSTANTIATE_TEST_SUITE_P(, RealLines,
                         testing::Values("bluebird-450m", "cardinal-400m", "crossing-1200m",
                                         "drake-350m", "ehs-ground-wire-300m", "hawk-250m",
                                         "kollar-cable", "opgw-320m", "raven-60m", "stay-100m",
                                         "stay-150m", "stay-250m"),
                         [](const auto& one) {
                           std::string name = one.param;
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

double value_in(const program::CsvTable& the_case, const std::string& key) {
  return the_case.number(row_of(the_case, key, "key"), "value");
}

/// A pair of gains within or beyond a limit of D: chart, radius and margins say so.
void expect_stability(double p, double d, bool is_stable, const std::string& of) {
  const auto chart = cell_of("stability --radius", p, d, of);
  EXPECT_EQ(chart.number(0, "stable") == 1.0, is_stable) << d;
  EXPECT_EQ(chart.number(0, "spectral_radius") < 1.0, is_stable) << d;
  if (is_stable) return;
  const Outcome margins =
      run_holdfast("margins --set control.proportional_gain=" + program::format_number(p) +
                   " --set control.differential_gain=" + program::format_number(d) + of);
  EXPECT_EQ(margins.exit_code, 1) << d << margins.errors;
}

TEST_P(RealLines, JobsAgree) {
  const auto values = table_of("case" + of_case());
  const double p = value_in(values, "proportional_gain");
  const double own = value_in(values, "control.differential_gain");
  const auto intervals =
      table_of("boundary --stable-interval --p " + program::format_number(p) + of_case());
  ASSERT_GT(intervals.rows(), 0U);
  bool holds = false;
  for (std::size_t row = 0; row < intervals.rows(); ++row)
    holds = holds || (intervals.number(row, "lower") < own && own < intervals.number(row, "upper"));
  EXPECT_TRUE(holds);
  const auto margins = table_of("margins" + of_case());
  EXPECT_NEAR(margins.number(0, "position"), value_in(values, "stable_from"),
              1e-9 * std::abs(own) + 1e-9);
  EXPECT_NEAR(margins.number(1, "position"), value_in(values, "stable_to"),
              1e-9 * std::abs(own) + 1e-9);
  for (const std::size_t end : {0U, 1U}) {
    const double limit = margins.number(end, "position"), inward = end == 0 ? 0.01 : -0.01;
    expect_stability(p, limit + inward * std::abs(limit), true, of_case());
    expect_stability(p, limit - inward * std::abs(limit), false, of_case());
  }
  // The best D is as good by the job of all D as by the one that finds it.
  const auto best = table_of("design" + of_case());
  const double d = best.number(0, "least_amplitude_gain");
  EXPECT_NEAR(cell_of("response", p, d, of_case()).number(0, "ratio_to_uncontrolled"),
              best.number(0, "ratio_to_uncontrolled"), 1e-9);
  EXPECT_LE(best.number(0, "ratio_to_uncontrolled"),
            cell_of("response", p, own, of_case()).number(0, "ratio_to_uncontrolled") + 1e-9);
}

/// A string with an absorber by hand: waves run along it, none is summed from modes.
struct StringByHand {
  double mass, span, tension, bending, damping;    // kg/m, m, N, N m², ratio
  double place, absorber, spring, dashpot, clamp;  // m, kg, N/m, N s/m, kg
  double period, late;                             // s

  /// H = z/f, with waves T k² + EI k⁴ = m ω² (1 − 2iζ), which decay as the modes about ω.
  Complex receptance(double omega) const {
    if (omega < 0.0) return std::conj(receptance(-omega));
    const Complex inertia = mass * omega * omega * Complex(1.0, -2.0 * damping);
    if (!(bending > 0.0)) return waves(std::sqrt(inertia / tension)) / tension;
    const Complex root = std::sqrt(tension * tension + 4.0 * bending * inertia);
    const Complex k = std::sqrt(2.0 * inertia / (tension + root));
    const Complex edge = std::sqrt((tension + root) / (2.0 * bending));
    const Complex beside = (1.0 - std::exp(-2.0 * edge * place)) / (2.0 * edge);
    return (waves(k) - beside) / (bending * (k * k + edge * edge));
  }

  /// sin ka sin k(L − a)/(k sin kL) for Im k < 0
  Complex waves(const Complex& k) const {
    const auto echo = [&](double way) { return 1.0 - std::exp(Complex(0.0, -2.0) * k * way); };
    return echo(place) * echo(span - place) / (Complex(0.0, 2.0) * k * echo(span));
  }

  struct Answers {
    Complex to_force, to_drive;
  };
  /// z/F and z/u at s = iω.
  Answers at(double omega) const {
    const Complex s(0.0, omega), inertia = absorber * s * s, link = spring + dashpot * s;
    const Complex share = inertia / (inertia + link);
    const Complex to_force = 1.0 / (1.0 / receptance(omega) + clamp * s * s + share * link);
    return {to_force, share * to_force};
  }

  /// P G_z + D G_v at e^{iωτ}: the held force has the sidebands ω + 2πk/τ.
  Complex loop_gain(double p, double d, double omega) const {
    Complex sum(0.0);
    constexpr int sidebands = 2000;
    for (int k = -sidebands; k <= sidebands; ++k) {
      const double there = omega + 2.0 * pi<double> * k / period;
      const Complex s(0.0, there);
      sum += at(there).to_drive * (p + d * s) * std::exp(-s * late) / s;
    }
    return sum * (1.0 - std::exp(Complex(0.0, -omega * period))) / period;
  }
};

TEST_P(RealLines, AreAsByHand) {
  if (std::string(GetParam()) == "kollar-cable")
    GTEST_SKIP() << "its sag of a tenth of the span bends what a string tells";
  // By hand the line is a string without its other devices.
  std::string text = read_text(path());
  text.resize(std::min(text.size(), text.find("[[device]]")));
  const TextFile file(text);
  const std::string of =
      " --quiet --set plant.model=string --set conductor.damping=ratio" + file.as_case();
  const auto values = table_of("case" + of);
  const auto given = [&](const std::string& key) { return value_in(values, key); };
  StringByHand line{given("conductor.mass_per_length"), given("conductor.span"),
                    given("conductor.tension"),         given("conductor.bending_stiffness"),
                    given("conductor.damping_ratio"),   given("absorber.position"),
                    given("plant.absorber_mass"),       given("plant.absorber_stiffness"),
                    given("plant.absorber_damping"),    given("absorber.clamp_mass"),
                    given("control.sampling_period"),   given("control.processing_delay")};
  const double speed = std::sqrt(line.tension / line.mass);
  const double impedance = std::sqrt(line.tension * line.mass);
  const double omega = 2.0 * pi<double> * given("force_frequency");

  // The wind: vortices at St v/d push with ρv²/2 on the length that counts.
  EXPECT_NEAR(given("force_frequency"),
              given("wind.strouhal") * given("wind.speed") / given("wind.diameter"), 1e-9 * omega);
  EXPECT_NEAR(given("force_amplitude"),
              0.5 * given("wind.air_density") * std::pow(given("wind.speed"), 2) *
                  given("wind.diameter") * given("wind.effective_length") *
                  given("wind.lift_coefficient"),
              1e-9 * given("force_amplitude"));

  // Natural frequencies n c/2L, stiffened by bending.
  const auto modes = table_of("modal-damping" + of);
  for (const int n : {1, 7, 20})
    EXPECT_NEAR(
        modes.number(static_cast<std::size_t>(n) - 1, "frequency_Hz"),
        n * speed / (2.0 * line.span) *
            std::sqrt(1.0 + line.bending / line.tension * std::pow(n * pi<double> / line.span, 2)),
        1e-9 * n);

  // The amplitude without control, of the force as it is.
  EXPECT_NEAR(
      cell_of("response", 0.0, 0.0, "--set excitation.hold=exact" + of).number(0, "amplitude_m"),
      std::abs(line.at(omega).to_force) * given("force_amplitude"),
      3e-3 * std::abs(line.at(omega).to_force) * given("force_amplitude"));

  // At a limit of D the loop gain is 1 on the unit circle.
  const auto margins = table_of("margins" + of);
  const double p = given("proportional_gain");
  for (const std::size_t end : {0U, 1U}) {
    const double d = margins.number(end, "position");
    const double turn = 2.0 * pi<double> * margins.number(end, "frequency_Hz");
    // Modes far from ω are damped otherwise than waves of ω; most lines agree to a thousandth.
    EXPECT_LT(std::abs(line.loop_gain(p, d, turn) - 1.0), 0.03) << d;
  }

  // What the end returns of a wave: Z against the string and its support.
  const Complex s(0.0, omega), inertia = line.absorber * s * s;
  const Complex link = line.spring + line.dashpot * s;
  const Complex device = line.clamp * s + inertia * link / (inertia + link) / s;
  const Complex at_end =
      device / impedance - Complex(0.0, 1.0 / std::tan(omega / speed * line.place));
  const double returned = std::abs((1.0 - at_end) / (1.0 + at_end));
  const auto end = table_of("absorption --no-control --frequency " +
                            program::format_number(given("force_frequency")) + ":" +
                            program::format_number(given("force_frequency")) + ":1" + of);
  EXPECT_NEAR(end.number(0, "impedance_real_N_s_per_m"), device.real(), 1e-8 * std::abs(device));
  EXPECT_NEAR(end.number(0, "impedance_imaginary_N_s_per_m"), device.imag(),
              1e-8 * std::abs(device));
  EXPECT_NEAR(end.number(0, "inverse_standing_wave_ratio"), (1.0 - returned) / (1.0 + returned),
              1e-8);
}

}  // namespace
}  // namespace holdfast::tests
