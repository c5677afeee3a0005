#include "paper/reproduction.hpp"

#include <array>
#include <cstdio>

namespace supercoil::host_sim::paper {

std::string shown(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.6g", value);
  return text.data();
}

std::vector<Part> reproduce(const std::function<void(double)>& progress) {
  constexpr std::array steps{repeat_estimation, repeat_tracking, compute_errata, run_physical,
                             compare_arithmetic};
  std::vector<Part> parts;
  for (const auto& step : steps) {
    progress(static_cast<double>(parts.size()) / static_cast<double>(steps.size()));
    parts.push_back(step());
  }
  return parts;
}

}  // namespace supercoil::host_sim::paper
