#pragma once

#include "cli/running_program.hpp"
#include "support/random.hpp"

namespace holdfast::tests {

using test::Random;

template <class List>
auto one_of(Random& random, const List& list) {
  return *(std::begin(list) + static_cast<std::ptrdiff_t>(random.index(std::size(list))));
}

/// Whether something of that probability happens.
inline bool happens(Random& random, double probability) { return random.unit() < probability; }

/// What stands where a number should: at the ends of a double's range and beyond, in other
/// notations, or none at all.
inline std::string hostile_number(Random& random) {
  static const std::vector<std::string> known = between_bars(
      "nan|-nan|inf|-inf|1e308|-1e308|1e309|-1e309|5e-324|-5e-324|2.2e-308|1e-300|-0.0|0|-1|"
      "1e9|-1e9|1000000000|-1000000000|999999999999999999999|9223372036854775807|"
      "-9223372036854775808|1e15|9007199254740993|1e-9|0x10|0b1|0o7|1_000|1,5|0,5|1.|.5|+1|++1|"
      "--1|1e|1e+|1e5000|1e-5000|1 2|1;2|1:2|| |\t1|1\n2|true|[]|[1|{}|{a=1}|\"1\"|'x'|\"x|"
      "\"\"\"|1979-05-27|tuned|none|exact|1 # x|\xD9\xA3|\xEF\xBB\xBF"
      "1|\xFF\xFE|1\xC0\x80|"
      "NaN|Infinity|1e308e308|0.1f|1e1.5|(1)|$(echo 1)|%n%s|../../etc/passwd");
  if (happens(random, 0.35)) return one_of(random, known);
  if (happens(random, 0.3)) return std::to_string(random.uniform(-2.0, 2.0));
  const double reach = happens(random, 0.5) ? 1e12 : 1e300;
  const double size = random.sign() * random.log_uniform(1.0 / reach, reach);
  std::vector<char> digits(64);
  const int length = std::snprintf(digits.data(), digits.size(), "%.3g", size);
  return {digits.data(), static_cast<std::size_t>(length)};
}

/// Any bytes but zero, which would end an argument.
inline std::string noise(Random& random, std::size_t length) {
  std::string bytes;
  for (std::size_t k = 0; k < length; ++k) bytes += static_cast<char>(1 + random.index(255));
  return bytes;
}

/// A word of a command line that nobody meant.
inline std::string hostile_word(Random& random) {
  static const std::vector<std::string> known = between_bars(
      "|-|--|---|-h=1|--help=|--version|-q|--se|--=|-=|=|:|::|:::|a:b:c|0:1|0:1:2:3|"
      "nan:nan:nan|1:0:5|0:1:1e9|0:1:-1|0:1:1000000000|0:1:0|0:inf:3|1e308:1e308:3|"
      "-1e308:1e308:1000000000|log:0:1:3|case.toml|missing.toml|.|..|/|/dev/null|/dev/zero|"
      "a b.toml|new\nline.toml|\xFF\xFE|caf\xC3\xA9|\x1b[31m|%s%n|$HOME|`ls`|*|{}|[|[control]|"
      "control|control.|.control|initial.z1=|=1|a=b=c|[a,b]");
  if (happens(random, 0.5)) return one_of(random, known);
  if (happens(random, 0.5)) return hostile_number(random);
  if (happens(random, 0.1)) return std::string(100000, one_of(random, std::string("a-[=:,\"9 ")));
  return noise(random, 1 + random.index(20));
}

/// MIN:MAX:COUNT, with hostile numbers in some of the places and sometimes of other length.
inline std::string hostile_axis(Random& random) {
  static const std::vector<std::string> counts =
      between_bars("2|3|1|0|-1|1e3|1000000000|1000000001|99999999999999999999|2.5||+2| 2 ");
  if (happens(random, 0.1)) return hostile_word(random);
  const auto end = [&] {
    return happens(random, 0.2) ? hostile_number(random)
                                : std::to_string(random.uniform(0.001, 0.01));
  };
  std::string text = happens(random, 0.1) ? "log:" : "";
  text += end() + ":" + end();
  if (happens(random, 0.9)) text += ":" + (happens(random, 0.6) ? "3" : one_of(random, counts));
  if (happens(random, 0.1)) text += one_of(random, std::vector<std::string>{":", ":1", ",", ",1"});
  return text;
}

/// The text with one of the mistakes that editors, disks and people make.
inline std::string damaged(Random& random, std::string text) {
  const std::size_t place = random.index(text.size() + 1);
  const std::size_t length = std::min(random.index(40), text.size() - place);
  switch (random.index(12)) {
    case 0:
      return text.erase(place, length);
    case 1:
      return text.insert(place, text.substr(place, length));
    case 2:
      return text.insert(place, noise(random, 1 + random.index(8)));
    case 3:
      return text.insert(place, hostile_number(random));
    case 4:
      return text.substr(0, place);
    case 5:
      return text.insert(place, std::string(1 + random.index(3), '\0'));
    case 6:
      return text.insert(
          place, std::string(1 + random.index(200000), one_of(random, std::string("[{\"=#a1\n "))));
    case 7:
      return text.replace(place, length, hostile_number(random));
    case 8:
      return "\xEF\xBB\xBF" + text;
    case 9:
      return text + text;
    case 10: {
      std::replace(text.begin(), text.end(), '.', ',');
      return text;
    }
    default: {
      std::replace(text.begin(), text.end(), '\n', '\r');
      return text;
    }
  }
}

}  // namespace holdfast::tests
