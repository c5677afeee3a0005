#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <system_error>

#include <unistd.h>

#include "apps/supercoil/commands.hpp"
#include "apps/supercoil/mcap/export.hpp"
#include "apps/supercoil/summary.hpp"
#include "apps/supercoil/user_file.hpp"
#include "recorder/header.hpp"
#include "recorder/recording.hpp"
#include "storage/posix_files.hpp"

namespace supercoil::operating {

namespace {

namespace fs = std::filesystem;

/// Why it cannot be read; empty: it is a file. A pipe cannot be read twice, nor its size be known.
std::string file_problem(const std::string& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (!fs::exists(status)) {
    return path + ": " +
           (error && error.value() != ENOENT ? error.message() : "there is no such file");
  }
  return fs::is_regular_file(status) ? "" : path + ": is not a file";
}

/// Whether it begins as flight recordings do; also one that is empty or cannot be read.
bool is_recording(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  std::string begin(recorder::magic.size(), '\0');
  in.read(begin.data(), static_cast<std::streamsize>(begin.size()));
  begin.resize(static_cast<std::size_t>(in.gcount()));
  return recorder::magic.starts_with(begin);
}

Result<std::string> read(const std::string& path, storage::Files& files) {
  std::error_code error;
  const std::uintmax_t bytes = fs::file_size(path, error);
  if (error) return failed_call(path + ": cannot be read", error.value());
  auto content = files.read(path, bytes);
  if (!content) return tl::unexpected(content.error());
  return std::move(*content);
}

int print(const std::string& text, storage::Files& files) {
  const auto written = files.write({STDOUT_FILENO, "standard output"}, text);
  return written ? exit_done : fail(exit_failed, written.error().text());
}

int write_to_stdout(const std::string& nothing, const Produce& produce) {
  storage::PosixFiles files;
  const auto count = produce([&](std::string_view part) -> Result<void> {
    const auto written = files.write({STDOUT_FILENO, "standard output"}, part);
    if (!written) return tl::unexpected(written.error());
    return {};
  });
  if (!count) return fail(exit_failed, count.error().text());
  return *count > 0 ? exit_done : fail(exit_wrong_input, nothing);
}

/// The rows, as CSV or MCAP.
int write_rows(const recorder::Recording& recording, const LogOptions& options) {
  return write_output(options, options.file + ": has no rows for that channel and time",
                      [&](const recorder::Sink& sink) -> Result<std::size_t> {
                        const std::size_t rows = recording.rows.size();
                        if (rows == 0) return 0;
                        const auto written = options.mcap ? mcap::from_recording(recording, sink)
                                                          : recorder::to_csv(recording, sink);
                        return written.map([&] { return rows; });
                      });
}

/// Why these rows cannot be shown; empty when they can.
std::string wrong_choice(const LogOptions& o, const recorder::Recording& recording) {
  // Written so that NaN is rejected too.
  if (!(o.from_s <= o.to_s)) return "--from must not be later than --to";
  if (o.channel > recording.header.channels) {
    return "--channel " + std::to_string(o.channel) + ": the recording has channels 1 to " +
           std::to_string(recording.header.channels);
  }
  return {};
}

}  // namespace

int write_output(const LogOptions& options, const std::string& nothing, const Produce& produce) {
  const std::string& path = options.out;
  if (path.empty()) return write_to_stdout(nothing, produce);
  if (would_replace(path, options.file))
    return fail(exit_wrong_input, path + ": would replace " + options.file + " itself");
  storage::PosixFiles files;
  auto file = OutputFile::open(path, files);
  if (!file) return fail(exit_wrong_input, file.error().text());
  const auto count = produce([&](std::string_view part) { return file->write(part); });
  if (!count) return fail(exit_failed, count.error().text());
  if (*count == 0) return fail(exit_wrong_input, nothing);
  const auto kept = file->commit();
  return kept ? exit_done : fail(exit_failed, kept.error().text());
}

int log_command(const LogOptions& options) {
  if (options.mcap && options.out.empty() && isatty(STDOUT_FILENO) == 1) {
    return fail(exit_wrong_input,
                "--mcap: MCAP is not written to a terminal; use --out FILE or a pipe");
  }
  if (const std::string problem = file_problem(options.file); !problem.empty())
    return refuse(options.json, exit_wrong_input, problem);
  if (!is_recording(options.file)) return can_log_command(options);
  if (options.node != 0 || !options.message.empty()) {
    return refuse(options.json, exit_wrong_input,
                  options.file + ": is not a CAN log; --node and --message apply only to CAN logs");
  }
  storage::PosixFiles files;
  const auto content = read(options.file, files);
  if (!content) return refuse(options.json, exit_wrong_input, content.error().text());
  auto recording = recorder::decode(
      *content, options.damaged ? recorder::Damaged::read : recorder::Damaged::refuse);
  if (!recording)
    return refuse(options.json, exit_wrong_input, options.file + ": " + recording.error().text());
  if (const std::string wrong = wrong_choice(options, *recording); !wrong.empty())
    return refuse(options.json, exit_wrong_input, wrong);
  if (!recording->damage.empty()) {
    std::fprintf(stderr, "supercoil: %s: %s; %zu rows are read\n", options.file.c_str(),
                 recording->damage.c_str(), recording->rows.size());
  }
  if (options.summary)
    return print(options.json ? summary_json(*recording) : summary(*recording), files);
  recorder::select(*recording, options.from_s, options.to_s, options.channel - 1);
  return write_rows(*recording, options);
}

}  // namespace supercoil::operating
