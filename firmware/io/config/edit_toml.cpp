#include "config/edit_toml.hpp"

#include <sstream>

#include <toml++/toml.h>

namespace supercoil::config {

namespace {

/// toml++ counts code points; the text is in bytes.
std::size_t offset_of(const std::string& text, const toml::source_position& at) {
  std::size_t offset = 0;
  for (toml::source_index line = 1; line < at.line; ++line)
    offset = text.find('\n', offset) + 1;
  const auto continues = [&](std::size_t i) {
    return i < text.size() && (static_cast<unsigned char>(text[i]) & 0xC0U) == 0x80U;
  };
  for (toml::source_index column = 1; column < at.column; ++column) {
    ++offset;
    while (continues(offset))
      ++offset;
  }
  return offset;
}

std::size_t begin_of_line(const std::string& text, std::size_t offset) {
  const std::size_t end = offset == 0 ? std::string::npos : text.rfind('\n', offset - 1);
  return end == std::string::npos ? 0 : end + 1;
}

std::size_t begin_of_next_line(const std::string& text, std::size_t offset) {
  const std::size_t end = text.find('\n', offset);
  return end == std::string::npos ? text.size() : end + 1;
}

/// Inserts a line after the line at this offset.
std::string inserted_behind(std::string text, std::size_t offset, const std::string& line) {
  const std::size_t at = begin_of_next_line(text, offset);
  const bool ended = at > 0 && text[at - 1] == '\n';
  return text.insert(at, (ended ? "" : "\n") + line + "\n");
}

std::string into_inline_table(std::string text, const toml::table& table,
                              const std::string& entry) {
  // The table's end is behind the brace; spaces before the brace stay there.
  std::size_t brace = offset_of(text, table.source().end);
  while (brace > 0 && text[brace] != '}')
    --brace;
  std::size_t at = brace;
  while (at > 0 && text[at - 1] == ' ')
    --at;
  return text.insert(at, (table.empty() ? " " : ", ") + entry);
}

std::string added(const std::string& text, const toml::table& channel, const std::string& path,
                  const std::string& literal) {
  const std::size_t dot = path.find('.');
  const toml::table* table =
      dot == std::string::npos ? nullptr : channel[path.substr(0, dot)].as_table();
  const std::string whole = path + " = " + literal;
  if (table == nullptr)
    return inserted_behind(text, offset_of(text, channel.source().begin), whole);
  const std::string entry = path.substr(dot + 1) + " = " + literal;
  if (table->is_inline()) return into_inline_table(text, *table, entry);
  const std::size_t at = offset_of(text, table->source().begin);
  // A table whose keys are dotted has no header.
  const std::size_t begin = text.find_first_not_of(" \t", begin_of_line(text, at));
  return inserted_behind(text, at, text[begin] == '[' ? entry : whole);
}

std::string replaced(std::string text, const toml::source_region& where,
                     const std::string& literal) {
  const std::size_t begin = offset_of(text, where.begin);
  return text.replace(begin, offset_of(text, where.end) - begin, literal);
}

std::string shown(const toml::table& table) {
  std::ostringstream text;
  text << table;
  return text.str();
}

}  // namespace

Result<std::string> with_value(const std::string& text, const std::string& kind, std::size_t place,
                               const std::string& path, const std::string& literal) try {
  const auto refused = [&](const std::string& why) {
    return failure(path + " = " + literal + ": " + why);
  };
  toml::table before = toml::parse(text);
  toml::array* tables = before[kind].as_array();
  if (tables == nullptr || place >= tables->size())
    return refused("there is no " + kind + " " + std::to_string(place + 1));
  const toml::table* table = tables->get(place)->as_table();
  const auto node = table->at_path(path);
  std::string changed =
      node ? replaced(text, node.node()->source(), literal) : added(text, *table, path, literal);
  toml::table after = toml::parse(changed);
  // Whatever form the author chose, this key and no other may have changed.
  const toml::table value = toml::parse("value = " + literal);
  toml::table expected = before;
  toml::table* inner = expected[kind].as_array()->get(place)->as_table();
  const std::size_t dot = path.find('.');
  if (dot != std::string::npos)
    inner = inner->insert(path.substr(0, dot), toml::table{}).first->second.as_table();
  inner->insert_or_assign(path.substr(dot == std::string::npos ? 0 : dot + 1), *value.get("value"));
  if (shown(after) != shown(expected)) return refused("the file's form does not allow it");
  return changed;
} catch (const toml::parse_error& error) {
  return failure(path + " = " + literal + ": " + std::string(error.description()));
}

}  // namespace supercoil::config
