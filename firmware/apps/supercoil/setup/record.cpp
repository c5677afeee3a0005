#include "apps/supercoil/setup/record.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "apps/supercoil/setup/steps.hpp"
#include "apps/supercoil/user_file.hpp"

namespace supercoil::operating {

namespace {

using Json = nlohmann::ordered_json;

constexpr const char* writes_key = "writes";
constexpr const char* answers_key = "answers";

std::string name_of(int channel) {
  return "channel-" + std::to_string(channel);
}

bool is_write(const Json& entry) {
  const auto is = [&](const char* key, auto of_type) {
    return entry.contains(key) && of_type(entry[key]);
  };
  const auto number = [](const Json& value) { return value.is_number_integer(); };
  const auto text = [](const Json& value) { return value.is_string(); };
  return is("channel", number) && is("step", text) && is("before", text) && is("crc32", number);
}

bool is_in_order(const Json& document, const std::string& channel) {
  if (!document.is_object()) return false;
  if (document.contains(channel) && !document[channel].is_object()) return false;
  if (document.contains(answers_key) &&
      !document[answers_key].value(channel, Json::object()).is_object())
    return false;
  if (!document.contains(writes_key)) return true;
  return document[writes_key].is_array() && std::ranges::all_of(document[writes_key], is_write);
}

}  // namespace

Result<SetupRecord> SetupRecord::open(const std::string& config, int channel) {
  const std::string path = path_of(config);
  const std::string name = name_of(channel);
  auto document = read(path, name);
  if (!document) return tl::unexpected(document.error());
  return SetupRecord(path, name, std::move(*document));
}

Result<Json> SetupRecord::read(const std::string& path, const std::string& channel) {
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored)) return Json::object();
  std::ifstream file(path);
  Json document = Json::parse(std::istreambuf_iterator<char>(file), {}, nullptr, false);
  if (is_in_order(document, channel)) return document;
  return failure(path + ": is damaged: delete it, and setup starts again with its first step");
}

bool SetupRecord::has(const std::string& step) const {
  return is_counted(step) && contains(step);
}

bool SetupRecord::contains(const std::string& step) const {
  return document_.contains(channel_) && document_[channel_].contains(step);
}

bool SetupRecord::is_counted(const std::string& step) const {
  for (const SetupStep& known : setup_steps) {
    if (known.name == discounted_from_) return false;
    if (known.name == step) break;
  }
  return true;
}

bool SetupRecord::has_later_step(const std::string& step) const {
  if (!is_counted(step)) return false;
  bool after = false;
  for (const SetupStep& known : setup_steps) {
    if (after && !known.of_machine && contains(std::string(known.name))) return true;
    after = after || known.name == step;
  }
  return false;
}

Json SetupRecord::found(const std::string& step) const {
  return has(step) ? document_[channel_][step] : Json();
}

Result<void> SetupRecord::add(const std::string& step, const Json& found) {
  if (auto read = read_again(); !read) return read;
  Json own = found;
  if (const auto other = own.find(antagonist_key); other != own.end()) {
    store(name_of(other->at("channel").get<int>()), step, *other);
    own.erase(other);
  }
  store(channel_, step, own);
  return write();
}

std::optional<double> SetupRecord::answer(const std::string& key) const {
  const auto place =
      Json::json_pointer("/" + std::string(answers_key) + "/" + channel_ + "/" + key);
  if (!document_.contains(place) || !document_[place].is_number()) return std::nullopt;
  return document_[place].get<double>();
}

Result<void> SetupRecord::add_answer(const std::string& key, double value) {
  if (auto read = read_again(); !read) return read;
  document_[answers_key][channel_][key] = value;
  return write();
}

std::optional<SetupRecord::Write> SetupRecord::last_write() const {
  const auto writes = document_.find(writes_key);
  if (writes == document_.end() || writes->empty()) return std::nullopt;
  const Json& last = writes->back();
  return Write{last["channel"].get<int>(), last["step"].get<std::string>(),
               last["before"].get<std::string>(), last["crc32"].get<std::uint32_t>()};
}

Result<void> SetupRecord::add_write(const Write& w) {
  if (auto read = read_again(); !read) return read;
  document_[writes_key].push_back(
      {{"channel", w.channel}, {"step", w.step}, {"before", w.before}, {"crc32", w.crc32}});
  return write();
}

Result<void> SetupRecord::remove_last_write() {
  const auto last = last_write();
  if (!last) return {};
  Json& writes = document_[writes_key];
  writes.erase(writes.size() - 1);
  if (writes.empty()) document_.erase(writes_key);
  if (const auto channel = document_.find(name_of(last->channel)); channel != document_.end()) {
    channel->erase(last->step);
    remove_later_steps(*channel, last->step);
    if (channel->empty()) document_.erase(channel);
  }
  return write();
}

Result<void> SetupRecord::read_again() {
  auto now = read(path_, channel_);
  if (!now) return tl::unexpected(now.error());
  document_ = std::move(*now);
  return {};
}

Result<void> SetupRecord::write() {
  // schema_version is the last key; alone it is not worth a file.
  document_.erase("schema_version");
  if (document_.empty()) {
    std::error_code error;
    std::filesystem::remove(path_, error);
    if (!error) return {};
    return failed_call(path_, error.value());
  }
  document_["schema_version"] = 1;
  return write_file(path_, document_.dump(2) + "\n");
}

void SetupRecord::store(const std::string& name, const std::string& step, const Json& found) {
  Json& channel = document_[name];
  if (channel.is_null()) channel = Json::object();
  remove_later_steps(channel, step);
  channel[step] = found;
}

void SetupRecord::remove_later_steps(Json& channel, const std::string& step) {
  bool after = false;
  for (const SetupStep& known : setup_steps) {
    if (after) channel.erase(std::string(known.name));
    after = after || known.name == step;
  }
}

}  // namespace supercoil::operating
