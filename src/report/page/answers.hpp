#pragma once

#include <functional>
#include <string>
#include <vector>

#include "case/case.hpp"
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

/// Answers on the case as it is, switching at samples: what is doubtful of it, where something is;
/// does control help, which D, how slow a computer, how much play, what motion, does it hold on the
/// conductor itself; of a span without an absorber span_answers(). A question that the case does
/// not let be answered says why. Each is handed over once it is known. Throws Interrupted.
void answer(const JobContext& context, const std::function<void(const Answer&)>& take);

/// Whether what two masses say of a case holds on its conductor as a hanging cable: whether its
/// gains are stable there, what of the absorber would have to move with the clamp if they are not,
/// and how much vibration is left. It is not asked where the conductor is not the plant's.
Answer does_it_hold_on_the_cable(const Case& the_case);

/// Answers for a line or stay engineer: what vibrates without devices, what with them, how long the
/// conductor lives, which frequency is worst, what the devices take, how its modes are damped,
/// whether the absorber's loop is stable. A question that the case does not let be answered says
/// what to give. Throws Interrupted.
void span_answers(const JobContext& context, const std::function<void(const Answer&)>& take);

/// One motion in the words of the page; a number that there is not is "–".
struct MotionRow {
  std::string place;             ///< of the motion in the paper, or whose it is
  std::string motion;            ///< sampling period, backlash and start
  std::string verdict;           ///< attractor_type_text()
  std::string period;            ///< s, samples, forcing periods
  std::string multiplier = "–";  ///< largest modulus, of one period
  std::string border = "–";      ///< nearest change of contact (mm; mm/s)
  std::string capture = "–";    ///< radius of the neighbourhoods from which motions tend to it (mm)
  std::string precision = "–";  ///< how the same orbit comes out in extended precision
  std::string rests_on = {};    ///< what the verdict rests on
  std::string neighbour = {};   ///< how it ends beside the motion from rest; "": not compared
  std::vector<std::string> arguments = {};  ///< of the command that shows it, without the case's
  bool diverges = false;                    ///< it leaves every bound
  bool stays_in_play = false;               ///< its certified orbit never leaves the play
};

/// "τ = 1 ms, r₀ = 0.5 mm".
std::string loop_text(const Case& the_case);

/// The motions of Kollár's Figs. 6–13 with their neighbours, and some beyond them.
/// @param the_case  the built-in one
std::vector<MotionRow> paper_motions(const Case& the_case);

/// The motion of a case from its own initial state.
MotionRow motion_of_the_case(const Case& the_case);

}  // namespace holdfast::program
