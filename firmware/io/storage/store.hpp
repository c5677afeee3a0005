// Where a channel's learned set is kept, so that neither a power cut nor a damaged file loses it.
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

enum class Source {
  nothing,   ///< nothing has been stored yet
  current,   ///< what was saved last
  previous,  ///< what was saved before that, because the current file is damaged or gone
};

struct Loaded {
  Source source = Source::nothing;
  std::optional<board::Learned> learned;  ///< empty when nothing has been stored yet
  /// "path: what is wrong with it", for the log; empty when all is in order.
  std::vector<std::string> problems;
};

/// The files of one channel, in a folder on a file system with hard links:
///   learned-N.toml                the current set
///   learned-N.toml.previous       the one before
///   learned-N.toml.new            being written; means nothing
///   learned-N.toml.previous.new   on its way to become the previous one; means nothing
///   learned-N.toml.cleared        the last that was to be forgotten,
///   learned-N.toml.damaged-1 … 9  and damaged ones: kept for examination; nothing here reads them
///
/// Whenever the power fails or a call fails, load() gives the set from before the save or the one
/// that was being saved, whole: a new file gets the current one's name only when its content is on
/// the disk, and only a file that decodes becomes the previous one.
///
/// One store a channel, used by one thread at a time, which is not the control loop's: calls block.
class LearnedStore {
 public:
  using Clock = std::function<double()>;  ///< in seconds since 1970

  /// channel: 1 to 16, as the configuration has checked. files must outlive the store. Touches
  /// nothing yet.
  LearnedStore(std::string folder, int channel, Files& files, Clock clock = system_clock);

  /// The best set there is. The error says why there is none though something was stored, or that
  /// the folder is not there: what was learned may be on a disk that is not mounted. Changes
  /// nothing on the disk.
  Result<Loaded> load();

  /// Stores a set and returns the version that it got, one more than the last that is whole. What
  /// identify found gets the date of its first save, as the loop has no calendar. The same content
  /// again writes nothing. A set that fails check() is refused. After an error the set
  /// may be stored or not, and load() says which; saving again is always allowed.
  Result<std::uint32_t> save(const board::Learned& learned);

  /// From now on no muscle is stored, and versions count from 1 again; a comparison of the senses
  /// is kept, as it is the board's, and so is the tuning, which has a way back of its own. The
  /// current file stays for examination. When the power fails meanwhile, or a call, the current set
  /// is still there, or nothing is.
  Result<void> forget();

 private:
  static double system_clock();
  void date(board::Learned& learned, const Examined& current, const Examined& previous) const;
  /// Makes the current file a file of this content, and a good current file the previous one.
  Result<void> replace(const Examined& current, const Examined& previous,
                       const std::string& content);
  bool has_muscle() const;
  Result<void> clear();
  Result<void> write_new(const std::string& content);
  /// Gives a damaged file another name by which it stays when its own is taken.
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
  /// What this store sees by its name is also what a power cut would leave.
  bool synced_ = false;
};

}  // namespace supercoil::storage
