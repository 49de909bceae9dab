#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace holdfast::program {

/// The instruction sets that the kernels on packs are compiled for, each with what the one before
/// has.
enum class InstructionSet {
  baseline,  ///< what the compiler takes by itself: SSE2 on x86-64
  avx2,      ///< x86-64-v3: packs of four
  avx512,    ///< x86-64-v4: packs of eight
};

/// "baseline", "avx2", "avx512".
std::string_view name_of(InstructionSet set);

/// The instruction set of that name. Throws WrongInput for a name that is none.
InstructionSet instruction_set_named(std::string_view name);

/// Sets of this program that this processor has, narrowest first; the baseline is one of them.
std::vector<InstructionSet> available_instruction_sets();

/// The widest of them.
InstructionSet best_instruction_set();

/// "baseline, avx2".
std::string available_instruction_names();

/// The one of the name, or the best one where that is empty. Throws WrongInput where the name is
/// none, and where this program or this processor has not got it.
InstructionSet chosen_instruction_set(std::string_view name);

}  // namespace holdfast::program
