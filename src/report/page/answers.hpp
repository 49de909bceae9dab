#pragma once

#include <string>
#include <vector>

#include "case/job_context.hpp"
#include "text/text.hpp"

namespace holdfast::program {

/// A question of whoever designs or judges a damper, and what holdfast says.
struct Answer {
  std::string question;
  std::string answer;                  ///< in a few words
  std::string detail;                  ///< what was computed, and how far it reaches
  std::vector<std::string> arguments;  ///< of the command that shows it, without the case's
};

/// The question of the name in texts/page.toml, with what is said of it whatever the answer.
Answer asked(const std::string& name, const Values& values = {});

/// What is doubtful of the case, where something is; does control help, which D, how slow a
/// computer, how much play, what motion, does it hold on the conductor itself: for the case as it
/// is, switching at samples; of a span without an absorber span_answers(). A question that the case
/// does not let be answered says why. Throws Interrupted.
std::vector<Answer> answers_of(const JobContext& context);

/// Whether what two masses say of a case holds on its conductor as a hanging cable: whether its
/// gains are stable there, what of the absorber would have to move with the clamp if they are not,
/// and how much vibration is left. It is not asked where the conductor is not the plant's.
Answer does_it_hold_on_the_cable(const Case& the_case);

/// What a line or stay engineer asks: what vibrates without devices, what with them, how long the
/// conductor lives, which frequency is worst, what the devices take, how its modes are damped,
/// whether the absorber's loop is stable. A question that the case does not let be answered says
/// what to give. Throws Interrupted.
std::vector<Answer> span_answers(const JobContext& context);

}  // namespace holdfast::program
