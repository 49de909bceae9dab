#pragma once

#include <string>
#include <vector>

#include "report/figures/figure.hpp"

namespace holdfast::program {

/// A key of the case along an axis of a map, and how the picture shows it.
struct MapAxis {
  std::string key;  ///< "control.sampling_period"
  double min, max;  ///< in the key's unit, min < max
  bool logarithmic;
  std::string label;
  double scale;  ///< the picture shows scale times the key's value
};

/// One of the maps of a figure, side by side.
struct MapPanel {
  std::string heading;               ///< in gnuplot's enhanced text
  std::vector<std::string> options;  ///< of the job sweep: duration, and what this panel alone sets
};

/// A curve that is drawn over every panel.
struct MapCurve {
  std::vector<TableRequest> tables;  ///< none: there is no curve
  std::string points;                ///< "@NAME@ using x:y", in what the axes show
  std::string label;
};

/// What a map shows.
struct SuccessMap {
  MapAxis x, y;
  std::vector<MapPanel> panels;  ///< one or two
  MapCurve curve;
};

/// gnuplot's expression for what the picture's axis shows of a value, itself an expression.
std::string shown_on(const MapAxis& axis, const std::string& value);

/// The steady amplitude over that without control in 61 × 61 cells, P tuned to the excitation by
/// Eq. 6 and D the best of each cell; shades for classes of the ratio and for why there is none,
/// marks that tell them apart without colour. A cell that is no admissible case stays empty.
Figure success_figure(const std::string& name, const std::string& title, const std::string& caption,
                      const SuccessMap& map);

}  // namespace holdfast::program
