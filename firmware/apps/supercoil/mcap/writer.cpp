#include "apps/supercoil/mcap/writer.hpp"

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
  metadata = 0x0c,
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
  add_record(header, content);
}

std::uint16_t Writer::add_channel(std::string_view topic, std::string_view schema_name,
                                  const nlohmann::ordered_json& properties) {
  messages_.push_back(0);
  // A schema of each; 0 would be none.
  const auto number = static_cast<std::uint16_t>(messages_.size());
  std::string of_schema;
  put(of_schema, number);
  put_text(of_schema, schema_name);
  put_text(of_schema, "jsonschema");
  put_text(of_schema,
           nlohmann::ordered_json{{"type", "object"}, {"properties", properties}}.dump());
  add_record(schema, of_schema);
  std::string of_channel;
  put(of_channel, number);
  put(of_channel, number);
  put_text(of_channel, topic);
  put_text(of_channel, "json");
  put_entries(of_channel, {});
  add_record(channel_record, of_channel);
  return number;
}

Written Writer::add_message(std::uint16_t channel, std::uint64_t time_ns, std::string_view json) {
  std::string content;
  put(content, channel);
  put(content, messages_[channel - 1U]++);
  put(content, time_ns);
  put(content, time_ns);
  content += json;
  add_record(message, content);
  return part_.size() < part_bytes ? written_ : flush();
}

void Writer::add_metadata(std::string_view name, const Entries& entries) {
  std::string content;
  put_text(content, name);
  put_entries(content, entries);
  add_record(metadata, content);
}

Written Writer::finish() {
  std::string checksum;
  put(checksum, std::uint32_t{0});
  add_record(data_end, checksum);
  // No summary, and where it would be.
  std::string nowhere;
  put(nowhere, std::uint64_t{0});
  put(nowhere, std::uint64_t{0});
  put(nowhere, std::uint32_t{0});
  add_record(footer, nowhere);
  part_ += magic;
  return flush();
}

void Writer::add_record(std::uint8_t opcode, std::string_view content) {
  put(part_, opcode);
  put(part_, static_cast<std::uint64_t>(content.size()));
  part_ += content;
}

Written Writer::flush() {
  if (written_) written_ = write_(part_);
  part_.clear();
  return written_;
}

}  // namespace supercoil::operating::mcap
