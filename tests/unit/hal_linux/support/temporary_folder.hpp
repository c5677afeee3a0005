// A real directory tree that stands in for /sys or /dev.
#pragma once

#include <string>
#include <string_view>

namespace supercoil::test {

/// Removed with everything in it.
class TemporaryFolder {
 public:
  TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  ~TemporaryFolder();

  const std::string& path() const { return path_; }
  /// "name" in this folder.
  std::string operator/(std::string_view name) const { return path_ + "/" + std::string(name); }

  /// Makes a file and its parent folders; replaces the previous content.
  void write(std::string_view name, std::string_view content) const;
  std::string read(std::string_view name) const;
  void make_folder(std::string_view name) const;
  void make_pipe(std::string_view name) const;
  /// A link `name` to `target` in the same folder.
  void link(std::string_view name, std::string_view target) const;
  void remove(std::string_view name) const;

 private:
  std::string path_;
};

}  // namespace supercoil::test
