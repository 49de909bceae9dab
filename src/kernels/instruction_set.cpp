#include "kernels/instruction_set.hpp"

#include <array>
#include <cstddef>

#include "process/errors.hpp"

namespace holdfast::program {
namespace {

constexpr std::array all_sets = {InstructionSet::baseline, InstructionSet::avx2,
                                 InstructionSet::avx512};

/// Whether the program has kernels for the instruction set.
bool is_compiled([[maybe_unused]] InstructionSet set) {
#ifdef HOLDFAST_HAS_AVX2
  if (set == InstructionSet::avx2) return true;
#endif
#ifdef HOLDFAST_HAS_AVX512
  if (set == InstructionSet::avx512) return true;
#endif
  return set == InstructionSet::baseline;
}

/// Whether the processor has the instruction set and the system saves its registers.
bool processor_has([[maybe_unused]] InstructionSet set) {
  if (set == InstructionSet::baseline) return true;
#if defined(__x86_64__)
  __builtin_cpu_init();
  const bool avx2 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") &&
                    __builtin_cpu_supports("bmi") && __builtin_cpu_supports("bmi2");
  if (set == InstructionSet::avx2) return avx2;
  return avx2 && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512cd") &&
         __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512dq") &&
         __builtin_cpu_supports("avx512vl");
#else
  return false;
#endif
}

template <class Sets>
std::string names_of(const Sets& sets) {
  std::string names;
  for (const InstructionSet set : sets)
    names += (names.empty() ? "" : ", ") + std::string(name_of(set));
  return names;
}

}  // namespace

std::string_view name_of(InstructionSet set) {
  constexpr std::array<std::string_view, 3> names = {"baseline", "avx2", "avx512"};
  return names[static_cast<std::size_t>(set)];
}

InstructionSet instruction_set_named(std::string_view name) {
  for (const InstructionSet set : all_sets)
    if (name_of(set) == name) return set;
  throw WrongInput("--instructions " + std::string(name) + ": expected one of " +
                   names_of(all_sets));
}

std::vector<InstructionSet> available_instruction_sets() {
  std::vector<InstructionSet> available;
  for (const InstructionSet set : all_sets)
    if (is_compiled(set) && processor_has(set)) available.push_back(set);
  return available;
}

InstructionSet best_instruction_set() { return available_instruction_sets().back(); }

std::string available_instruction_names() { return names_of(available_instruction_sets()); }

InstructionSet chosen_instruction_set(std::string_view name) {
  if (name.empty()) return best_instruction_set();
  const InstructionSet set = instruction_set_named(name);
  if (is_compiled(set) && processor_has(set)) return set;
  throw WrongInput("--instructions " + std::string(name) +
                   (is_compiled(set) ? ": not supported by this processor; available: "
                                     : ": not compiled into this program; available: ") +
                   available_instruction_names());
}

}  // namespace holdfast::program
