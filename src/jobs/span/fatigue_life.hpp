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
  double speed;        ///< wind speed (m/s)
  double hours;        ///< hours per year
  double damage_bare;  ///< without devices; median over the pairs of laws
  Band damage;         ///< with devices
};

/// Yearly damage at one temperature of the conductor.
struct TemperatureDamage {
  double temperature;  ///< temperature (°C)
  double hours;        ///< hours per year
  double tension;      ///< horizontal tension (N)
  double damage_bare;  ///< without devices; median over the pairs of laws
  Band damage;         ///< with devices
};

/// Fatigue of the conductor at its clamps in the wind of its site.
struct FatigueLife {
  double cycles;             ///< vibration cycles per year
  Band damage_bare, damage;  ///< damage per year by Miner's rule, without and with devices
  Band stress_bare, stress;  ///< largest stress (Pa), zero to peak, without and with devices
  double worst_frequency;    ///< frequency (Hz) of the largest stress with devices
  std::vector<SpeedDamage> by_speed;
  std::vector<TemperatureDamage> by_temperature;  ///< empty without weather.hours
};

/// Life (years), 1/damage; infinite where the damage is 0.
Band years_of(const Band& damage);

/// Fatigue by Miner's rule over the yearly hours of each wind speed, for each pair of wind law and
/// self-damping law. weather.hours distributes these hours over the temperatures. For a vibration
/// below the wind law's range, `lowest` assumes amplitude 0, other results the range's lower end.
/// @param lowest, highest  lowest and highest vibration frequency considered (Hz)
/// Throws WrongInput without [site], diameter or outer wires, for steel wires, and if no wind of
/// [site] sheds vortices at a considered frequency.
FatigueLife fatigue_life_of(const Case& the_case, bool controlled, double lowest, double highest);

}  // namespace holdfast::program
