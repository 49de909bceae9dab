#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "kernels/pack_kernels.hpp"

namespace holdfast::program {

/// HurwitzRows on the packs of an instruction set.
class HurwitzOnPacks {
 public:
  explicit HurwitzOnPacks(const PackKernels& kernels) : kernels_(&kernels) {}

  void fill(const Vector<double, 6>& constant, const Vector<double, 6>& slope,
            const std::vector<double>& values, std::uint8_t* stable) const {
    kernels_->stable_line(constant, slope, values, stable);
  }
  void fill(const Eigen::Matrix<double, Eigen::Dynamic, 6>& table, std::uint8_t* stable) const {
    kernels_->stable_table(table, stable);
  }

 private:
  const PackKernels* kernels_;
};

/// The kernel of that degree, 5 or 6.
template <int Degree>
std::unique_ptr<RadiusKernel<Degree>> radius_kernel(const PackKernels& kernels) {
  if constexpr (Degree == 5) {
    return kernels.radius_of_degree_5();
  } else {
    return kernels.radius_of_degree_6();
  }
}

/// RadiusBatch on the packs of an instruction set.
template <int Degree>
class RadiusOnPacks : public CopiedKernel<RadiusKernel<Degree>> {
 public:
  using Table = typename RadiusKernel<Degree>::Table;

  explicit RadiusOnPacks(const PackKernels& kernels)
      : CopiedKernel<RadiusKernel<Degree>>(radius_kernel<Degree>(kernels)) {}

  std::int64_t most_rows() const { return this->kernel().most_rows(); }
  void fill(const AffineLine<Degree>* lines, std::int64_t count, const Axis& values,
            double* radius) {
    this->kernel().fill(lines, count, values, radius);
  }
  void fill(const Table* tables, std::int64_t count, double* radius) {
    this->kernel().fill(tables, count, radius);
  }
};

}  // namespace holdfast::program
