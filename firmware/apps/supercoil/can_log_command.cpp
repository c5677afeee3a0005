// supercoil log, of a candump log.
#include <cstdio>
#include <fstream>

#include <unistd.h>

#include "apps/supercoil/bus/log_file.hpp"
#include "apps/supercoil/can_csv.hpp"
#include "apps/supercoil/commands.hpp"
#include "apps/supercoil/output_file.hpp"
#include "can/codec.hpp"
#include "can/generated/messages.hpp"
#include "storage/posix_files.hpp"

namespace supercoil::operating {

namespace {

std::string known_messages() {
  std::string all;
  for (const can::MessageInfo& message : can::all_messages)
    all.append(all.empty() ? "" : ", ").append(message.name);
  return all;
}

int no_rows(const LogOptions& options) {
  return fail(exit_wrong_input, options.file + ": has no such frames of that time and node");
}

}  // namespace

bool is_can_log(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return in.get() == '(';
}

int can_log_command(const LogOptions& options) {
  if (options.summary || options.damaged || options.channel != 0) {
    return fail(exit_wrong_input, options.file +
                                      ": is a CAN log: --summary, --damaged and --channel are for "
                                      "flight recordings");
  }
  if (!options.message.empty() && can::find_message(options.message) == nullptr) {
    return fail(exit_wrong_input,
                "--message " + options.message + ": there are " + known_messages());
  }
  if (!(options.from_s <= options.to_s))
    return fail(exit_wrong_input, "--from must not be later than --to");
  const auto log = read_can_log(options.file);
  if (!log) return fail(exit_wrong_input, log.error());
  if (log->damaged_lines > 0) {
    std::fprintf(stderr, "supercoil: %s; %zu such lines are left out\n", log->damage.c_str(),
                 log->damaged_lines);
  }
  storage::PosixFiles files;
  const CanSelection selection{options.from_s, options.to_s, options.node, options.message};
  if (options.out.empty()) {
    const auto rows = can_to_csv(
        log->frames, selection, [&](std::string_view part) -> tl::expected<void, std::string> {
          const auto written = files.write({STDOUT_FILENO, "standard output"}, part);
          if (!written) return tl::unexpected(written.error().text);
          return {};
        });
    if (!rows) return fail(exit_failed, rows.error());
    return *rows > 0 ? exit_done : no_rows(options);
  }
  auto file = OutputFile::open(options.out, files);
  if (!file) return fail(exit_wrong_input, file.error());
  const auto rows =
      can_to_csv(log->frames, selection, [&](std::string_view part) { return file->write(part); });
  if (!rows) return fail(exit_failed, rows.error());
  if (*rows == 0) return no_rows(options);
  const auto kept = file->commit();
  return kept ? exit_done : fail(exit_failed, kept.error());
}

}  // namespace supercoil::operating
