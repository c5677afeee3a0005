#include "apps/supercoil/identify/input.hpp"

#include <limits>

#include "apps/supercoil/user_file.hpp"
#include "recorder/recording.hpp"

namespace supercoil::operating {

namespace {

using identification::Problem;
using identification::Recording;

/// The rows of one channel. Line numbers are those that supercoil log would write.
tl::expected<Recording, Problem> from_flight_recording(std::string_view content, int channel) {
  const auto flight = recorder::decode(content, recorder::Damaged::refuse);
  if (!flight) return tl::unexpected(Problem{0, flight.error().text()});
  if (channel == 0 && flight->header.channels > 1) {
    return tl::unexpected(Problem{0, "has " + std::to_string(flight->header.channels) +
                                         " channels: choose one with --channel"});
  }
  Recording recording;
  for (std::size_t i = 0; i < flight->rows.size(); ++i) {
    const Row& row = flight->rows[i];
    if (channel != 0 && row.channel + 1 != channel) continue;
    recording.time_s.push_back(flight->time_s(row));
    recording.position_m.push_back(row.position_m);
    recording.power_W.push_back(row.applied_W);
    recording.line.push_back(i + 2);
  }
  return recording;
}

}  // namespace

std::string to_text(const std::string& file, const Problem& problem) {
  return file + ":" + (problem.line > 0 ? std::to_string(problem.line) + ":" : "") + " " +
         problem.text;
}

Result<Recording> read_input(const IdentifyOptions& o) {
  const auto content = read_file(o.file);
  if (!content) return tl::unexpected(content.error());
  const auto text_of = [&](const Problem& problem) { return failure(to_text(o.file, problem)); };
  const bool flight = content->starts_with("supercoil flight recording");
  if (!flight && content->find('\0') != std::string::npos)
    return text_of({0, "is not text: it must be CSV in UTF-8, or a flight recording"});
  auto recording = flight ? from_flight_recording(*content, o.columns.channel)
                          : identification::read_csv(*content, o.columns);
  if (!recording) return text_of(recording.error());
  if (recording->size() == 0 && o.columns.channel != 0)
    return text_of({0, "has no rows of channel " + std::to_string(o.columns.channel)});
  identification::cut(*recording, {o.from_s, o.to_s});
  const auto gaps = o.bridge_gaps ? identification::Gaps::bridge : identification::Gaps::refuse;
  if (auto checked = identification::check(*recording, gaps); !checked)
    return text_of(checked.error());
  return std::move(*recording);
}

}  // namespace supercoil::operating
