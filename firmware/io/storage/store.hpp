// Stores a channel's learned set so that neither a power cut nor a damaged file loses it.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "supercoil/hal/error.hpp"

#include "board/learned.hpp"
#include "storage/examined.hpp"
#include "storage/files.hpp"

namespace supercoil::storage {

/// Which file a set was loaded from.
enum class Source {
  nothing,   ///< nothing has been stored yet
  current,   ///< what was saved last
  previous,  ///< what was saved before that, because the current file is damaged or gone
};

/// What load() found.
struct Loaded {
  Source source = Source::nothing;
  std::optional<board::Learned> learned;  ///< empty when nothing has been stored yet
  /// "path: what is wrong with it", and what is used instead, for the log; empty when all is in
  /// order.
  std::vector<std::string> problems;
};

/// The files of one channel, in a folder on a file system with hard links:
///   learned-N.toml                the current set
///   learned-N.toml.previous       the one before
///   learned-N.toml.new            being written; means nothing
///   learned-N.toml.previous.new   on its way to become the previous one; means nothing
///   learned-N.toml.cleared        the set that was forgotten last; for examination, never read
///   learned-N.toml.damaged-1 … 9  damaged files; for examination, never read
///
/// Whenever the power or a call fails, load() gives either the set before the save or the one that
/// was being saved, complete. A new file gets the current one's name only when its content is on
/// the disk, and only a file that decodes becomes the previous one.
///
/// One store per channel, used by one thread at a time, never by the control loop: calls block.
class LearnedStore {
 public:
  using Clock = std::function<double()>;  ///< in seconds since 1970

  /// channel: 1 to 16, checked by the configuration. files must outlive the store. Does not touch
  /// the disk.
  LearnedStore(std::string folder, int channel, Files& files, Clock clock = system_clock);

  /// The best set there is. The error says why a set that was stored cannot be used, or that the
  /// folder is missing: it may be on a disk that is not mounted. Changes nothing on the disk.
  Result<Loaded> load();

  /// Stores a set and returns its version, one more than that of the last complete one. What
  /// identify found is dated at its first save, as the loop has no calendar. Saving the same
  /// content again writes nothing. A set that fails check() is refused. After an error the set may
  /// or may not be stored; load() tells which. Saving again is always allowed.
  Result<std::uint32_t> save(const board::Learned& learned);

  /// Removes the stored muscle; versions count from 1 again. The comparison of the senses, which is
  /// the board's, and the tuning, which is cleared by its own command, are kept. The current file
  /// stays for examination. If the power or a call fails meanwhile, either the current set is still
  /// stored or nothing is.
  Result<void> forget();

 private:
  static double system_clock();
  void set_date(board::Learned& learned, const Examined& current, const Examined& previous) const;
  /// Writes this content as the current file; a good current file becomes the previous one.
  Result<void> replace(const Examined& current, const Examined& previous,
                       const std::string& content);
  bool has_muscle() const;
  Result<void> clear();
  Result<void> write_new(const std::string& content);
  /// Gives a damaged file a second name, under which it stays when its own is taken.
  Result<void> set_aside(const std::string& path);
  Result<void> link_fresh(const std::string& from, const std::string& to);
  Result<void> remove(const std::string& path);

  std::string folder_;
  std::string path_;
  std::string previous_path_;
  std::string new_path_;
  std::string previous_new_path_;
  std::string cleared_path_;
  Files* files_;
  Clock clock_;
  /// The names that this store sees are on the disk: a power cut would leave the same.
  bool synced_ = false;
};

}  // namespace supercoil::storage
