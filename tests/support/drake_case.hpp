#pragma once

#include <string>

namespace holdfast::tests {

/// ACSR Drake, 300 m, at a fifth of its strength, as a case file has it.
inline const std::string drake_line = R"([conductor]
name = "Drake"
span = 300.0
tension = 28020.0
damping_ratio = 0.0002
)";

/// An absorber of 5 kg and 20 Hz, 1.5 m from the support, under a computer of 1 ms at rest.
inline const std::string drake_absorber = R"([absorber]
mass = 5.0
position = 1.5
[plant]
absorber_mass = 5.0
absorber_stiffness = 78956.8352
absorber_damping = 125.663706
[control]
proportional_gain = 0.0
differential_gain = 0.0
sampling_period = 0.001
)";

}  // namespace holdfast::tests
