// An MCAP file (mcap.dev, version 0 of the format): messages of several channels in order of time,
// with the summary at the end that some readers (PlotJuggler 3) require. Chunks, compression, an
// index of messages and checksums are omitted, as the format allows.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "supercoil/hal/error.hpp"

#include "recorder/recording.hpp"

namespace supercoil::operating::mcap {

using Written = Result<void>;
using Entries = std::vector<std::pair<std::string, std::string>>;

/// Adds the unit to a property of a JSON schema; an empty one adds nothing.
void describe_unit(nlohmann::ordered_json& property, std::string_view unit);

class Writer {
 public:
  /// Begins the file. write is called with pieces of some 64 KiB.
  explicit Writer(recorder::Sink write);

  /// A channel of JSON objects; properties: of its JSON schema. Returns its number.
  std::uint16_t add_channel(std::string_view topic, std::string_view schema_name,
                            const nlohmann::ordered_json& properties);
  /// json: an object of the channel's schema. After an error all calls return that first error.
  Written add_message(std::uint16_t channel, std::uint64_t time_ns, std::string_view json);
  void add_metadata(std::string_view name, const Entries& entries);
  /// Ends the file.
  Written finish();

 private:
  /// Content of the record of statistics.
  std::string counted() const;
  /// Bytes of the file so far.
  std::uint64_t position() const;
  Written flush();

  recorder::Sink write_;
  Written written_;
  std::string part_;                                   ///< bytes of the file not written yet
  std::string schemas_, channels_, metadata_indexes_;  ///< records of the summary
  std::uint64_t flushed_bytes_ = 0;
  std::uint64_t messages_ = 0;
  std::uint64_t first_ns_ = 0, last_ns_ = 0;  ///< of the messages
  std::uint32_t metadata_ = 0;                ///< number of records
  std::vector<std::uint32_t> messages_of_;    ///< per channel
};

}  // namespace supercoil::operating::mcap
