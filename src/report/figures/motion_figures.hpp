#pragma once

#include <string>
#include <vector>

#include "report/figures/figure.hpp"

namespace holdfast::program {

/// A key of the case along the abscissa of a picture.
struct FigureAxis {
  std::string key;    ///< "backlash.width"
  std::string range;  ///< MIN:MAX:COUNT, in the key's unit
  std::string label;  ///< with the unit that the scale leads to
  double scale;       ///< the picture shows scale times the key's value
};

/// Orbit diagram: z₁ once every forcing period, the key going up and back.
Figure diagram_figure(const std::string& name, const std::string& title, const std::string& caption,
                      const FigureAxis& axis, const std::vector<std::string>& settings);

/// Basins over initial.z1 and initial.z2, a colour an attractor; the legend has period and share.
/// @param range  MIN:MAX:COUNT of both, m
Figure basins_figure(const std::string& name, const std::string& title, const std::string& caption,
                     const std::string& range, const std::vector<std::string>& settings);

/// A motion beside another one: its heading and its settings.
struct OrbitPanel {
  std::string heading;
  std::vector<std::string> settings;
};

/// The exact orbits of several cases in the phase plane, side by side.
Figure orbits_figure(const std::string& name, const std::string& title, const std::string& caption,
                     const std::vector<OrbitPanel>& panels);

/// Poincaré section Δż = 0 of the motion between two instants (s), in the phase plane.
Figure section_figure(const std::string& name, const std::string& title, const std::string& caption,
                      const std::string& from, const std::string& to,
                      const std::vector<std::string>& settings);

/// What the built-in case shows of them.
std::vector<Figure> motion_figures();

}  // namespace holdfast::program
