// A row of the table that compares the paper's figures with ours.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace supercoil::host_sim::paper {

struct ReproductionRow {
  std::string id;         ///< stable: others refer to it
  std::string case_name;  ///< which reading of the paper, or which of our controllers
  std::string quantity;
  std::string unit;
  std::string paper;     ///< as printed; empty where the paper gives none
  std::string measured;  ///< by this program, now
  std::string remark;
};

/// A number with six significant digits.
std::string shown(double value);

/// A window of time and the running mean of what falls into it (ends included).
struct MeanInWindow {
  double from_s;
  double to_s;
  double sum = 0.0;
  std::int64_t count = 0;

  void add(double time_s, double value) {
    if (time_s < from_s || time_s > to_s) return;
    sum += value;
    ++count;
  }
  double mean() const { return sum / static_cast<double>(count); }
};

}  // namespace supercoil::host_sim::paper
