// A laboratory recording: rows of time, position and power, as written.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include <tl/expected.hpp>

#include "supercoil/identification/samples.hpp"

namespace supercoil::identification {

/// What is wrong with a file; line 0: the whole file.
struct Problem {
  std::size_t line = 0;
  std::string text;
};

/// Rows in the file's order. power_W acts from its row to the next; position_m is NaN where none
/// was measured.
struct Recording {
  std::vector<double> time_s;
  std::vector<double> position_m;
  std::vector<double> power_W;
  std::vector<std::size_t> line;  ///< of each row, from 1
  std::vector<Problem> warnings;

  std::size_t size() const { return time_s.size(); }
};

/// Which column holds a quantity, and in which unit.
struct Column {
  std::string name;    ///< or its number, from 1; empty: a usual name
  std::string unit;    ///< e.g. "ms"; empty: from the column's name, else SI
  double scale = 1.0;  ///< factor on the value in its unit
};

struct Columns {
  Column time;
  Column position;
  Column power;
  int channel = 0;  ///< of a file with a column `channel`; 0: it must have only one
};

/// Reads CSV with a line of names: fields separated by comma, semicolon, tab or spaces; lines that
/// begin with # are skipped; a decimal comma where semicolons separate. Only the position may be
/// empty or NaN. Returns the first error.
tl::expected<Recording, Problem> read_csv(std::string_view text, const Columns& columns);

enum class Gaps { refuse, bridge };

/// Refuses what cannot be a muscle's recording: too few rows, times that go back, gaps, infinite or
/// negative values, sizes that only a wrong unit explains, power that never changes. Adds warnings
/// to the recording.
tl::expected<void, Problem> check(Recording& recording, Gaps gaps);

/// Keeps only the rows within the span.
void cut(Recording& recording, Span span);

/// A checked recording at a constant rate: 50 Hz, or the recording's if lower, and at most 10,000
/// samples. Position is averaged around each sample, power over the time until the next.
Samples resample(const Recording& recording);

}  // namespace supercoil::identification
