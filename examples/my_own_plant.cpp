// My plant is not the library's two masses. What can I still ask?
#include <cmath>
#include <cstdio>

#include "holdfast/chaos/lyapunov_spectrum.hpp"
#include "holdfast/control/sampled_loop.hpp"
#include "holdfast/control/zero_order_hold.hpp"
#include "holdfast/math/linalg/spectral_radius.hpp"
#include "holdfast/plant/two_mass.hpp"
#include "holdfast/stability/boundary/stable_intervals.hpp"
#include "holdfast/stability/polynomial/characteristic_polynomial.hpp"

using namespace holdfast;

// Four states, [z₁, ż₁, z₂, ż₂] with the law u = P z₁ + D ż₁: a template with these three members
// is a plant for `sampled_loop`, and so for charts, boundaries and responses; margins and motions
// take a TwoMass or a LinearPlant. Here the motor pushes against the ground instead of the
// absorber.
template <class Scalar>
struct GroundedMotor {
  TwoMass<Scalar> masses;

  Matrix<Scalar, 4> state_matrix() const { return masses.state_matrix(); }
  Vector<Scalar, 4> control_input() const { return masses.excitation_input(); }
  Vector<Scalar, 4> excitation_input() const { return masses.excitation_input(); }
};

// Any number of states: matrices of that size. Two masses of a conductor and an absorber hanging
// from the first one, x = [z₁, z₂, z₃, ż₁, ż₂, ż₃].
Matrix<double, 6> three_masses() {
  const Vector<double, 3> mass(0.05, 0.08, 0.16);  // kg
  Matrix<double, 3> stiffness;                     // N/m
  stiffness << 190.0, -70.0, -74.4, -70.0, 110.0, 0.0, -74.4, 0.0, 74.4;
  const Matrix<double, 3> damping = 0.02 * stiffness;  // N s/m
  Matrix<double, 6> a = Matrix<double, 6>::Zero();
  a.topRightCorner<3, 3>().setIdentity();
  a.bottomLeftCorner<3, 3>() = (-mass.cwiseInverse()).asDiagonal() * stiffness;
  a.bottomRightCorner<3, 3>() = (-mass.cwiseInverse()).asDiagonal() * damping;
  return a;
}

int main() {
  const GroundedMotor<double> grounded{kollar2022_plant()};
  const auto loop = sampled_loop(grounded, Sampling<double>{0.010});
  for (const auto& p : stable_proportional_gains(characteristic_polynomial(loop), -2.0))
    std::printf("motor on the ground, D = -2 N s/m: stable for P from %.1f to %.1f N/m\n", p.lower,
                p.upper);

  const Vector<double, 6> push{0.0, 0.0, 0.0, 1.0 / 0.05, 0.0, -1.0 / 0.16};
  const auto held = zero_order_hold<double, 6, 1>(three_masses(), push, 0.010);
  for (const double d : {-8.0, -4.0, 0.0, 4.0}) {
    const RowVector<double, 6> gains{-50.0, 0.0, 0.0, d, 0.0, 0.0};
    const Matrix<double, 6> map = held.transition + held.input * gains;
    LyapunovSpectrum<double, 6> spectrum;  // takes any sequence of maps; here it is one map
    for (int step = 0; step < 12000; ++step) {
      if (step == 2000) spectrum.restart();  // the directions have turned into their places
      spectrum.push(map, 6);
    }
    std::printf("three masses, D = %2.0f N s/m: spectral radius %.3f, by its exponent %.3f\n", d,
                spectral_radius(map), std::exp(spectrum.exponents()[0]));
  }
}
