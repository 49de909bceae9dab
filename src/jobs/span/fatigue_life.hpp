#pragma once

#include <vector>

#include "case/case.hpp"

namespace holdfast::program {

/// A number by the laws: the middle one of them, the lowest and the highest.
struct Band {
  double value, lowest, highest;
};

/// The middle, lowest and highest of some numbers, one at least.
Band band_of(std::vector<double> numbers);

/// Damage by the wind of one speed in a year, a part of the damages of a life.
struct SpeedDamage {
  double speed;  ///< m/s
  double hours;  ///< a year
  double damage_bare;
  Band damage;
};

/// Damage at one temperature of the conductor, likewise.
struct TemperatureDamage {
  double temperature;  ///< °C
  double hours;        ///< a year
  double tension;      ///< N, horizontal
  double damage_bare;
  Band damage;
};

/// The life of the conductor at its clamps in the wind of its site.
struct FatigueLife {
  double cycles;             ///< of vibration, a year
  Band damage_bare, damage;  ///< by Miner's rule, a year
  Band stress_bare, stress;  ///< the largest one (Pa), zero to peak
  double worst_frequency;    ///< Hz, of the largest stress with the devices
  std::vector<SpeedDamage> by_speed;
  std::vector<TemperatureDamage> by_temperature;  ///< of weather.hours; empty without
};

/// 1/damage (years); infinity where there is none.
Band years_of(const Band& damage);

/// Miner's sum over the hours of each wind speed, shared out over those of each temperature where
/// weather.hours has them, over each pair of laws of wind and self-damping;
/// where a vibration is smaller than the law of the wind was measured for, nothing for the lowest
/// number and its bound for the others.
/// @param lowest, highest  frequencies of vibration that count (Hz)
/// Throws WrongInput where the case knows no site, diameter or outer wires.
FatigueLife fatigue_life_of(const Case& the_case, bool controlled, double lowest, double highest);

}  // namespace holdfast::program
