#pragma once

#include "support/temporary_folder.hpp"

namespace holdfast::tests {

/// A variable of the environment, as it was when the object goes.
class Variable {
 public:
  Variable(const char* name, const std::string& value) : name_(name) {
    if (const char* before = std::getenv(name)) before_ = before;
    setenv(name, value.c_str(), 1);
  }
  ~Variable() {
    if (before_)
      setenv(name_, before_->c_str(), 1);
    else
      unsetenv(name_);
  }
  Variable(const Variable&) = delete;
  Variable& operator=(const Variable&) = delete;
  Variable(Variable&&) = delete;
  Variable& operator=(Variable&&) = delete;

 private:
  const char* name_;
  std::optional<std::string> before_;
};

/// A gnuplot of our own that is found before any other.
class OtherGnuplot {
 public:
  /// @param script  what it does, for sh
  explicit OtherGnuplot(const std::string& script)
      : path_("PATH", folder_.path().string() + ":" + std::getenv("PATH")) {
    write_text(folder_ / "gnuplot", "#!/bin/sh\n" + script);
    std::filesystem::permissions(folder_ / "gnuplot", std::filesystem::perms::owner_all);
  }

 private:
  TemporaryFolder folder_;
  Variable path_;
};

}  // namespace holdfast::tests
