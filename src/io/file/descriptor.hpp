#pragma once

#include <unistd.h>

#include <utility>

namespace holdfast::program {

/// A file descriptor of the system, closed by the destructor; a negative number means none.
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

  /// Returns the descriptor and gives up its ownership: the caller must close it.
  int release() { return std::exchange(number_, -1); }

 private:
  int number_;
};

}  // namespace holdfast::program
