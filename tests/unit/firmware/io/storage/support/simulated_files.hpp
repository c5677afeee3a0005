// Files on a simulated disk; any call can fail, or the power can go at it.
#pragma once

#include <optional>
#include <string>

#include "storage/files.hpp"
#include "unit/firmware/io/storage/support/disk.hpp"

namespace supercoil::test {

/// What happens at one of the calls, which are counted from 0.
struct Mishap {
  int at_call = -1;  ///< never
  /// An error number; 0: the power goes at this call and nothing reaches the disk any more.
  int error = 0;
  bool for_good = false;      ///< every later call fails as well
  bool takes_effect = false;  ///< the call takes effect all the same; of a write, its first half
};

class SimulatedFiles final : public storage::Files {
 public:
  explicit SimulatedFiles(Disk& disk, Mishap mishap = {}) : disk_(disk), mishap_(mishap) {}

  int calls() const { return calls_; }
  /// Calls that changed something on the disk or made it do something.
  int changes() const { return changes_; }

  Result<std::string> read(const std::string& path, std::size_t limit_bytes) override;
  Result<storage::NewFile> create(const std::string& path) override;
  Result<void> write(const storage::NewFile& file, std::string_view content) override;
  Result<void> sync(const storage::NewFile& file) override;
  Result<void> close(const storage::NewFile& file) override;
  Result<void> rename(const std::string& from, const std::string& to) override;
  Result<void> link(const std::string& from, const std::string& to) override;
  Result<void> unlink(const std::string& path) override;
  Result<void> sync_folder(const std::string& path) override;
  Result<void> check_folder(const std::string& path) override;

 private:
  struct Call {
    bool acts;
    int error;  ///< 0: succeeds
  };
  Call next();
  template <class Effect>
  Result<void> change(const std::string& path, Effect effect);

  Disk& disk_;
  Mishap mishap_;
  int calls_ = 0;
  int changes_ = 0;
};

}  // namespace supercoil::test
