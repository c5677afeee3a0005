#include "recorder/flight_recorder.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "recorder/names.hpp"
#include "recorder/recording.hpp"
#include "storage/crc32.hpp"
#include "text/program_version.hpp"

namespace supercoil::recorder {

namespace {

constexpr std::size_t max_notes = 32;
/// poll() writes this much later than add(), because rows may be on their way.
constexpr std::int64_t max_row_delay_ns = 1'000'000'000;

std::int64_t nanoseconds(double seconds) {
  return std::llround(seconds * 1e9);
}

std::size_t rows_for(const RecorderSettings& s, int channels, double rate_Hz) {
  // Counts both ends of the time, and the tick that shows that it has passed.
  const double ticks = std::ceil((s.before_s + s.after_s + s.retry_s) * rate_Hz) + 2.0;
  return static_cast<std::size_t>(ticks) * static_cast<std::size_t>(channels);
}

std::string what(const Row& cause) {
  return fault_name(cause.fault) + " (" + std::to_string(cause.fault) + ") of channel " +
         std::to_string(cause.channel + 1);
}

}  // namespace

FlightRecorder::FlightRecorder(std::string folder, int channels, double rate_Hz,
                               storage::Files& files, const RecorderSettings& settings)
    : before_ns_(nanoseconds(settings.before_s)),
      after_ns_(nanoseconds(settings.after_s)),
      retry_ns_(nanoseconds(settings.retry_s)),
      rate_Hz_(rate_Hz),
      folder_(std::move(folder), settings.max_recordings, settings.list, files),
      rows_(rows_for(settings, channels, rate_Hz)),
      faults_(static_cast<std::size_t>(channels)) {
  // One recording is collected at a time, for after_s; each waits for retry_s at most.
  jobs_.reserve(static_cast<std::size_t>(settings.retry_s / settings.after_s) + 3);
}

void FlightRecorder::add(const Row& row) {
  if (row.channel >= faults_.size()) return;
  if (!jobs_.empty()) write_due(row.time_ns);
  watch(row);
  rows_[next_] = row;
  next_ = next_ + 1 == rows_.size() ? 0 : next_ + 1;
  size_ = std::min(size_ + 1, rows_.size());
}

void FlightRecorder::watch(const Row& row) {
  // A change from one fault to another counts too: reset and tripped again within a tick.
  const bool latches = row.fault != 0 && row.fault != faults_[row.channel];
  faults_[row.channel] = row.fault;
  // A fault during a recording is part of it but does not extend it: channels that fault one after
  // the other could extend it without end.
  const bool collecting = !jobs_.empty() && !jobs_.back().again;
  if (latches && !collecting) jobs_.push_back({row, row.time_ns + after_ns_, false});
}

void FlightRecorder::poll(hal::Time now) {
  write_due(now.count() - max_row_delay_ns);
}

void FlightRecorder::finish() {
  for (const Job& job : jobs_)
    write(job, true);
  jobs_.clear();
}

void FlightRecorder::write_due(std::int64_t now_ns) {
  for (auto job = jobs_.begin(); job != jobs_.end();) {
    if (now_ns <= job->due_ns) {
      ++job;
    } else if (write(*job, job->again) || job->again) {
      job = jobs_.erase(job);
    } else {
      job->again = true;
      job->due_ns = now_ns + retry_ns_;
      ++job;
    }
  }
}

bool FlightRecorder::write(const Job& job, bool last_try) {
  const std::int64_t fault_ns = job.cause.time_ns;
  const Window found = window(fault_ns - before_ns_, fault_ns + after_ns_);
  if (found.first.empty()) {
    note(true, what(job.cause) + " is not recorded: its rows are gone; they came faster than at " +
                   std::to_string(rate_Hz_) + " Hz");
    return true;
  }
  Header header;
  header.rows = (found.first.size() + found.second.size()) / sizeof(Row);
  header.channels = static_cast<int>(faults_.size());
  header.rate_Hz = rate_Hz_;
  header.fault = job.cause.fault;
  header.fault_name = fault_name(job.cause.fault);
  header.fault_channel = job.cause.channel;
  header.fault_time_ns = fault_ns;
  header.program = program_version();
  header.rows_crc32 = storage::crc32(found.first, found.second);
  const std::string start = encode(header);
  const auto written =
      folder_.write(std::array<std::string_view, 3>{start, found.first, found.second});
  if (!written) {
    note(true, what(job.cause) + " is not recorded: " + written.error().text() +
                   (last_try ? "; giving up" : "; will try once more"));
    return false;
  }
  note(false, written->path + ": " + what(job.cause) + " is recorded");
  for (const std::string& problem : written->problems)
    note(true, problem);
  return true;
}

const Row& FlightRecorder::oldest(std::size_t i) const {
  return rows_[(next_ + rows_.size() - size_ + i) % rows_.size()];
}

FlightRecorder::Window FlightRecorder::window(std::int64_t from_ns, std::int64_t until_ns) const {
  std::size_t from = 0;
  while (from < size_ && oldest(from).time_ns < from_ns)
    ++from;
  std::size_t end = from;
  while (end < size_ && oldest(end).time_ns <= until_ns)
    ++end;
  if (from == end) return {};
  const std::size_t count = end - from;
  const Row* first = &oldest(from);
  const auto start = static_cast<std::size_t>(first - rows_.data());
  const std::size_t before_the_end = std::min(count, rows_.size() - start);
  const auto bytes = [](const Row* row, std::size_t n) {
    return std::string_view(reinterpret_cast<const char*>(row), n * sizeof(Row));
  };
  return {bytes(first, before_the_end), bytes(rows_.data(), count - before_the_end)};
}

void FlightRecorder::note(bool problem, std::string text) {
  // Nobody has taken the notes: the latest matter most.
  if (notes_.size() == max_notes) notes_.erase(notes_.begin());
  notes_.push_back({problem, std::move(text)});
}

}  // namespace supercoil::recorder
