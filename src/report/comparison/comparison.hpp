#pragma once

#include <string>
#include <vector>

namespace holdfast::program {

/// One number or statement of the paper beside what is computed here.
struct Comparison {
  std::string quantity;  ///< what it is, with its place in the paper
  std::string paper;     ///< as the paper prints it
  std::string ours;      ///< as computed
  std::string reading;   ///< with which reading of the paper it was computed
  bool agrees = false;   ///< within what the paper's print allows
  std::string why;       ///< where it does not agree: why
};

/// Every comparable number of Kollár 2022, Figs. 2–13 and Tables 1 and 2, computed now.
std::vector<Comparison> compare_with_paper();

}  // namespace holdfast::program
