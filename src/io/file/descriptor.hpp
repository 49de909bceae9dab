#pragma once

#include <unistd.h>

#include <utility>

namespace holdfast::program {

/// An open file of the system, closed when the object goes; a number below 0 stands for none.
class Descriptor {
 public:
  explicit Descriptor(int number = -1) : number_(number) {}
  ~Descriptor() {
    if (number_ >= 0) close(number_);
  }
  Descriptor(Descriptor&& other) noexcept : number_(other.release()) {}
  Descriptor& operator=(Descriptor&& other) noexcept {
    Descriptor before(std::exchange(number_, other.release()));
    return *this;
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;

  int number() const { return number_; }
  bool is_open() const { return number_ >= 0; }

  /// Leaves it to the caller to close the file.
  int release() { return std::exchange(number_, -1); }

 private:
  int number_;
};

}  // namespace holdfast::program
