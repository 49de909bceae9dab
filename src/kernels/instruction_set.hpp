#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace holdfast::program {

/// Instruction sets for which the SIMD kernels are compiled. Each includes the set before it.
enum class InstructionSet {
  baseline,  ///< default of the compiler: SSE2 on x86-64
  avx2,      ///< x86-64-v3: four lanes of double
  avx512,    ///< x86-64-v4: eight lanes of double
};

/// Name of an instruction set: "baseline", "avx2" or "avx512".
std::string_view name_of(InstructionSet set);

/// The instruction set of a name. Throws WrongInput for an unknown name.
InstructionSet instruction_set_named(std::string_view name);

/// Instruction sets of both program and processor, narrowest first; always with the baseline.
std::vector<InstructionSet> available_instruction_sets();

/// The widest available instruction set.
InstructionSet best_instruction_set();

/// Names of the available instruction sets: "baseline, avx2".
std::string available_instruction_names();

/// The instruction set of a name, or the best one if the name is empty. Throws WrongInput if the
/// name is unknown, or this program or this processor lacks the set.
InstructionSet chosen_instruction_set(std::string_view name);

}  // namespace holdfast::program
