#pragma once

#include <vector>

#include "case/case.hpp"

namespace holdfast::program {

/// Median, lowest and highest of a result over all pairs of laws.
struct Band {
  double value, lowest, highest;
};

/// Median, lowest and highest of some numbers, at least one.
Band band_of(std::vector<double> numbers);

/// Yearly damage by the wind of one speed.
struct SpeedDamage {
  double speed;  ///< wind speed (m/s)
  double hours;  ///< hours per year
  double damage_bare;
  Band damage;
};

/// Yearly damage at one temperature of the conductor.
struct TemperatureDamage {
  double temperature;  ///< temperature (°C)
  double hours;        ///< hours per year
  double tension;      ///< horizontal tension (N)
  double damage_bare;
  Band damage;
};

/// Fatigue of the conductor at its clamps in the wind of its site.
struct FatigueLife {
  double cycles;             ///< vibration cycles per year
  Band damage_bare, damage;  ///< damage per year by Miner's rule
  Band stress_bare, stress;  ///< largest stress (Pa), zero to peak
  double worst_frequency;    ///< frequency (Hz) of the largest stress with devices
  std::vector<SpeedDamage> by_speed;
  std::vector<TemperatureDamage> by_temperature;  ///< empty without weather.hours
};

/// Life (years), 1/damage; infinite where the damage is 0.
Band years_of(const Band& damage);

/// Fatigue by Miner's rule over the hours of each wind speed, for each pair of a wind law and a
/// self-damping law. weather.hours distributes these hours over the temperatures. A vibration below
/// the wind law's range counts as 0 in the lowest result, else as the range's lower end.
/// @param lowest, highest  lowest and highest vibration frequency considered (Hz)
/// Throws WrongInput where the case gives no [site], diameter or outer wires.
FatigueLife fatigue_life_of(const Case& the_case, bool controlled, double lowest, double highest);

}  // namespace holdfast::program
