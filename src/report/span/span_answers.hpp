#pragma once

#include <vector>

#include "process/job_context.hpp"
#include "report/page/answers.hpp"

namespace holdfast::program {

/// What a line or stay engineer asks: what vibrates without devices, what with them, how long the
/// conductor lives, which frequency is worst, what the devices take, how its modes are damped,
/// whether the absorber's loop is stable. A question that the case does not let be answered says
/// what to give. Throws Interrupted.
std::vector<Answer> span_answers(const JobContext& context);

}  // namespace holdfast::program
