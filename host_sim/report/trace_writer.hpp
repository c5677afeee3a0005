// trace.csv or trace.npy: one row a tick.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "supercoil/hal/error.hpp"

#include "report/trace_columns.hpp"

namespace supercoil::host_sim {

enum class TraceFormat { csv, npy };

/// "trace.csv", "trace.npy".
const char* trace_file(TraceFormat format);

class TraceWriter {
 public:
  TraceWriter(const TraceWriter&) = delete;
  TraceWriter& operator=(const TraceWriter&) = delete;
  virtual ~TraceWriter() = default;

  void add(const TickRecord& record, const std::optional<control::Estimate>& estimate);
  bool is_due(std::int64_t tick) const { return tick % every_ == 0; }
  /// The error says why the file is not complete.
  Result<void> finish();

 protected:
  TraceWriter(const std::filesystem::path& path, TraceFormat format, std::int64_t every,
              const Conditions* conditions);

  const std::vector<TraceColumn>& columns() const { return columns_; }
  std::int64_t rows() const { return rows_; }
  std::string buffer_;

 private:
  virtual void add_row(const TraceRow& row) = 0;
  /// The file's header, once all rows are there; empty: what was written stays.
  virtual std::string header_of_all() const { return {}; }
  void flush();

  std::ofstream out_;
  TraceFormat format_;
  std::int64_t every_;
  std::vector<TraceColumn> columns_;
  control::Lever lever_;
  std::int64_t rows_ = 0;
};

/// every: one row per this many ticks, from the first on. conditions: of the scenario, for
/// what it has in addition to a muscle. Numbers can be read back to the bit.
std::unique_ptr<TraceWriter> write_trace(const std::filesystem::path& path, TraceFormat format,
                                         std::int64_t every,
                                         const Conditions* conditions = nullptr);

}  // namespace supercoil::host_sim
