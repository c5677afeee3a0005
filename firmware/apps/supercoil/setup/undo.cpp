#include <algorithm>
#include <filesystem>
#include <system_error>

#include "apps/supercoil/setup/board_file.hpp"
#include "apps/supercoil/setup/record.hpp"
#include "apps/supercoil/setup/steps.hpp"
#include "apps/supercoil/user_file.hpp"
#include "storage/crc32.hpp"

namespace supercoil::operating {

namespace {

using Json = nlohmann::ordered_json;
using Write = SetupRecord::Write;

std::string change_text(const Write& write) {
  return write.step + " of channel " + std::to_string(write.channel);
}

/// The last write, if it is this channel's.
Result<Write> own_write(const SetupOptions& options, const SetupRecord& record) {
  const auto last = record.last_write();
  if (!last) {
    std::error_code ignored;
    const std::string kept = options.config + before_setup;
    if (!std::filesystem::exists(kept, ignored))
      return failure(options.config + ": setup has changed nothing");
    return failure(SetupRecord::path_of(options.config) + ": does not say what setup wrote; " +
                   kept + " is the file as it was before: compare, and copy it yourself");
  }
  if (last->channel == options.channel) return *last;
  const std::string other = std::to_string(last->channel);
  return failure(options.config + ": the last change was " + change_text(*last) +
                 ": undo that first with --channel " + other + " --undo");
}

/// What the completed steps from this one on left on the board, with the channel as in commands.
std::vector<OnBoard> left_on_board(const SetupOptions& options, const SetupRecord& record,
                                   const std::string& first) {
  int channel = options.channel;
  if (!options.can.empty()) {
    const auto config = config::read_board_config(options.config);
    if (config && config->can) channel += config->can->first_node - 1;
  }
  const std::string board = options.board_words();
  const std::string of_channel = " " + std::to_string(channel);
  const auto* const from = std::ranges::find(setup_steps, first, &SetupStep::name);
  const auto found = [&](std::string_view name) {
    const auto* const step = std::ranges::find(setup_steps, name, &SetupStep::name);
    return step < from ? Json() : record.found(std::string(name));
  };
  const auto done = [&](std::string_view name) { return !found(name).is_null(); };
  std::vector<OnBoard> all;
  if (done("calibrate") || done("scale") || done("identify")) {
    all.push_back(
        {"what was found of the muscle", "supercoil command" + of_channel + " clear" + board});
  }
  if (const Json gains = found("gains"); gains.is_object() && gains.value("taken", false)) {
    all.push_back(
        {"the tuning that gains stored", "supercoil tune" + of_channel + " --clear" + board});
  }
  if (done("senses")) {
    all.push_back({"the comparison with a meter",
                   "supercoil command" + of_channel + " compare_supply 0" + board});
  }
  return all;
}

}  // namespace

Result<Undone> undo_setup(const SetupOptions& options,
                          const std::function<bool(const std::string& why)>& anyway) {
  auto record = SetupRecord::open(options.config, options.channel);
  if (!record) return tl::unexpected(record.error());
  const auto last = own_write(options, *record);
  if (!last) return tl::unexpected(last.error());
  const auto before = read_file(last->before);
  if (!before) return tl::unexpected(before.error());
  const auto now = read_file(options.config);
  if (!now) return tl::unexpected(now.error());
  // A write that was cut short left the file as it was before.
  if (storage::crc32(*now) != last->crc32 && *now != *before) {
    const std::string why = options.config + ": was changed after " + change_text(*last) +
                            " wrote it, and that later change would be undone too";
    if (!anyway(why)) return failure(why + "; --undo --force does it");
  }
  Undone undone{last->channel, last->step, free_name(options.config + ".undone"),
                left_on_board(options, *record, last->step)};
  if (auto kept = write_file(undone.kept_as, *now); !kept) return tl::unexpected(kept.error());
  std::error_code error;
  std::filesystem::rename(last->before, options.config, error);
  if (error) return failed_call(last->before, error.value());
  if (auto removed = record->remove_last_write(); !removed) return tl::unexpected(removed.error());
  return undone;
}

std::string undone_text(const std::string& config, const Undone& undone) {
  std::string text = config + " is as it was before " + undone.step + " of channel " +
                     std::to_string(undone.channel) +
                     ", and that step and all later ones must be repeated; " +
                     "the file as it was until now is kept as " + undone.kept_as;
  const char* before = "\nthe board keeps, from start to start, ";
  for (const OnBoard& one : undone.on_board) {
    text += before + one.what + " (" + one.forgotten_by + " forgets it)";
    before = "; ";
  }
  return text;
}

}  // namespace supercoil::operating
