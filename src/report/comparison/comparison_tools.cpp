#include "report/comparison/comparison_tools.hpp"

#include <cstdio>

namespace holdfast::program {

std::string rounded(double value, int digits) {
  char text[40];
  std::snprintf(text, sizeof text, "%.*g", digits, value);
  std::string result;
  for (const char* character = text; *character != '\0'; ++character) {
    result += *character == '-' ? std::string("−") : std::string(1, *character);
  }
  if (std::isinf(value)) result = value > 0 ? "∞" : "−∞";
  return result;
}

Comparison number(const std::string& quantity, const std::string& paper_text, double paper,
                  double tolerance, double ours, const std::string& unit,
                  const std::string& reading, const std::string& why) {
  const bool agrees = std::abs(ours - paper) <= tolerance;
  return {quantity, paper_text, rounded(ours, 4) + (unit.empty() ? "" : " ") + unit,
          reading,  agrees,     agrees ? "" : why};
}

Comparison statement(const std::string& quantity, const std::string& paper_text,
                     const std::string& ours, bool holds, const std::string& reading,
                     const std::string& why) {
  return {quantity, paper_text, ours, reading, holds, holds ? "" : why};
}

}  // namespace holdfast::program
