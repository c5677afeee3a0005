#include "unit/firmware/io/storage/support/disk.hpp"

#include <set>
#include <utility>

namespace supercoil::test {

namespace {

using Names = std::map<std::string, InodePtr>;

/// The ways in which a change may have reached the disk.
std::vector<void (*)(Names&, const NameChange&)> outcomes(const NameChange& change) {
  const auto none = [](Names&, const NameChange&) {};
  const auto gain = [](Names& names, const NameChange& c) { names[c.gains] = c.inode; };
  const auto lose = [](Names& names, const NameChange& c) { names.erase(c.loses); };
  const auto both = [](Names& names, const NameChange& c) {
    names[c.gains] = c.inode;
    names.erase(c.loses);
  };
  if (change.gains.empty()) return {none, lose};
  if (change.loses.empty()) return {none, gain};
  return {none, gain, both};
}

/// What may be read from a file after a power cut.
std::vector<std::string> contents(const Inode& inode) {
  if (!inode.dirty) return {inode.seen};
  const std::string& text = inode.seen;
  std::string garbage = text;
  for (std::size_t i = garbage.size() / 3; i < garbage.size(); i += 7)
    garbage[i] = static_cast<char>(garbage[i] ^ static_cast<char>(1 + i % 127));
  return {inode.synced, text,       text.substr(0, text.size() / 2), std::string(text.size(), '\0'),
          garbage,      text + text};
}

/// Every way to give each named file one of its possible contents.
void add_contents(const Names& names, std::set<Content>& all) {
  std::vector<Content> found{{}};
  for (const auto& [name, inode] : names) {
    std::vector<Content> longer;
    for (const Content& content : found) {
      for (std::string& text : contents(*inode)) {
        Content next = content;
        next[name] = std::move(text);
        longer.push_back(std::move(next));
      }
    }
    found = std::move(longer);
  }
  all.insert(found.begin(), found.end());
}

}  // namespace

Disk::Disk(const Content& content) {
  for (const auto& [name, text] : content)
    names[name] = std::make_shared<Inode>(Inode{text, text, false});
  synced_names_ = names;
}

void Disk::change(NameChange change) {
  if (!change.gains.empty()) names[change.gains] = change.inode;
  if (!change.loses.empty()) names.erase(change.loses);
  pending_.push_back(std::move(change));
}

void Disk::sync_names() {
  synced_names_ = names;
  pending_.clear();
}

Content Disk::seen() const {
  Content content;
  for (const auto& [name, inode] : names)
    content[name] = inode->seen;
  return content;
}

std::vector<Content> Disk::survivors() const {
  std::vector<Names> possible{synced_names_};
  for (const NameChange& change : pending_) {
    std::vector<Names> next;
    for (const Names& before : possible) {
      for (const auto outcome : outcomes(change)) {
        Names after = before;
        outcome(after, change);
        next.push_back(std::move(after));
      }
    }
    // Different ways to the same names are followed only once.
    const std::set<Names> different(next.begin(), next.end());
    possible.assign(different.begin(), different.end());
  }
  std::set<Content> all;
  for (const Names& found : possible)
    add_contents(found, all);
  return {all.begin(), all.end()};
}

}  // namespace supercoil::test
