#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "holdfast/core/errors.hpp"

namespace holdfast {

/// The complexity of a sequence of contacts. A symbol is the contact at one sample, engaged or not;
/// a word is k successive symbols. H_k is the entropy of the words (block_entropy()).
struct SwitchingComplexity {
  double entropy;        ///< entropy rate h_k = H_{k+1} − H_k (bits per symbol), ≥ 0
  std::size_t block;     ///< word length k
  std::size_t switches;  ///< number of changes of contact
};

/// The Shannon entropy H_k (bits) of the words of k successive symbols in a sequence, from the
/// frequencies of the words. It is too low unless n is many times 2^k. Work: n + 2^k operations.
/// @param sequence  n symbols, true or false; all n − k + 1 overlapping words are counted
/// @param block     word length k, 0 … 20 and ≤ n; H₀ = 0
/// @throws InvalidParameter where k is out of its range
inline double block_entropy(const std::vector<bool>& sequence, std::size_t block) {
  const double longest = std::fmin(20.0, static_cast<double>(sequence.size()));
  require_within("block length", static_cast<double>(block), "", 0.0, longest);
  std::vector<std::int64_t> counts(std::size_t{1} << block, 0);
  std::size_t word = 0;
  for (std::size_t place = 0; place < sequence.size(); ++place) {
    word = ((word << 1U) | (sequence[place] ? 1U : 0U)) & (counts.size() - 1);
    if (place + 1 >= block) ++counts[word];
  }
  const double words = static_cast<double>(sequence.size() - block + (block > 0 ? 1 : 0));
  double entropy = 0.0;
  for (const std::int64_t count : counts) {
    const double share = static_cast<double>(count) / words;
    if (count > 0) entropy -= share * std::log2(share);
  }
  return std::fmax(0.0, entropy);
}

/// Computes the complexity of a sequence of contacts from its block entropies H_k and H_{k+1}.
///
/// The word length k is the largest with 2^{k+1} ≤ n/32 for n symbols, at most 12. Each of the
/// 2^{k+1} words then occurs ≥ 32 times on average. The entropy rate is 0 for a period N ≤ k, and
/// may be above 0 for a longer period. It is small if changes of contact are rare, because most
/// samples add no information. Compare only values for equal sampling periods.
/// @param sequence  64 … 10⁶ symbols: true if the drive is engaged at the sample, else false
/// @throws InvalidParameter where the number of symbols is out of its range
/// @tparam Sequence  std::vector<bool>
template <class Sequence = std::vector<bool>>
SwitchingComplexity switching_complexity(const Sequence& sequence) {
  const double count = static_cast<double>(sequence.size());
  require_within("number of symbols", count, "", 64.0, 1e6);
  SwitchingComplexity result{};
  while (result.block < 12 && std::exp2(static_cast<double>(result.block) + 2.0) * 32.0 <= count)
    ++result.block;
  // Both over the same places, so that the next symbol of each word is the only difference.
  const Sequence without_last(sequence.begin(), sequence.end() - 1);
  result.entropy = std::fmax(
      0.0, block_entropy(sequence, result.block + 1) - block_entropy(without_last, result.block));
  for (std::size_t place = 1; place < sequence.size(); ++place)
    result.switches += sequence[place] != sequence[place - 1] ? 1U : 0U;
  return result;
}

}  // namespace holdfast
