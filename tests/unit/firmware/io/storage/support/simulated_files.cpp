#include "unit/firmware/io/storage/support/simulated_files.hpp"

#include <cerrno>
#include <memory>
#include <utility>

namespace supercoil::test {

using storage::NewFile;

namespace {

tl::unexpected<Error> failed(const std::string& path, int error,
                             const std::string& what = "simulated") {
  return failed_call(path + ": " + what, error);
}

}  // namespace

SimulatedFiles::Call SimulatedFiles::next() {
  const int call = calls_++;
  const bool hit = mishap_.at_call >= 0 && call == mishap_.at_call;
  const bool after = mishap_.at_call >= 0 && call > mishap_.at_call;
  if (hit) return {mishap_.takes_effect, mishap_.error == 0 ? EIO : mishap_.error};
  if (after && mishap_.error == 0) return {false, EIO};
  if (after && mishap_.for_good) return {false, mishap_.error};
  return {true, 0};
}

template <class Effect>
Result<void> SimulatedFiles::change(const std::string& path, Effect effect) {
  const Call call = next();
  ++changes_;
  if (call.acts) {
    if (const int error = effect(); error != 0) return failed(path, error);
  }
  if (call.error != 0) return failed(path, call.error);
  return {};
}

Result<std::string> SimulatedFiles::read(const std::string& path, std::size_t limit_bytes) {
  const Call call = next();
  if (call.error != 0) return failed(path, call.error);
  const auto found = disk_.names.find(path);
  if (found == disk_.names.end()) return failed(path, ENOENT);
  return found->second->seen.substr(0, limit_bytes);
}

Result<NewFile> SimulatedFiles::create(const std::string& path) {
  const auto made = change(path, [&] {
    if (disk_.names.contains(path)) return EEXIST;
    disk_.change({path, std::make_shared<Inode>(), ""});
    return 0;
  });
  if (!made) return failed(path, static_cast<int>(made.error().code), "simulated creation");
  return NewFile{0, path};
}

Result<void> SimulatedFiles::write(const NewFile& file, std::string_view content) {
  const bool half = calls_ == mishap_.at_call;
  return change(file.path, [&] {
    Inode& inode = *disk_.names.at(file.path);
    inode.seen += content.substr(0, half ? content.size() / 2 : content.size());
    inode.dirty = true;
    return 0;
  });
}

Result<void> SimulatedFiles::sync(const NewFile& file) {
  return change(file.path, [&] {
    Inode& inode = *disk_.names.at(file.path);
    inode.synced = inode.seen;
    inode.dirty = false;
    return 0;
  });
}

Result<void> SimulatedFiles::close(const NewFile& file) {
  return change(file.path, [] { return 0; });
}

Result<void> SimulatedFiles::rename(const std::string& from, const std::string& to) {
  return change(to, [&] {
    const auto source = disk_.names.find(from);
    if (source == disk_.names.end()) return ENOENT;
    const auto target = disk_.names.find(to);
    const bool same_file = target != disk_.names.end() && target->second == source->second;
    if (!same_file) disk_.change({to, source->second, from});
    return 0;
  });
}

Result<void> SimulatedFiles::link(const std::string& from, const std::string& to) {
  return change(to, [&] {
    const auto source = disk_.names.find(from);
    if (source == disk_.names.end()) return ENOENT;
    if (disk_.names.contains(to)) return EEXIST;
    disk_.change({to, source->second, ""});
    return 0;
  });
}

Result<void> SimulatedFiles::unlink(const std::string& path) {
  return change(path, [&] {
    if (!disk_.names.contains(path)) return ENOENT;
    disk_.change({"", nullptr, path});
    return 0;
  });
}

Result<void> SimulatedFiles::sync_folder(const std::string& path) {
  return change(path, [&] {
    disk_.sync_names();
    return 0;
  });
}

Result<void> SimulatedFiles::check_folder(const std::string& path) {
  const Call call = next();
  if (call.error != 0) return failed(path, call.error);
  return {};
}

}  // namespace supercoil::test
