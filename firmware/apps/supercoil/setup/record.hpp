// Setup's progress, stored beside the board's file, so that it survives a power cut.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include <nlohmann/json.hpp>

#include "supercoil/hal/error.hpp"

namespace supercoil::operating {

/// The record of one channel. "board.toml.setup.json" has one object for each channel, and in it
/// one for each completed step: what the step found. "writes" lists the changes of the board's
/// file, the last one at the end, and "answers" has a person's answers by channel.
class SetupRecord {
 public:
  /// An absent file is an empty record. The error: why a file is not a record; nothing is lost.
  static Result<SetupRecord> open(const std::string& config, int channel);
  static std::string path_of(const std::string& config) { return config + ".setup.json"; }

  /// Where the file is.
  const std::string& path() const { return path_; }

  bool has(const std::string& step) const;
  /// Whether a later step is done.
  bool has_later_step(const std::string& step) const;
  /// What a step found; null: it was not done.
  nlohmann::ordered_json found(const std::string& step) const;
  /// From this step on nothing counts as done. It stays in the file until it is done again, because
  /// the board that it was done with may come back.
  void discount_from(const std::string& step) { discounted_from_ = step; }
  /// Key in the findings of a step: the same for a joint's other muscle, which was measured with
  /// it, and its "channel".
  static constexpr const char* antagonist_key = "antagonist";
  /// Writes the whole file at once; findings for an antagonist go to its channel. Later steps must
  /// be done again.
  Result<void> add(const std::string& step, const nlohmann::ordered_json& found);

  /// A person's last answer to describe, by a question's key; describe offers it when it asks
  /// again.
  std::optional<double> answer(const std::string& key) const;
  Result<void> add_answer(const std::string& key, double value);

  /// One change of the board's file.
  struct Write {
    int channel = 1;
    std::string step;
    std::string before;       ///< file with the text before the change
    std::uint32_t crc32 = 0;  ///< of the text after the change
  };
  /// The last change of any channel; empty: there is none to undo.
  std::optional<Write> last_write() const;
  Result<void> add_write(const Write& write);
  /// Records that the last one was undone: its step and later ones must be done again.
  Result<void> remove_last_write();

 private:
  SetupRecord(std::string path, std::string channel, nlohmann::ordered_json document)
      : path_(std::move(path)), channel_(std::move(channel)), document_(std::move(document)) {}

  static Result<nlohmann::ordered_json> read(const std::string& path, const std::string& channel);
  /// Reads the file again: a step may have written to it as well.
  Result<void> read_again();
  /// An empty record removes the file.
  Result<void> write();
  void store(const std::string& name, const std::string& step, const nlohmann::ordered_json& found);
  void remove_later_steps(nlohmann::ordered_json& channel, const std::string& step);

  bool is_counted(const std::string& step) const;
  bool contains(const std::string& step) const;

  std::string path_;
  std::string channel_;
  std::string discounted_from_;  ///< empty: everything counts
  nlohmann::ordered_json document_;
};

}  // namespace supercoil::operating
