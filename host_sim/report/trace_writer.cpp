#include "report/trace_writer.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>

namespace supercoil::host_sim {

namespace {

constexpr std::size_t flush_bytes = 1 << 20;

/// An empty cell means that there is no value.
class CsvTrace final : public TraceWriter {
 public:
  CsvTrace(const std::filesystem::path& path, std::int64_t every, const Conditions* conditions)
      : TraceWriter(path, TraceFormat::csv, every, conditions) {
    for (const TraceColumn& column : columns())
      buffer_.append(column.name).append(&column == &columns().back() ? "\n" : ",");
  }

 private:
  void add_row(const TraceRow& row) override {
    for (const TraceColumn& column : columns()) {
      if (column.word != nullptr) {
        buffer_ += column.word(row);
      } else if (const auto value = column.number(row)) {
        number(*value);
      }
      buffer_ += &column == &columns().back() ? '\n' : ',';
    }
  }
  void number(double value) {
    std::array<char, 32> text{};
    const auto end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
    buffer_.append(text.data(), end);
  }
};

/// An array of records, in numpy's format 1.0
/// (https://numpy.org/doc/stable/reference/generated/numpy.lib.format.html): doubles, NaN for no
/// value, and words of word_bytes bytes. The header gets the number of rows at the end: the file of
/// a program that was killed has none.
class NpyTrace final : public TraceWriter {
 public:
  NpyTrace(const std::filesystem::path& path, std::int64_t every, const Conditions* conditions)
      : TraceWriter(path, TraceFormat::npy, every, conditions) {
    buffer_ = header(0);
  }

 private:
  static constexpr std::size_t word_bytes = 24;  ///< "energy_budget_exceeded" has 22
  static constexpr std::size_t count_digits = 12;

  static_assert(std::endian::native == std::endian::little && sizeof(double) == 8);

  void add_row(const TraceRow& row) override {
    for (const TraceColumn& column : columns()) {
      std::array<char, word_bytes> bytes{};
      if (column.word != nullptr) {
        const std::string_view word = column.word(row);
        std::memcpy(bytes.data(), word.data(), std::min(word.size(), bytes.size()));
        buffer_.append(bytes.data(), bytes.size());
      } else {
        const double value = column.number(row).value_or(NAN);
        std::memcpy(bytes.data(), &value, sizeof value);
        buffer_.append(bytes.data(), sizeof value);
      }
    }
  }

  std::string header_of_all() const override { return header(rows()); }

  /// Has the same length for every number.
  std::string header(std::int64_t count) const {
    const std::string digits = std::to_string(count);
    std::string text = "{'descr': [";
    for (const TraceColumn& column : columns()) {
      text.append("('").append(column.name).append("', '");
      text += column.word != nullptr ? "|S" + std::to_string(word_bytes) : "<f8";
      text += "'), ";
    }
    text += "], 'fortran_order': False, 'shape': (" +
            std::string(count_digits - digits.size(), ' ') + digits + ",)}";
    constexpr std::size_t before = 10;  // magic, version and length
    constexpr std::size_t alignment = 64;
    text.append(alignment - (before + text.size() + 1) % alignment, ' ') += '\n';
    std::string start("\x93NUMPY\x01\x00", 8);
    start += static_cast<char>(text.size() & 0xFF);
    start += static_cast<char>(text.size() >> 8);
    return start + text;
  }
};

}  // namespace

const char* trace_file(TraceFormat format) {
  return format == TraceFormat::csv ? "trace.csv" : "trace.npy";
}

TraceWriter::TraceWriter(const std::filesystem::path& path, TraceFormat format, std::int64_t every,
                         const Conditions* conditions)
    : out_(path, std::ios::binary),
      format_(format),
      every_(every),
      columns_(trace_columns(conditions)),
      lever_(conditions != nullptr && conditions->joint ? conditions->joint->plant.lever
                                                        : control::Lever()) {
  buffer_.reserve(flush_bytes + 4096);
}

void TraceWriter::add(const TickRecord& record, const std::optional<control::Estimate>& estimate) {
  ++rows_;
  add_row({record, estimate, lever_});
  if (buffer_.size() >= flush_bytes) flush();
}

void TraceWriter::flush() {
  out_ << buffer_;
  buffer_.clear();
}

Result<void> TraceWriter::finish() {
  flush();
  if (const std::string header = header_of_all(); !header.empty()) {
    out_.seekp(0);
    out_ << header;
  }
  out_.close();
  if (out_) return {};
  return failed_call(std::string(trace_file(format_)) + ": cannot be written", errno);
}

std::unique_ptr<TraceWriter> write_trace(const std::filesystem::path& path, TraceFormat format,
                                         std::int64_t every, const Conditions* conditions) {
  if (format == TraceFormat::csv) return std::make_unique<CsvTrace>(path, every, conditions);
  return std::make_unique<NpyTrace>(path, every, conditions);
}

}  // namespace supercoil::host_sim
