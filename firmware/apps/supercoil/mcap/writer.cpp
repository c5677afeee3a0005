#include "apps/supercoil/mcap/writer.hpp"

#include <algorithm>

#include "text/program_version.hpp"

namespace supercoil::operating::mcap {

namespace {

constexpr std::string_view magic = "\x89MCAP0\r\n";
constexpr std::size_t part_bytes = 1U << 16U;

enum Opcode : std::uint8_t {
  header = 0x01,
  footer = 0x02,
  schema = 0x03,
  channel_record = 0x04,
  message = 0x05,
  statistics = 0x0b,
  metadata = 0x0c,
  metadata_index = 0x0d,
  data_end = 0x0f,
};

/// Little-endian.
template <class Unsigned>
void put(std::string& out, Unsigned value) {
  for (std::size_t i = 0; i < sizeof value; ++i)
    out += static_cast<char>(static_cast<std::uint64_t>(value) >> (8U * i) & 0xffU);
}

void put_text(std::string& out, std::string_view text) {
  put(out, static_cast<std::uint32_t>(text.size()));
  out += text;
}

void put_record(std::string& out, std::uint8_t opcode, std::string_view content) {
  put(out, opcode);
  put(out, static_cast<std::uint64_t>(content.size()));
  out += content;
}

void put_entries(std::string& out, const Entries& entries) {
  std::string all;
  for (const auto& [key, value] : entries) {
    put_text(all, key);
    put_text(all, value);
  }
  put_text(out, all);
}

}  // namespace

void describe_unit(nlohmann::ordered_json& property, std::string_view unit) {
  if (!unit.empty()) property["description"] = "in " + std::string(unit);
}

Writer::Writer(recorder::Sink write) : write_(std::move(write)), part_(magic) {
  std::string content;
  put_text(content, "");
  put_text(content, "supercoil " + std::string(program_version()));
  put_record(part_, header, content);
}

std::uint16_t Writer::add_channel(std::string_view topic, std::string_view schema_name,
                                  const nlohmann::ordered_json& properties) {
  messages_of_.push_back(0);
  // Each channel has its own schema; 0 would mean no schema.
  const auto number = static_cast<std::uint16_t>(messages_of_.size());
  std::string of_schema;
  put(of_schema, number);
  put_text(of_schema, schema_name);
  put_text(of_schema, "jsonschema");
  put_text(of_schema,
           nlohmann::ordered_json{{"type", "object"}, {"properties", properties}}.dump());
  put_record(part_, schema, of_schema);
  put_record(schemas_, schema, of_schema);
  std::string of_channel;
  put(of_channel, number);
  put(of_channel, number);
  put_text(of_channel, topic);
  put_text(of_channel, "json");
  put_entries(of_channel, {});
  put_record(part_, channel_record, of_channel);
  put_record(channels_, channel_record, of_channel);
  return number;
}

Written Writer::add_message(std::uint16_t channel, std::uint64_t time_ns, std::string_view json) {
  std::string content;
  put(content, channel);
  put(content, messages_of_[channel - 1U]++);
  put(content, time_ns);
  put(content, time_ns);
  content += json;
  first_ns_ = messages_++ == 0 ? time_ns : std::min(first_ns_, time_ns);
  last_ns_ = std::max(last_ns_, time_ns);
  put_record(part_, message, content);
  return part_.size() < part_bytes ? written_ : flush();
}

void Writer::add_metadata(std::string_view name, const Entries& entries) {
  std::string content;
  put_text(content, name);
  put_entries(content, entries);
  const std::uint64_t before = position();
  std::string index;
  put(index, before);
  put_record(part_, metadata, content);
  put(index, position() - before);
  put_text(index, name);
  put_record(metadata_indexes_, metadata_index, index);
  ++metadata_;
}

Written Writer::finish() {
  std::string no_checksum;
  put(no_checksum, std::uint32_t{0});
  put_record(part_, data_end, no_checksum);
  std::string end;
  put(end, position());
  put(end, std::uint64_t{0});  // no summary offset section
  put(end, std::uint32_t{0});
  part_.append(schemas_).append(channels_).append(metadata_indexes_);
  put_record(part_, statistics, counted());
  put_record(part_, footer, end);
  part_ += magic;
  return flush();
}

std::string Writer::counted() const {
  const auto channels = static_cast<std::uint16_t>(messages_of_.size());
  std::string out;
  put(out, messages_);
  put(out, channels);  // schemas
  put(out, std::uint32_t{channels});
  put(out, std::uint32_t{0});  // attachments
  put(out, metadata_);
  put(out, std::uint32_t{0});  // chunks
  put(out, first_ns_);
  put(out, last_ns_);
  std::string by_channel;
  for (std::uint16_t number = 1; number <= channels; ++number) {
    put(by_channel, number);
    put(by_channel, std::uint64_t{messages_of_[number - 1U]});
  }
  put_text(out, by_channel);
  return out;
}

std::uint64_t Writer::position() const {
  return flushed_bytes_ + part_.size();
}

Written Writer::flush() {
  if (written_) written_ = write_(part_);
  flushed_bytes_ += part_.size();
  part_.clear();
  return written_;
}

}  // namespace supercoil::operating::mcap
