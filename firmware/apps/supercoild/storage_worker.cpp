#include "apps/supercoild/storage_worker.hpp"

#include <algorithm>
#include <ctime>

#include "apps/supercoild/log.hpp"
#include "config/describe.hpp"
#include "recorder/names.hpp"
#include "recorder/pump.hpp"
#include "text/result_words.hpp"

namespace supercoil::daemon {

namespace {

/// How much the relay can hold while the storage worker waits for the disk.
constexpr double relayed_s = 1.0;

std::size_t rows_relayed(const BoardSettings& board) {
  return static_cast<std::size_t>(relayed_s * board.rate_Hz) * board.channels.size();
}

/// A controller that is stable on the configured muscle may be unstable on the learned one.
void warn_unstable(const ChannelSettings& channel, std::size_t index, double step_s) {
  for (std::size_t i = 0; i < channel.controllers.size(); ++i) {
    const auto margin = margin_of(channel.controllers[i], channel, step_s);
    if (!margin || margin->stable()) continue;
    log(Level::problem, "channel " + std::to_string(index + 1) + ": controller " +
                            std::to_string(i) + " is unstable on the muscle learned before");
  }
}

void warn_without_proof(const ChannelSettings& channel, std::size_t index) {
  if (channel.supervision.proof_of_response) return;
  log(Level::warning,
      "channel " + std::to_string(index + 1) +
          (channel.joint.has_other()  ? ": a joint's two muscles have no proof of response"
           : channel.bundle.follows() ? ": only the bundle as a whole proves its response"
                                      : ": detectors.proof_of_response is false") +
          ": nothing checks that a hot muscle at rest still responds");
}

}  // namespace

Result<void> load_learned(config::BoardConfig& config, std::vector<storage::LearnedStore>& stores) {
  for (std::size_t i = 0; i < stores.size(); ++i) {
    warn_without_proof(config.settings.channels[i], i);
    const auto loaded = stores[i].load();
    if (!loaded) return tl::unexpected(loaded.error());
    for (const std::string& problem : loaded->problems)
      log(Level::warning, problem);
    ChannelSettings& channel = config.settings.channels[i];
    if (loaded->learned) apply_learned(channel, *loaded->learned);
    if (const auto problem = drop_unusable_tuning(channel, config.settings.step_s())) {
      log(Level::problem, "channel " + std::to_string(i + 1) + ": the stored tuning is not used: " +
                              problem->key + " " + problem->message);
    }
    log(channel.senses.compared() ? Level::info : Level::warning,
        "channel " + std::to_string(i + 1) +
            ": senses: " + config::describe_senses(channel, config.settings));
    log(Level::info,
        "channel " + std::to_string(i + 1) + ": heat: " + config::describe_heat(channel));
    if (!channel.has_muscle) continue;
    log(Level::info, "channel " + std::to_string(i + 1) + ": small motions: " +
                         config::describe_small_motions(channel, config.settings));
    log(Level::info, "channel " + std::to_string(i + 1) + " (" + config.labels[i].name +
                         ") uses its muscle from version " +
                         std::to_string(loaded->learned->version));
    warn_unstable(channel, i, config.settings.step_s());
  }
  return {};
}

StorageWorker::StorageWorker(const config::BoardConfig& config,
                             std::vector<storage::LearnedStore>& stores, storage::Files& files)
    : config_(&config),
      stores_(&stores),
      recorder_(config.storage_folder, static_cast<int>(config.settings.channels.size()),
                config.settings.rate_Hz, files),
      relay_(rows_relayed(config.settings)),
      last_(config.settings.channels.size()) {
  for (const ChannelSettings& channel : config.settings.channels)
    senses_.push_back(channel.senses);
}

void StorageWorker::poll(Loop& loop, hal::Time now) {
  struct Tee {
    bool take(Row& row) const {
      if (!storage_worker->relay_.take(row)) return false;
      storage_worker->watch(row);
      return true;
    }
    StorageWorker* storage_worker;
  } tee{this};
  recorder::pump(tee, recorder_, now);
  report_lost(loop.timing().lost_rows.load(std::memory_order_relaxed), reported_lost_by_loop_,
              "the telemetry thread was kept from running for more than a second");
  log_notes();
  for (std::size_t i = 0; i < stores_->size(); ++i)
    store_learned(loop, i);
}

void StorageWorker::store_learned(Loop& loop, std::size_t channel) {
  const std::string label = "channel " + std::to_string(channel + 1);
  board::LearnedUpdate update;
  while (loop.channel(channel).take_learned_update(update)) {
    if (!update) {
      forget(channel, label);
      continue;
    }
    set_comparison_date(channel, label, update->senses);
    const auto saved = (*stores_)[channel].save(*update);
    if (saved) {
      log(Level::info, label + " learned; stored as version " + std::to_string(*saved));
    } else {
      log(Level::problem, label + " learned, but it is not stored: " + saved.error().text());
    }
  }
}

/// The loop has no calendar: the storage worker dates the comparisons that it made.
void StorageWorker::set_comparison_date(std::size_t channel, const std::string& label,
                                        board::SenseComparison& senses) {
  board::SenseComparison& known = senses_[channel];
  const bool is_known = senses.supply_gain == known.supply_gain &&
                        senses.current_gain == known.current_gain &&
                        senses.error_ratio == known.error_ratio;
  if (is_known) {
    senses.compared_s = known.compared_s;
    return;
  }
  if (senses.compared()) senses.compared_s = static_cast<double>(std::time(nullptr));
  known = senses;
  ChannelSettings now = config_->settings.channels[channel];
  now.senses = senses;
  log(Level::info, label + ": senses: " + config::describe_senses(now, config_->settings));
}

void StorageWorker::forget(std::size_t channel, const std::string& label) {
  if (const auto forgotten = (*stores_)[channel].forget(); !forgotten) {
    log(Level::problem, label + " cannot forget its muscle: " + forgotten.error().text());
    return;
  }
  log(Level::info, label + " has forgotten its muscle, from the next start on");
}

void StorageWorker::finish() {
  recorder_.finish();
  log_notes();
}

bool StorageWorker::all_off() const {
  return std::none_of(last_.begin(), last_.end(), [](const Row& row) {
    const auto state = static_cast<State>(row.state);
    return state == State::armed || state == State::active;
  });
}

void StorageWorker::watch(const Row& row) {
  ++rows_;
  if (row.channel >= last_.size()) return;
  Row& before = last_[row.channel];
  if (row.state != before.state || row.mode != before.mode) {
    const bool fault = static_cast<State>(row.state) == State::fault;
    std::string text = "channel " + std::to_string(row.channel + 1) + " (" +
                       config_->labels[row.channel].name + ") is " +
                       recorder::state_name(row.state);
    if (fault) {
      text += ": " + recorder::fault_name(row.fault) + " (" + std::to_string(row.fault) + ")";
    } else if (row.mode != 0) {
      text += ", " + recorder::mode_name(row.mode);
    }
    log(fault ? Level::problem : Level::info, text);
  }
  if (row.result != before.result && static_cast<ModeResult>(row.result) > ModeResult::found) {
    log(Level::warning, "channel " + std::to_string(row.channel + 1) + ": " +
                            recorder::mode_name(before.mode) + " ended, nothing is stored: " +
                            result_text(static_cast<ModeResult>(row.result), row.identify_notes));
  }
  before = row;
}

void StorageWorker::report_lost(std::size_t lost, std::size_t& reported, const char* why) {
  if (lost == reported) return;
  log(Level::warning,
      std::to_string(lost - reported) + " rows are missing from recordings: " + why);
  reported = lost;
}

void StorageWorker::log_notes() {
  report_lost(relay_.lost(), reported_lost_by_disk_, "the disk kept the recorder waiting");
  for (const recorder::RecorderNote& note : recorder_.take_notes())
    log(note.problem ? Level::problem : Level::info, note.text);
}

}  // namespace supercoil::daemon
