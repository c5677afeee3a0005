// Tables in tables, and keys that are left over when everything has been read.
#include <algorithm>

#include "config/renamed_keys.hpp"
#include "config/section.hpp"
#include "text/nearest.hpp"

namespace supercoil::config {

Section Section::over(const toml::table* under, std::string under_path) const {
  Section both = *this;
  both.under_ = under;
  both.under_path_ = std::move(under_path);
  return both;
}

Section Section::section(std::string_view key) {
  add_known(key);
  const auto table_in = [&](const toml::table* outer) -> const toml::table* {
    const toml::node* node = outer == nullptr ? nullptr : outer->get(key);
    return node == nullptr ? nullptr : node->as_table();
  };
  const toml::node* node = lookup(key).node;
  if (node != nullptr && !node->is_table()) {
    wrong(key, "must be a table: [" + full_key(key) + "]");
  }
  const std::string own = path_.empty() ? std::string(key) : path_ + "." + std::string(key);
  const Section inner(table_in(table_), own, *diagnostics_, path_.empty() ? 0 : line());
  return inner.over(table_in(under_), under_path_ + "." + std::string(key));
}

std::vector<Section> Section::sections(std::string_view key) {
  const toml::node* node = find(key);
  std::vector<Section> found;
  if (node == nullptr) return found;
  if (const toml::table* one = node->as_table()) {
    found.emplace_back(one, full_key(key), *diagnostics_);
  } else if (node->is_array_of_tables()) {
    for (const toml::node& element : *node->as_array()) {
      const std::string place = "[" + std::to_string(found.size() + 1) + "]";
      found.emplace_back(element.as_table(), full_key(key) + place, *diagnostics_);
    }
  } else {
    wrong(key, "must be written as [[" + full_key(key) + "]], one for each");
  }
  return found;
}

std::vector<std::string> Section::refuse_unknown(const toml::table* table,
                                                 const std::string& path) {
  std::vector<std::string> intended;
  if (table == nullptr) return intended;
  for (const auto& [key, node] : *table) {
    const std::string name(key.str());
    if (std::find(known_.begin(), known_.end(), name) != known_.end()) continue;
    if (const std::string renamed = renamed_message(path, name); !renamed.empty()) {
      wrong(name, renamed);
      intended.emplace_back(renamed_to(path, name));
      continue;
    }
    std::string message = "is not a key of ";
    message += path.empty() ? "this file" : "[" + path + "]";
    if (!default_kind_.empty()) message += " of kind \"" + default_kind_ + "\" (its default)";
    wrong(name, message + "; " + suggestion_or_all(name, known_, "its keys are"));
    intended.push_back(nearest_name(name, known_).name);
  }
  return intended;
}

void Section::refuse_missing(const std::vector<std::string>& intended) {
  std::string keys;
  for (const Missing& missing : missing_) {
    // Reported already, under its misspelt name.
    if (std::find(intended.begin(), intended.end(), missing.key) != intended.end()) continue;
    if (given()) {
      diagnostics_->add(line(), path_.empty() ? missing.key : path_ + "." + missing.key,
                        "is missing: it must be " + missing.rule);
    } else {
      keys += (keys.empty() ? "" : ", ") + missing.key;
    }
  }
  if (!keys.empty()) diagnostics_->add(line(), path_, "is missing; it needs " + keys);
}

void Section::finish() {
  std::vector<std::string> intended = refuse_unknown(table_, path_);
  const std::vector<std::string> below = refuse_unknown(under_, under_path_);
  intended.insert(intended.end(), below.begin(), below.end());
  refuse_missing(intended);
}

}  // namespace supercoil::config
