#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "holdfast/core/errors.hpp"

namespace holdfast {

/// How rich an itinerary (engaged, in the backlash) is.
struct SwitchingComplexity {
  std::size_t phrases;  ///< c, the number of phrases of Lempel and Ziv (1976)
  double normalised;    ///< c log₂ n / n: tends to the entropy per symbol (bit), 1 for fair coins
  double entropy;       ///< h_k = H_{k+1} − H_k (bit per symbol)
  std::size_t block;    ///< k
  std::size_t switches;  ///< how often the contact changes
};

namespace detail {

/// Suffix automaton of a binary word: every subword with the place where it first ends.
class SubwordAutomaton {
 public:
  explicit SubwordAutomaton(const std::vector<bool>& word) {
    states_.reserve(2 * word.size() + 1);
    states_.push_back({{none, none}, none, 0, none});
    for (std::size_t place = 0; place < word.size(); ++place) append(word[place] ? 1 : 0, place);
  }

  static constexpr std::int32_t start = 0;
  /// The subword of `state` with one more symbol; it must be a subword too.
  std::int32_t extended(std::int32_t state, bool symbol) const {
    return states_[static_cast<std::size_t>(state)].next[symbol ? 1 : 0];
  }
  /// Index of the symbol at which the subwords of `state` end for the first time.
  std::size_t first_end(std::int32_t state) const {
    return static_cast<std::size_t>(states_[static_cast<std::size_t>(state)].first_end);
  }

 private:
  static constexpr std::int32_t none = -1;

  struct State {
    std::array<std::int32_t, 2> next;
    std::int32_t link;
    std::int32_t length;
    std::int32_t first_end;
  };

  State& at(std::int32_t state) { return states_[static_cast<std::size_t>(state)]; }
  std::int32_t add(const State& state) {
    states_.push_back(state);
    return static_cast<std::int32_t>(states_.size()) - 1;
  }

  void append(std::size_t symbol, std::size_t place) {
    const auto length = static_cast<std::int32_t>(place) + 1;
    const std::int32_t whole = add({{none, none}, start, length, length - 1});
    std::int32_t state = last_;
    last_ = whole;
    while (state != none && at(state).next[symbol] == none) {
      at(state).next[symbol] = whole;
      state = at(state).link;
    }
    if (state != none) at(whole).link = with_length_of(state, symbol);
  }

  /// The successor of `state`, split where its longest subword is longer than that of `state` with
  /// one more symbol.
  std::int32_t with_length_of(std::int32_t state, std::size_t symbol) {
    const std::int32_t successor = at(state).next[symbol];
    if (at(successor).length == at(state).length + 1) return successor;
    State copy = at(successor);
    copy.length = at(state).length + 1;
    const std::int32_t split = add(copy);
    at(successor).link = split;
    for (; state != none && at(state).next[symbol] == successor; state = at(state).link)
      at(state).next[symbol] = split;
    return split;
  }

  std::vector<State> states_;
  std::int32_t last_ = start;
};

}  // namespace detail

/// Number of phrases into which Lempel and Ziv (1976) cut a sequence: each is the shortest word
/// from where the last ended that does not occur, overlap allowed, before its own last symbol. A
/// last phrase that is no new word counts as well.
///
/// Work: linear, by the suffix automaton; 40 bytes a symbol, n ≤ 10⁶. Source: A. Lempel, J. Ziv,
/// IEEE Trans. Inf. Theory 22 (1976), 75–81.
/// @throws InvalidParameter for more than 10⁶ symbols
inline std::size_t lempel_ziv_phrases(const std::vector<bool>& sequence) {
  require_within("number of symbols", static_cast<double>(sequence.size()), "", 0.0, 1e6);
  const detail::SubwordAutomaton automaton(sequence);
  std::size_t phrases = 0;
  std::int32_t word = automaton.start;
  for (std::size_t place = 0; place < sequence.size(); ++place) {
    word = automaton.extended(word, sequence[place]);
    const bool is_new = automaton.first_end(word) == place;
    if (is_new || place + 1 == sequence.size()) ++phrases;
    if (is_new) word = automaton.start;
  }
  return phrases;
}

/// H_k, the entropy (bit) of the words of k symbols that a sequence holds, by their frequencies.
/// It is too low where the sequence has not many times 2^k symbols. Work: n + 2^k.
/// @param sequence  n symbols, read with overlap
/// @param block     k, 0 … 20 and ≤ n; H₀ = 0
/// @throws InvalidParameter for another k
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

/// Complexity of an itinerary.
///
/// k of the block entropies is the largest with 2^{k+1} ≤ n/32, at most 12, so that each possible
/// word is expected 32 times. A sequence of period N that is no longer than k has h_k = 0; h_k of a
/// longer one is above 0 and falls with k. Of contacts that seldom switch h is small because most
/// samples say nothing new; compare it only at the same sampling period.
/// @param sequence  64 … 10⁶ symbols
/// @throws InvalidParameter for another number of symbols
/// @tparam Sequence  std::vector<bool>; a template so that only who calls it compiles it
template <class Sequence = std::vector<bool>>
SwitchingComplexity switching_complexity(const Sequence& sequence) {
  const double count = static_cast<double>(sequence.size());
  require_within("number of symbols", count, "", 64.0, 1e6);
  SwitchingComplexity result{};
  result.phrases = lempel_ziv_phrases(sequence);
  result.normalised = static_cast<double>(result.phrases) * std::log2(count) / count;
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

#ifdef HOLDFAST_EXTERN_TEMPLATES
extern template SwitchingComplexity switching_complexity(const std::vector<bool>&);
#endif

}  // namespace holdfast
