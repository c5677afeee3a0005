// supercoil log, for a candump log.
#include <cstdio>

#include "apps/supercoil/bus/log_file.hpp"
#include "apps/supercoil/can_csv.hpp"
#include "apps/supercoil/commands.hpp"
#include "apps/supercoil/mcap/export.hpp"
#include "can/codec.hpp"
#include "can/generated/messages.hpp"

namespace supercoil::operating {

namespace {

std::string known_messages() {
  std::string all;
  for (const can::MessageInfo& message : can::all_messages)
    all.append(all.empty() ? "" : ", ").append(message.name);
  return all;
}

}  // namespace

int can_log_command(const LogOptions& options) {
  const auto log = read_can_log(options.file);
  if (!log) {
    return refuse(options.json, exit_wrong_input,
                  log.error().code != std::errc{}
                      ? log.error().text()
                      : options.file + ": is neither a flight recording nor a log of candump -L");
  }
  if (options.summary || options.damaged || options.channel != 0) {
    return refuse(options.json, exit_wrong_input,
                  options.file +
                      ": is a CAN log: --summary, --damaged and --channel are for "
                      "flight recordings");
  }
  if (!options.message.empty() && can::find_message(options.message) == nullptr) {
    return fail(exit_wrong_input,
                "--message " + options.message + ": there are " + known_messages());
  }
  if (!(options.from_s <= options.to_s))
    return fail(exit_wrong_input, "--from must not be later than --to");
  if (log->damaged_lines > 0) {
    std::fprintf(stderr, "supercoil: %s\n", log->damage_text().c_str());
  }
  const CanSelection selection{options.from_s, options.to_s, options.node, options.message};
  const auto write_all = options.mcap ? mcap::from_can_log : can_to_csv;
  return write_output(
      options, options.file + ": has no frame of that node, message and time",
      [&](const recorder::Sink& sink) { return write_all(log->frames, selection, sink); });
}

}  // namespace supercoil::operating
