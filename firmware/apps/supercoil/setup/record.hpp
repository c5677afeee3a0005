// What setup has done so far, beside the board's file: it goes on after a power cut.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include <nlohmann/json.hpp>

#include "supercoil/hal/error.hpp"

namespace supercoil::operating {

/// Of one channel. "board.toml.setup.json" has one object for each channel, and in it one for each
/// step that is done: what the step found. "writes" has each change of the board's file, the last
/// one at the end, and "answers" by channel what a person answered.
class SetupRecord {
 public:
  /// An absent file is an empty record. The error says why a file is none; nothing is lost then.
  static Result<SetupRecord> open(const std::string& config, int channel);
  static std::string path_of(const std::string& config) { return config + ".setup.json"; }

  /// Where the file is.
  const std::string& path() const { return path_; }

  bool has(const std::string& step) const;
  /// A step behind this one is done.
  bool is_past(const std::string& step) const;
  /// What a step found; null: it was not done.
  nlohmann::ordered_json found(const std::string& step) const;
  /// From this step on nothing counts as done, though it stays in the file until it is done anew:
  /// the board that it was done with may come back.
  void discount_from(const std::string& step) { discounted_from_ = step; }
  /// In what a step found: the same of a joint's other muscle, which was measured with it, and its
  /// "channel".
  static constexpr const char* antagonist_key = "antagonist";
  /// Written at once, whole; what was found of an antagonist goes to its channel. What follows the
  /// step is to be done anew.
  Result<void> add(const std::string& step, const nlohmann::ordered_json& found);

  /// What a person answered to describe, by a question's key, until it is answered otherwise;
  /// describe offers it when it asks again.
  std::optional<double> answer(const std::string& key) const;
  Result<void> add_answer(const std::string& key, double value);

  /// One change of the board's file.
  struct Write {
    int channel = 1;
    std::string step;
    std::string before;       ///< the file that has the text before it
    std::uint32_t crc32 = 0;  ///< of the text after it
  };
  /// Of all channels; empty: there is none to take back.
  std::optional<Write> last_write() const;
  Result<void> add_write(const Write& write);
  /// The last one was taken back: its step and what follows it are to be done anew.
  Result<void> take_back();

 private:
  SetupRecord(std::string path, std::string channel, nlohmann::ordered_json document)
      : path_(std::move(path)), channel_(std::move(channel)), document_(std::move(document)) {}

  static Result<nlohmann::ordered_json> read(const std::string& path, const std::string& channel);
  /// What the file has by now: a step may have written to it as well.
  Result<void> read_again();
  /// Without anything to remember there is no file.
  Result<void> write();
  void put(const std::string& name, const std::string& step, const nlohmann::ordered_json& found);
  void forget_after(nlohmann::ordered_json& channel, const std::string& step);

  bool counts(const std::string& step) const;
  bool contains(const std::string& step) const;

  std::string path_;
  std::string channel_;
  std::string discounted_from_;  ///< empty: everything counts
  nlohmann::ordered_json document_;
};

}  // namespace supercoil::operating
