#pragma once

#include "support/random.hpp"

namespace holdfast::test {

/// One number that a random case is made of.
struct Parameter {
  std::string name;                    ///< with its unit
  std::variant<double*, int*> number;  ///< in the case
  double simple = 0.0;                 ///< where a failing case shrinks to, if it still fails there

  double value() const {
    return std::visit([](auto* place) { return static_cast<double>(*place); }, number);
  }
  /// A whole number takes the next one towards zero.
  void set(double value) const {
    std::visit(
        [value](auto* place) { *place = static_cast<std::decay_t<decltype(*place)>>(value); },
        number);
  }
};

/// What a property says of one case.
struct PropertyOutcome {
  enum class Kind { holds, fails, does_not_apply };
  Kind kind;
  std::string what;  ///< of a failure: what was found and what was expected
};

inline PropertyOutcome holds() { return {PropertyOutcome::Kind::holds, ""}; }
inline PropertyOutcome fails(std::string what) {
  return {PropertyOutcome::Kind::fails, std::move(what)};
}
/// The case says nothing about the property, for instance because rounding decides it.
inline PropertyOutcome does_not_apply() { return {PropertyOutcome::Kind::does_not_apply, ""}; }

/// HOLDFAST_PROPERTY_DRAWS, or without it the number that keeps an ordinary test run short.
inline std::int64_t property_draws(std::int64_t ordinarily) {
  const char* wanted = std::getenv("HOLDFAST_PROPERTY_DRAWS");
  return wanted == nullptr ? ordinarily : std::strtoll(wanted, nullptr, 10);
}

/// A case that breaks a property, as drawn and shrunk.
template <class Case>
struct Counterexample {
  std::int64_t draw;
  Case drawn;
  Case shrunk;
  std::string what;  ///< is wrong with the shrunk case
  int shrink_steps;
};

/// How many cases a property was tried on.
struct PropertyTally {
  std::int64_t held = 0;
  std::int64_t did_not_apply = 0;
};

namespace detail {

/// Each draw has its own numbers, so that it can be drawn again without those before it.
inline Random random_of_draw(std::uint64_t seed, std::int64_t draw) {
  std::uint64_t state = seed + static_cast<std::uint64_t>(draw + 1) * 0x9e3779b97f4a7c15U;
  state = (state ^ (state >> 30U)) * 0xbf58476d1ce4e5b9U;
  state = (state ^ (state >> 27U)) * 0x94d049bb133111ebU;
  return Random(state ^ (state >> 31U));
}

/// The value to so many significant digits.
inline double rounded_to(double value, int digits) {
  std::ostringstream text;
  text.precision(digits);
  text << value;
  return std::strtod(text.str().c_str(), nullptr);
}

/// Halfway to the simple value: in ratio, to one of the same sign where that is zero, since a case
/// that is wrong in all sizes would shrink to the smallest numbers there are.
inline double halved_towards(double simple, double value) {
  const double size = simple == 0.0 ? 1.0 : std::abs(simple);
  return std::copysign(size * std::sqrt(std::abs(value) / size), value);
}

/// What to try for a number, the simplest first.
inline std::vector<double> simpler_values(const Parameter& parameter) {
  const double value = parameter.value(), simple = parameter.simple;
  if (value == simple) return {};
  if (std::holds_alternative<int*>(parameter.number)) {
    const double way = value - simple;
    return {simple, simple + std::trunc(0.5 * way), way > 0.0 ? value - 1.0 : simple};
  }
  std::vector<double> result{simple, std::copysign(1.0, value), halved_towards(simple, value)};
  for (const int digits : {1, 2, 3}) result.push_back(rounded_to(value, digits));
  return result;
}

/// The outcome; an exception is a failure.
template <class Check, class Case>
PropertyOutcome outcome_of(const Check& check, const Case& drawn) {
  try {
    return check(drawn);
  } catch (const std::exception& error) {
    return fails(std::string("threw: ") + error.what());
  }
}

/// Makes a failing case simpler while it keeps failing.
template <class Case, class Check>
class Shrinker {
 public:
  Shrinker(const Check& check, Case failing, std::string what)
      : check_(check),
        best_(std::move(failing)),
        what_(std::move(what)),
        threw_(what_.rfind("threw: ", 0) == 0) {}

