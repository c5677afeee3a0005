// Files of the operating system.
#pragma once

#include "storage/files.hpp"

namespace supercoil::storage {

/// Files of a POSIX system. A signal interrupts no call.
class PosixFiles final : public Files {
 public:
  Result<std::string> read(const std::string& path, std::size_t limit_bytes) override;
  Result<NewFile> create(const std::string& path) override;
  Result<void> write(const NewFile& file, std::string_view content) override;
  Result<void> sync(const NewFile& file) override;
  Result<void> close(const NewFile& file) override;
  Result<void> rename(const std::string& from, const std::string& to) override;
  Result<void> link(const std::string& from, const std::string& to) override;
  Result<void> unlink(const std::string& path) override;
  Result<void> sync_folder(const std::string& path) override;
  Result<void> check_folder(const std::string& path) override;
};

}  // namespace supercoil::storage
