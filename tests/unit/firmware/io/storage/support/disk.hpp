// A disk that keeps what programs see separate from what survives a power cut.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

namespace supercoil::test {

/// Names and contents, as after a boot: nothing is in flight.
using Content = std::map<std::string, std::string>;

struct Inode {
  std::string seen;
  std::string synced;
  bool dirty = false;  ///< seen may not be on the disk yet
};
using InodePtr = std::shared_ptr<Inode>;

/// A change of a folder's names that is not on the disk yet. In a rename the new name and the loss
/// of the old one may arrive separately, but the file is never without a name.
struct NameChange {
  std::string gains;  ///< this name now refers to the inode; empty: none
  InodePtr inode;
  std::string loses;  ///< this name is removed; empty: none
};

/// Simulates worse power cuts than any file system allows: every subset of the changes of names
/// since the folder was synced, in any order, and for each unsynced file nothing, a part, zeros,
/// garbage, or all.
class Disk {
 public:
  explicit Disk(const Content& content = {});

  std::map<std::string, InodePtr> names;  ///< what programs see

  void change(NameChange change);
  void sync_names();
  /// What programs see now.
  Content seen() const;
  /// Everything that a power cut may leave, without duplicates.
  std::vector<Content> survivors() const;

 private:
  std::map<std::string, InodePtr> synced_names_;
  std::vector<NameChange> pending_;
};

}  // namespace supercoil::test
