// An operator of setup for tests.
#pragma once

#include <string>
#include <utility>

#include "apps/supercoil/setup/operator.hpp"

namespace supercoil::test {

/// Nobody is there, and all that is said is heard.
class Listener final : public operating::Operator {
 public:
  void say(const std::string& line) override { told_ += line + "\n"; }
  void show_progress(const std::string&, double) override {}
  bool sees_progress() const override { return false; }
  bool interrupted() const override { return false; }
  OrWhy ask(const operating::Question&, const std::function<Done()>&) override {
    return tl::unexpected<std::string>("nobody answers");
  }
  /// Since the last time.
  std::string take() { return std::exchange(told_, {}); }

 private:
  std::string told_;
};

}  // namespace supercoil::test
