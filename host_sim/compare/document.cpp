#include "compare/document.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <filesystem>
#include <string_view>
#include <utility>

#include "compare/catalogue.hpp"
#include "config/toml_file.hpp"

namespace supercoil::host_sim::compare {

namespace {

supercoil::Result<Document> find(const std::string& name, const char* what,
                                 const std::vector<BuiltinScenario>& entries) {
  if (name.find_first_of("./") != std::string::npos) {
    config::Diagnostics diagnostics(name);
    std::string text = config::read_text(name, diagnostics);
    if (!diagnostics.empty()) return failure(config::to_text(diagnostics.problems()));
    const std::string stem = std::filesystem::path(name).stem().string();
    if (stem.find_first_of(",\"\n|") == std::string::npos) return Document{stem, std::move(text)};
    return failure(name + ": the file name must not contain a comma, quote, bar or line break\n");
  }
  std::string known;
  for (const BuiltinScenario& entry : entries) {
    if (entry.name == name) return Document{name, std::string(entry.text)};
    known += (known.empty() ? "" : ", ") + std::string(entry.name);
  }
  return failure(std::string(what) + " " + name + ": must be a .toml file or one of: " + known +
                 "\n");
}

/// A controller's file must not also choose the muscle or what is asked of it: that would replace
/// the disturbance's, while the table would still name the disturbance.
supercoil::Result<Document> find_controller(const std::string& name) {
  constexpr std::array<std::string_view, 3> allowed{"controller", "estimator", "reference_model"};
  auto document = find(name, "--controllers", controllers());
  if (!document) return document;
  config::Diagnostics diagnostics(name);
  for (const auto& [key, node] : config::parse(document->text, diagnostics)) {
    if (std::find(allowed.begin(), allowed.end(), key.str()) != allowed.end()) continue;
    diagnostics.add(static_cast<int>(key.source().begin.line), std::string(key.str()),
                    "a controller's file may have only [controller], [estimator] and "
                    "[reference_model]; this belongs in a file for --disturbances");
  }
  if (diagnostics.empty()) return document;
  return failure(config::to_text(diagnostics.problems()));
}

/// NAME or NAME:steps.
supercoil::Result<Document> find_disturbance_now(const std::string& name) {
  constexpr std::string_view suffix = ":steps";
  const bool steps = name.ends_with(suffix);
  auto document = find(steps ? name.substr(0, name.size() - suffix.size()) : name, "--disturbances",
                       disturbances());
  if (document && steps) {
    document->name += suffix;
    document->steps = true;
  }
  return document;
}

/// NAME+SECONDS; a file's name and its folders may also contain a +.
supercoil::Result<Document> find_disturbance(const std::string& name) {
  constexpr std::string_view extension = ".toml";
  const std::size_t file_end = name.rfind(extension);
  const std::size_t plus =
      name.find('+', file_end == std::string::npos ? 0 : file_end + extension.size());
  if (plus == std::string::npos) return find_disturbance_now(name);
  double later_s = 0.0;
  const char* end = name.data() + name.size();
  const auto read = std::from_chars(name.data() + plus + 1, end, later_s);
  constexpr double latest_s = 1e5;
  if (read.ec != std::errc{} || read.ptr != end || !(later_s >= 0.0 && later_s <= latest_s)) {
    return failure("--disturbances " + name +
                   ": after + must come a time in seconds, 0 to 100000\n");
  }
  auto document = find_disturbance_now(name.substr(0, plus));
  if (document) {
    document->name += name.substr(plus);
    document->later_s = later_s;
  }
  return document;
}

template <class Find>
Documents find_all(const std::vector<std::string>& names, Find find_one) {
  std::vector<Document> documents;
  std::string problems;
  for (const std::string& name : names) {
    auto document = find_one(name);
    if (!document) {
      problems += document.error().text();
      continue;
    }
    const bool twice = std::any_of(documents.begin(), documents.end(), [&](const Document& other) {
      return other.name == document->name;
    });
    if (twice) problems += name + ": " + document->name + " is given twice\n";
    documents.push_back(std::move(*document));
  }
  if (!problems.empty()) return failure(problems);
  return documents;
}

}  // namespace

Documents find_controllers(const std::vector<std::string>& names) {
  return find_all(names, find_controller);
}

Documents find_disturbances(const std::vector<std::string>& names) {
  return find_all(names, find_disturbance);
}

}  // namespace supercoil::host_sim::compare
