// trace.csv: one row a tick.
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>

#include <tl/expected.hpp>

#include "runner/simulation.hpp"

namespace supercoil::host_sim {

/// Numbers are written with as many digits as it takes to read the same double back.
class TraceWriter {
 public:
  /// every: one row per this many ticks, from the first on. of_joint: its records have an
  /// antagonist.
  TraceWriter(const std::filesystem::path& path, std::int64_t every, bool of_joint = false);

  void add(const TickRecord& record, const std::optional<control::Estimate>& estimate);
  bool wants(std::int64_t tick) const { return tick % every_ == 0; }
  /// The error says why the file is not complete.
  tl::expected<void, std::string> finish();

 private:
  void number(double value);
  void flush();

  std::ofstream out_;
  std::int64_t every_;
  std::string buffer_;
};

}  // namespace supercoil::host_sim
