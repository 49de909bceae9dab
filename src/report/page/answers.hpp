#pragma once

#include <functional>
#include <string>
#include <vector>

#include "case/case.hpp"
#include "case/job_context.hpp"
#include "text/text.hpp"

namespace holdfast::program {

/// Question of a designer, and the answer of holdfast.
struct Answer {
  std::string question;
  std::string answer;                  ///< short answer
  std::string detail;                  ///< method of computation, and its limits
  std::vector<std::string> arguments;  ///< command line, without the options of the case
};

/// Answer object for a question of texts/page.toml: question, detail and command, no answer yet.
Answer asked(const std::string& name, const Values& values = {});

/// Answers questions about a case, with contact changes only at samples: doubtful values, if any;
/// benefit of control, best D, slowest computer, largest play, kind of motion, validity on the
/// conductor itself. A span without an absorber gets span_answers(). A question that cannot be
/// answered gives the reason. `take` gets each answer once it is known. Throws Interrupted.
void answer(const JobContext& context, const std::function<void(const Answer&)>& take);

/// Answer whether results for two masses are valid on the conductor as a hanging cable: stability
/// of the gains there, the clamp mass that would make them stable, and the vibration left. Not
/// computed where the plant is not the conductor's.
Answer does_it_hold_on_the_cable(const Case& the_case);

/// Answers for a line or stay engineer: vibration without and with devices, life of the conductor,
/// worst frequency, absorption by the devices, damping of the modes, stability of the absorber's
/// loop. A question that cannot be answered names the missing data. Throws Interrupted.
void span_answers(const JobContext& context, const std::function<void(const Answer&)>& take);

/// Row of the page about one motion; "–" stands for a number that does not exist.
struct MotionRow {
  std::string place;                        ///< figure of the paper, or "this case"
  std::string motion;                       ///< sampling period, backlash and start
  std::string verdict;                      ///< kind of motion, by attractor_type_text()
  std::string period;                       ///< period: seconds, samples, forcing periods
  std::string multiplier = "–";             ///< largest modulus of the multipliers
  std::string border = "–";                 ///< distance to nearest change of contact (mm; mm/s)
  std::string capture = "–";                ///< radius of attraction (mm)
  std::string rests_on = {};                ///< evidence for the verdict
  std::vector<std::string> arguments = {};  ///< command line, without the case's options
  bool diverges = false;                    ///< whether the motion grows without limit
  bool stays_in_play = false;               ///< whether the orbit never leaves the play
};

/// Text of sampling period and play: "τ = 1 ms, r₀ = 0.5 mm".
std::string loop_text(const Case& the_case);

/// Rows for the motions of Kollár's Figs. 6–13, for motions near these, and for some others.
/// @param the_case  the built-in case
std::vector<MotionRow> paper_motions(const Case& the_case);

/// The motion of a case from its own initial state.
MotionRow motion_of_the_case(const Case& the_case);

}  // namespace holdfast::program
