#include "report/page/motions.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "case/case_keys.hpp"
#include "case/model/loop_of_case.hpp"
#include "holdfast/chaos/motion_classification.hpp"
#include "holdfast/phase_space/attractor_set.hpp"
#include "io/text/text.hpp"
#include "jobs/orbit/certified_orbit.hpp"
#include "report/figures/figure.hpp"
#include "report/page/html.hpp"

namespace holdfast::program {
namespace {

constexpr const char* no_value = "–";

/// A motion with all that is known of it.
struct KnownMotion {
  IdealLoop<double> loop;
  Vector<double, 4> initial_state;
  SampledClassification found;

  const PeriodicOrbit* orbit() const {
    return found.search.outcome == OrbitOutcome::certified ? &*found.search.orbit : nullptr;
  }
};

KnownMotion known_motion(const Case& the_case) {
  const IdealLoop<double> loop = ideal_loop_of(the_case);
  const Vector<double, 4> start = initial_state_of(the_case);
  return {loop, start, classify_motion(loop, start)};
}

std::string counted(std::int64_t count, const std::string& what) {
  return std::to_string(count) + " " + what + (count == 1 ? "" : "s");
}

std::string period_text(const KnownMotion& motion) {
  const std::int64_t samples = motion.found.classification.period;
  if (samples == 0) return no_value;
  const double tau = motion.loop.sampling.period;
  std::string text =
      rounded(static_cast<double>(samples) * tau, 6) + " s; " + counted(samples, "sample");
  const PeriodicOrbit* orbit = motion.orbit();
  if (orbit != nullptr && orbit->forcing_periods() > 0)
    text += "; " + counted(orbit->forcing_periods(), "forcing period");
  return text;
}

std::string border_text(const Borders& borders) {
  const auto distance = [](const Border& border, const char* unit) {
    return border.sample < 0 ? std::string("none") : rounded(1e3 * border.distance, 2) + unit;
  };
  return distance(borders.displacement, " mm") + "; " + distance(borders.velocity, " mm/s");
}

std::string capture_text(const OrbitCertificate& certificate) {
  if (!(certificate.largest_radius > 0.0)) return "none found";
  if (std::isinf(certificate.smallest_radius)) return "everywhere";
  const std::string from = rounded(1e3 * certificate.smallest_radius, 2);
  const std::string to = rounded(1e3 * certificate.largest_radius, 2);
  return (from == to ? from : from + " … " + to) + " mm";
}

std::string precision_text(const OrbitVerification& verification) {
  if (!verification.same_itinerary) return "other contacts";
  return "same contacts; " + rounded(verification.displacement_difference, 2) + " m";
}

/// Steps of one common period by which an orbit is ahead of its own first sample at some state:
/// where it comes nearest.
std::size_t nearest_stroboscopic_instant(const PeriodicOrbit& orbit,
                                         const Vector<double, 4>& state) {
  const auto step = static_cast<std::size_t>(orbit.ratio.denominator);
  std::size_t nearest = 0;
  double smallest = std::numeric_limits<double>::infinity();
  for (std::size_t j = 0; j < orbit.states.size(); j += step) {
    const double distance = (orbit.states[j].head<4>() - state).cwiseAbs().maxCoeff();
    if (distance < smallest) nearest = j / step;
    smallest = std::min(smallest, distance);
  }
  return nearest;
}

/// How a motion ends beside another one of the same loop.
std::string meeting_text(const KnownMotion& reference, const KnownMotion& other) {
  const PeriodicOrbit *first = reference.orbit(), *second = other.orbit();
  if (first == nullptr || second == nullptr) return "no two orbits to compare";
  if (!is_phase_shifted_copy(*first, *second)) return "different orbits";
  const std::int64_t period = first->period_samples();
  // Long enough for either motion to be far nearer to its own phase than to the next one.
  const std::int64_t settled = std::max(reference.found.search.samples, other.found.search.samples);
  const std::int64_t samples = (settled / period + 8) * period;
  const auto phase = [&](const KnownMotion& motion) {
    auto moving = periodically_forced_motion(motion.loop, first->ratio, motion.initial_state);
    for (std::int64_t j = 0; j < samples; ++j) {
      moving.sense();
      moving.advance();
    }
    return nearest_stroboscopic_instant(*first, moving.state());
  };
  const auto copies = first->states.size() / static_cast<std::size_t>(first->ratio.denominator);
  const std::size_t later = (phase(reference) + copies - phase(other)) % copies;
  if (later == 0) return "meet: the same orbit in the same phase";
  return "stay apart: copies " + counted(static_cast<std::int64_t>(later), "coincidence") +
         " later, of " + std::to_string(copies);
}

/// @param settings  of the command that shows all that is known of the motion
MotionRow row_of(const std::string& place, const std::string& text, const KnownMotion& motion,
                 const std::string& settings) {
  const Classification& classification = motion.found.classification;
  const PeriodicOrbit* orbit = motion.orbit();
  MotionRow row{place, text, attractor_type_text(classification), period_text(motion)};
  row.rests_on = classification.rests_on;
  row.arguments = words_of((orbit != nullptr ? "orbit --certificate " : "verdict ") + settings);
  if (orbit == nullptr) return row;
  row.multiplier = rounded(orbit->largest_multiplier(), 3);
  row.border = border_text(orbit->borders);
  const OrbitCertificate certificate = certificate_of(motion.loop, *orbit);
  row.capture = capture_text(certificate);
  row.precision = precision_text(certificate.verification);
  return row;
}

/// A start that is compared with rest.
struct Neighbour {
  std::string place;
  std::string displacement;  // initial.z1, m
  std::string text;
};

/// Motions of one loop: from rest, and perhaps from neighbours of it.
struct PaperMotion {
  std::string place;
  std::string sampling_period;  // s
  std::string backlash_width;   // m
  std::vector<Neighbour> neighbours;
};

std::vector<PaperMotion> published_motions() {
  const std::string near = "1e-5", near_text = "z₁ = 10⁻⁵ m";
  return {{"Figs. 6, 7a, 8, 9a", "0.001", "0.0005", {}},
          {"Fig. 7b", "0.01", "0.002", {}},
          {"Figs. 9b, 10a, 11a, 13a, Table 2",
           "0.001",
           "0.002",
           {{"Fig. 11a, the neighbour", near, near_text},
            {"as Fig. 11a, farther apart", "1e-3", "z₁ = 1 mm"}}},
          {"Figs. 9c, 10b, 11b, 12, 13b, Table 2",
           "0.011",
           "0.002",
           {{"Fig. 11b, the neighbour", near, near_text}}},
          {"beyond the paper", "0.011", "0.001", {{"its neighbour", near, near_text}}},
          {"beyond the paper", "0.003", "0.002", {{"its neighbour", near, near_text}}}};
}

void add_rows(std::vector<MotionRow>& rows, Case the_case, const PaperMotion& motion) {
  std::string settings;
  const auto set = [&](const std::string& key, const std::string& value) {
    set_case_value(the_case, key, *parse_number(value));
    settings += " --set " + key + "=" + value;
  };
  set("control.sampling_period", motion.sampling_period);
  set("backlash.width", motion.backlash_width);
  const std::string loop = loop_text(the_case) + ", from ", of_loop = settings;
  const KnownMotion from_rest = known_motion(the_case);
  rows.push_back(row_of(motion.place, loop + "rest", from_rest, settings));
  for (const Neighbour& neighbour : motion.neighbours) {
    settings = of_loop;
    set("initial.z1", neighbour.displacement);
    const KnownMotion other = known_motion(the_case);
    rows.push_back(row_of(neighbour.place, loop + neighbour.text, other, settings));
    rows.back().neighbour = meeting_text(from_rest, other);
  }
}

}  // namespace

std::string loop_text(const Case& the_case) {
  return "τ = " + rounded(1e3 * the_case.control.sampling_period, 4) +
         " ms, r₀ = " + rounded(1e3 * the_case.backlash.width, 4) + " mm";
}

std::vector<MotionRow> paper_motions(const Case& the_case) {
  std::vector<MotionRow> rows;
  for (const PaperMotion& motion : published_motions()) add_rows(rows, the_case, motion);
  return rows;
}

MotionRow motion_of_the_case(const Case& the_case) {
  const std::string text = loop_text(the_case) + ", from its initial state";
  return row_of("this case", text, known_motion(the_case), "");
}

}  // namespace holdfast::program
