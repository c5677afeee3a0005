#include "apps/supercoil/setup/record.hpp"

#include <filesystem>
#include <fstream>
#include <iterator>

#include "apps/supercoil/setup/steps.hpp"
#include "apps/supercoil/user_file.hpp"

namespace supercoil::operating {

namespace {

using Json = nlohmann::ordered_json;

std::string name_of(int channel) {
  return "channel-" + std::to_string(channel);
}

}  // namespace

tl::expected<SetupRecord, std::string> SetupRecord::open(const std::string& config, int channel) {
  const std::string path = path_of(config);
  const std::string name = name_of(channel);
  Json document = Json::object();
  std::error_code ignored;
  if (std::filesystem::exists(path, ignored)) {
    std::ifstream file(path);
    document = Json::parse(std::istreambuf_iterator<char>(file), {}, nullptr, false);
    if (!document.is_object() || (document.contains(name) && !document[name].is_object())) {
      return tl::unexpected(path + ": is damaged: delete it, and setup begins with its first step");
    }
  }
  return SetupRecord(path, name, std::move(document));
}

bool SetupRecord::has(const std::string& step) const {
  return document_.contains(channel_) && document_[channel_].contains(step);
}

bool SetupRecord::is_past(const std::string& step) const {
  bool after = false;
  for (const SetupStep& known : setup_steps) {
    if (after && has(std::string(known.name))) return true;
    after = after || known.name == step;
  }
  return false;
}

Json SetupRecord::found(const std::string& step) const {
  return has(step) ? document_[channel_][step] : Json();
}

tl::expected<void, std::string> SetupRecord::add(const std::string& step, const Json& found) {
  document_["schema_version"] = 1;
  Json own = found;
  if (const auto other = own.find(antagonist_key); other != own.end()) {
    put(name_of(other->at("channel").get<int>()), step, *other);
    own.erase(other);
  }
  put(channel_, step, own);
  return write_whole(path_, document_.dump(2) + "\n");
}

void SetupRecord::put(const std::string& name, const std::string& step, const Json& found) {
  Json& channel = document_[name];
  if (channel.is_null()) channel = Json::object();
  bool after = false;
  for (const SetupStep& known : setup_steps) {
    if (after) channel.erase(std::string(known.name));
    after = after || known.name == step;
  }
  channel[step] = found;
}

}  // namespace supercoil::operating