  void run() {
    for (bool moved = true; moved && checks_ < most_checks_;) {
      moved = false;
      for (std::size_t p = 0; p < best_.parameters().size(); ++p) moved = shrink(p) || moved;
    }
  }

  const Case& best() const { return best_; }
  const std::string& what() const { return what_; }
  int steps() const { return steps_; }

 private:
  static constexpr int most_checks_ = 5000;

  bool shrink(std::size_t which) {
    const Parameter parameter = best_.parameters()[which];
    const double before = parameter.value();
    for (const double value : simpler_values(parameter)) {
      Case simpler = best_;
      const Parameter changed = simpler.parameters()[which];
      changed.set(value);
      if (changed.value() == before) continue;
      ++checks_;
      const PropertyOutcome outcome = outcome_of(check_, simpler);
      if (outcome.kind != PropertyOutcome::Kind::fails) continue;
      // A case that the library refuses is not a simpler form of one that it gets wrong.
      if (!threw_ && outcome.what.rfind("threw: ", 0) == 0) continue;
      best_ = std::move(simpler);
      what_ = outcome.what;
      ++steps_;
      return true;
    }
    return false;
  }

  const Check& check_;
  Case best_;
  std::string what_;
  bool threw_;
  int checks_ = 0, steps_ = 0;
};

}  // namespace detail

/// The numbers of a case, each so that it can be read back to the last bit.
template <class Case>
std::string written_out(Case drawn) {
  std::ostringstream text;
  text.precision(17);
  for (const Parameter& parameter : drawn.parameters())
    text << "  " << parameter.name << " = " << parameter.value() << "\n";
  return text.str();
}

/// Tries a property on random cases until one breaks it.
/// @param generate  test::Random& → Case; a Case has `parameters()`, the list of its numbers
/// @param check     const Case& → PropertyOutcome
template <class Generate, class Check>
auto find_counterexample(std::uint64_t seed, std::int64_t draws, const Generate& generate,
                         const Check& check, PropertyTally& tally) {
  using Case = std::decay_t<decltype(generate(std::declval<Random&>()))>;
  for (std::int64_t draw = 0; draw < draws; ++draw) {
    Random random = detail::random_of_draw(seed, draw);
    const Case drawn = generate(random);
    const PropertyOutcome outcome = detail::outcome_of(check, drawn);
    if (outcome.kind == PropertyOutcome::Kind::fails) {
      detail::Shrinker<Case, Check> shrinker(check, drawn, outcome.what);
      shrinker.run();
      return std::optional(
          Counterexample<Case>{draw, drawn, shrinker.best(), shrinker.what(), shrinker.steps()});
    }
    ++(outcome.kind == PropertyOutcome::Kind::holds ? tally.held : tally.did_not_apply);
  }
  return std::optional<Counterexample<Case>>();
}

/// A property of all cases: the test fails with the simplest case found that breaks it.
/// @return how many cases it was tried on, so that the test can ask for enough
template <class Generate, class Check>
PropertyTally for_all(std::uint64_t seed, std::int64_t draws, const Generate& generate,
                      const Check& check) {
  PropertyTally tally;
  const auto found = find_counterexample(seed, draws, generate, check, tally);
  if (found) {
    ADD_FAILURE() << "seed " << seed << ", draw " << found->draw << ": " << found->what
                  << "\nshrunk in " << found->shrink_steps << " steps to\n"
                  << written_out(found->shrunk) << "drawn as\n"
                  << written_out(found->drawn);
  }
  return tally;
}

}  // namespace holdfast::test
