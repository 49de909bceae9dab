#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <vector>

#include "holdfast/core/compiler.hpp"

namespace holdfast {

/// The number e^x − 1 for complex x, to full relative accuracy.
template <class Scalar>
std::complex<Scalar> complex_expm1(const std::complex<Scalar>& x) {
  const Scalar half_sine = std::sin(x.imag() / Scalar(2)), grown = std::expm1(x.real());
  return {grown * std::cos(x.imag()) - Scalar(2) * half_sine * half_sine,
          (grown + Scalar(1)) * std::sin(x.imag())};
}

/// The number e^{iθ} − 1 to full relative accuracy, also for small θ.
/// @param angle  θ (rad)
template <class Scalar>
std::complex<Scalar> circle_increment(const Scalar& angle) {
  return complex_expm1(std::complex<Scalar>(0, angle));
}

/// The integral ∫₀^t e^{su} du = (e^{st} − 1)/s; accurate near s = 0 too, where it tends to t.
/// @param s  complex rate (1/s)
/// @param t  time (s)
template <class Scalar>
std::complex<Scalar> exponential_integral(const std::complex<Scalar>& s, const Scalar& t) {
  return s == std::complex<Scalar>(0) ? std::complex<Scalar>(t) : complex_expm1(s * t) / s;
}

namespace detail {

/// Complex numbers in the lanes of a SIMD register, for sums over many poles.
/// @tparam Scalar  double or float
template <class Scalar>
struct ComplexLanes {
  static constexpr int size =  // number of lanes; NOLINTNEXTLINE(bugprone-branch-clone): a macro
      (EIGEN_MAX_STATIC_ALIGN_BYTES > 16 ? EIGEN_MAX_STATIC_ALIGN_BYTES : 16) / sizeof(Scalar);
  using Reals = Eigen::Array<Scalar, size, 1>;  ///< a real number for each lane

  Reals re = Reals::Zero(), im = Reals::Zero();

  void set(Eigen::Index lane, const std::complex<Scalar>& value) {
    re[lane] = value.real();
    im[lane] = value.imag();
  }
  std::complex<Scalar> operator[](Eigen::Index lane) const { return {re[lane], im[lane]}; }
  std::complex<Scalar> sum() const { return {re.sum(), im.sum()}; }
  EIGEN_ALWAYS_INLINE ComplexLanes inverse() const {
    const Reals scale = (re * re + im * im).inverse();
    return {re * scale, -im * scale};
  }
  EIGEN_ALWAYS_INLINE ComplexLanes conjugate() const { return {re, -im}; }
  EIGEN_ALWAYS_INLINE ComplexLanes& operator+=(const ComplexLanes& other) {
    re += other.re;
    im += other.im;
    return *this;
  }
  EIGEN_ALWAYS_INLINE friend ComplexLanes operator+(const ComplexLanes& a, const ComplexLanes& b) {
    return {a.re + b.re, a.im + b.im};
  }
  EIGEN_ALWAYS_INLINE friend ComplexLanes operator-(const ComplexLanes& a, const ComplexLanes& b) {
    return {a.re - b.re, a.im - b.im};
  }
  EIGEN_ALWAYS_INLINE friend ComplexLanes operator*(const ComplexLanes& a, const ComplexLanes& b) {
    return {a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re};
  }
  EIGEN_ALWAYS_INLINE friend ComplexLanes operator-(const std::complex<Scalar>& a,
                                                    const ComplexLanes& b) {
    return {a.real() - b.re, a.imag() - b.im};
  }
  EIGEN_ALWAYS_INLINE friend ComplexLanes operator+(const ComplexLanes& a,
                                                    const std::complex<Scalar>& b) {
    return {a.re + b.real(), a.im + b.imag()};
  }
};

/// A table of complex numbers, stored in blocks with one row for each lane of a SIMD register.
/// @tparam Scalar  double or float
template <class Scalar, std::size_t Columns>
class ComplexRows {
 public:
  using Row = std::array<std::complex<Scalar>, Columns>;    ///< one row of complex numbers
  using Block = std::array<ComplexLanes<Scalar>, Columns>;  ///< one row for each lane

  /// Constructs an empty table. @param first  real part of column 0 in the last block's unused rows
  explicit ComplexRows(const Scalar& first = Scalar(0)) : first_(first) {}

  void push_back(const Row& row) {
    if (size_ % lanes == 0) {
      blocks_.emplace_back();
      blocks_.back().front().re = first_;
    }
    set(size_++, row);
  }
  /// Replaces row k, 0 ≤ k < size().
  void set(std::size_t k, const Row& row) {
    for (std::size_t c = 0; c < Columns; ++c) blocks_[k / lanes][c].set(lane_of(k), row[c]);
  }
  /// The row k, 0 ≤ k < size().
  Row operator[](std::size_t k) const {
    Row row;
    for (std::size_t c = 0; c < Columns; ++c) row[c] = blocks_[k / lanes][c][lane_of(k)];
    return row;
  }
  std::size_t size() const { return size_; }
  std::vector<Block>& blocks() { return blocks_; }
  const std::vector<Block>& blocks() const { return blocks_; }  ///< all rows, in blocks

 private:
  static constexpr std::size_t lanes = ComplexLanes<Scalar>::size;
  static Eigen::Index lane_of(std::size_t k) { return static_cast<Eigen::Index>(k % lanes); }

  Scalar first_;
  std::vector<Block> blocks_;
  std::size_t size_ = 0;
};

}  // namespace detail

}  // namespace holdfast
