#include "storage/store.hpp"

#include <algorithm>
#include <cassert>
#include <ctime>
#include <limits>
#include <utility>

#include "storage/codec.hpp"

namespace supercoil::storage {

namespace {

/// A channel's first eight damaged files are kept, and the latest: a disk that damages every file
/// must not be filled with them.
constexpr int max_damaged = 9;

constexpr const char* previous_used = "the version before it is used";

std::uint32_t version_after(const Examined& current, const Examined& previous) {
  const std::uint32_t last = std::max(current.learned.value_or(board::Learned{}).version,
                                      previous.learned.value_or(board::Learned{}).version);
  return last == std::numeric_limits<std::uint32_t>::max() ? last : last + 1;
}

}  // namespace

LearnedStore::LearnedStore(std::string folder, int channel, Files& files, Clock clock)
    : folder_(std::move(folder)),
      path_(folder_ + "/learned-" + std::to_string(channel) + ".toml"),
      previous_path_(path_ + ".previous"),
      new_path_(path_ + ".new"),
      previous_new_path_(previous_path_ + ".new"),
      cleared_path_(path_ + ".cleared"),
      files_(&files),
      clock_(std::move(clock)) {
  assert(channel >= 1 && channel <= 16);
}

Result<Loaded> LearnedStore::load() {
  const Examined current = examine(*files_, path_);
  const Examined previous = examine(*files_, previous_path_);
  if (current.learned) {
    Loaded loaded{Source::current, current.learned, {}};
    if (previous.damaged()) loaded.problems.push_back(previous.problem);
    return loaded;
  }
  if (previous.learned) {
    return Loaded{Source::previous, previous.learned, {current.problem + "; " + previous_used}};
  }
  if (current.exists || previous.exists) {
    return failure(current.problem + "; " + previous.problem);
  }
  if (const auto folder = files_->check_folder(folder_); !folder) {
    return tl::unexpected(folder.error());
  }
  return Loaded{};
}

double LearnedStore::system_clock() {
  return static_cast<double>(std::time(nullptr));
}

/// A muscle that is already stored keeps its date.
void LearnedStore::set_date(board::Learned& learned, const Examined& current,
                            const Examined& previous) const {
  board::Identification& identification = learned.identification;
  if (!identification.found() || identification.identified_s != 0.0) return;
  const auto& before = current.learned ? current.learned : previous.learned;
  if (before && before->muscle == learned.muscle &&
      before->identification.deviation_ratio == identification.deviation_ratio)
    identification.identified_s = before->identification.identified_s;
  if (identification.identified_s == 0.0) identification.identified_s = clock_();
}

Result<std::uint32_t> LearnedStore::save(const board::Learned& learned) {
  const Examined current = examine(*files_, path_);
  const Examined previous = examine(*files_, previous_path_);
  board::Learned next = learned;
  set_date(next, current, previous);
  if (current.learned && board::same_content(*current.learned, next)) {
    // An earlier save may have failed, or its process ended, just before the sync.
    if (const auto synced = synced_ ? Result<void>{} : files_->sync_folder(folder_); !synced) {
      return tl::unexpected(synced.error());
    }
    synced_ = true;
    return current.learned->version;
  }
  next.version = version_after(current, previous);
  const std::string content = encode(next);
  // A file that cannot be read back must not replace one that can.
  if (const auto readable = decode(content); !readable) {
    return failure("is not stored: " + readable.error().text());
  }
  synced_ = false;
  if (const auto replaced = replace(current, previous, content); !replaced) {
    static_cast<void>(remove(new_path_));  // a full disk needs the space; the cause is reported
    return tl::unexpected(replaced.error());
  }
  synced_ = true;
  return next.version;
}

Result<void> LearnedStore::forget() {
  const auto before = load();
  if (before && before->learned && !has_muscle()) return {};
  if (const auto cleared = clear(); !cleared) return tl::unexpected(cleared.error());
  if (!before || !before->learned) return {};
  board::Learned kept;
  kept.senses = before->learned->senses;
  kept.tuning = before->learned->tuning;
  kept.has_muscle = false;
  if (!kept.senses.compared() && kept.tuning == board::StoredTuning{}) return {};
  if (const auto saved = save(kept); !saved) return tl::unexpected(saved.error());
  return {};
}

/// Whether either file holds a muscle; a damaged one may.
bool LearnedStore::has_muscle() const {
  const auto may_hold_muscle = [&](const std::string& path) {
    const Examined file = examine(*files_, path);
    return file.damaged() || (file.learned && (file.learned->has_muscle ||
                                               file.learned->heat != board::ThermalFacts{}));
  };
  return may_hold_muscle(path_) || may_hold_muscle(previous_path_);
}

/// The file that load() uses goes last, so that load() never gives an older set or an error.
Result<void> LearnedStore::clear() {
  synced_ = false;
  const bool by_current = examine(*files_, path_).learned.has_value();
  for (const bool current : {!by_current, by_current}) {
    auto gone = current ? files_->rename(path_, cleared_path_) : files_->unlink(previous_path_);
    if (!gone && gone.error().code != std::errc::no_such_file_or_directory) return gone;
    if (auto synced = files_->sync_folder(folder_); !synced) return synced;
  }
  return {};
}

Result<void> LearnedStore::replace(const Examined& current, const Examined& previous,
                                   const std::string& content) {
  if (auto written = write_new(content); !written) return written;
  // A damaged file is set aside only when its name is about to be taken.
  if (current.damaged()) {
    if (auto kept = set_aside(path_); !kept) return kept;
  }
  // After a power cut during a save, both names may hold the same version; it is then kept already.
  const bool becomes_previous =
      current.learned && (!previous.learned || *previous.learned != *current.learned);
  if (becomes_previous) {
    if (auto kept = previous.damaged() ? set_aside(previous_path_) : Result<void>{}; !kept) {
      return kept;
    }
    if (auto linked = link_fresh(path_, previous_new_path_); !linked) return linked;
  }
  // In this order the two names never hold the same version, so that two versions always exist.
  if (auto renamed = files_->rename(new_path_, path_); !renamed) return renamed;
  if (becomes_previous) {
    if (auto renamed = files_->rename(previous_new_path_, previous_path_); !renamed) return renamed;
  }
  return files_->sync_folder(folder_);
}

Result<void> LearnedStore::write_new(const std::string& content) {
  // Removed rather than truncated: after a power cut it may be another name of the current file.
  auto removed = remove(new_path_);
  // On a read-only disk it fails whether the file is there or not: that it cannot be created is why
  // nothing is stored.
  if (!removed && removed.error().code != std::errc::read_only_file_system) return removed;
  const auto file = files_->create(new_path_);
  if (!file) return tl::unexpected(file.error());
  auto result = files_->write(*file, content);
  if (result) result = files_->sync(*file);
  const auto closed = files_->close(*file);
  return result ? closed : result;
}

Result<void> LearnedStore::set_aside(const std::string& path) {
  const std::string name = path_ + ".damaged-";
  Result<void> linked;
  for (int i = 1; i < max_damaged; ++i) {
    linked = files_->link(path, name + std::to_string(i));
    if (linked || linked.error().code != std::errc::file_exists) break;
  }
  if (!linked && linked.error().code == std::errc::file_exists) {
    linked = link_fresh(path, name + std::to_string(max_damaged));
  }
  if (!linked) return linked;
  // Otherwise a power cut might undo this link and keep the file that takes its name.
  return files_->sync_folder(folder_);
}

Result<void> LearnedStore::link_fresh(const std::string& from, const std::string& to) {
  if (auto removed = remove(to); !removed) return removed;
  return files_->link(from, to);
}

Result<void> LearnedStore::remove(const std::string& path) {
  auto removed = files_->unlink(path);
  if (!removed && removed.error().code == std::errc::no_such_file_or_directory) return {};
  return removed;
}

}  // namespace supercoil::storage
