#pragma once

#include <vector>

#include "case/case.hpp"
#include "holdfast/motion/implemented_loop.hpp"
#include "kernels/instruction_set.hpp"
#include "report/page/motions.hpp"

namespace holdfast::program {

/// Largest |z₁| of the steady motion with control and without it, and what the drive does for it.
struct LoopVibration {
  double controlled, free;
  double engaged;  ///< share of the samples at which the drive transmits
  double force;    ///< N, the largest that the computer asks for

  double ratio() const { return controlled / free; }
  bool is_reduced() const { return controlled < free; }
};

/// What all answers about a case rest on.
struct Question {
  const Case& the_case;
  InstructionSet set;
  MotionRow motion;  ///< what its motion is
  double free;  ///< largest |z₁| (m) of the steady motion without control, under the true force
  double radius_without_play;  ///< spectral radius of the loop without play

  bool is_unstable_without_play() const { return !(radius_without_play < 1.0); }
};

/// Throws InvalidParameter where the case's loop is not admissible.
Question question_about(const Case& the_case, InstructionSet set);

/// Seconds of a motion: 20, or as long as the case's force lasts.
double duration_of(const Case& the_case);

/// The vibration of each case, each the question's but for the value of a key.
std::vector<LoopVibration> vibrations_of(const std::vector<Case>& cases, const Question& question,
                                         Switching switching = Switching::sampled);

}  // namespace holdfast::program
