// A converter with a buffer, as files; a value written to an attribute becomes its content.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "supercoil/hal_linux/iio_scan.hpp"

#include "unit/hal_linux/support/system_calls.hpp"
#include "unit/hal_linux/support/temporary_folder.hpp"

namespace supercoil::test {

/// "ads7951" with the 12-bit inputs voltage0 to voltage4, and two triggers.
class ScanTree {
 public:
  ScanTree() {
    tree.write(device + "/name", "ads7951\n");
    tree.write(device + "/buffer/enable", "1\n");
    tree.write(device + "/buffer/length", "2\n");
    tree.write(device + "/current_timestamp_clock", "realtime\n");
    tree.write(device + "/trigger/current_trigger", "\n");
    for (int i = 0; i < 5; ++i)
      element("voltage" + std::to_string(i), i, "be:u12/16>>2", true);
    element("timestamp", 5, "le:s64/64>>0", false);
    tree.write("bus/trigger0/name", "spi0.0-dev0\n");
    tree.write("bus/trigger1/name", "supercoil\n");
    tree.link("bus/iio:device0", device);
    tree.write("dev/iio:device0", "");
    set_driver([this](const std::string& path, std::string_view text) {
      const std::string name = path.substr(tree.path().size() + 1);
      writes.push_back(name.substr(device.size() + 1) + " " + std::string(text));
      tree.write(name, std::string(text) + "\n");
      return static_cast<long>(text.size());
    });
  }
  ScanTree(const ScanTree&) = delete;
  ScanTree& operator=(const ScanTree&) = delete;
  ~ScanTree() { reset_calls(); }

  void element(const std::string& name, int index, const std::string& type, bool on) const {
    const std::string path = device + "/scan_elements/in_" + name;
    tree.write(path + "_en", on ? "1\n" : "0\n");
    tree.write(path + "_index", std::to_string(index) + "\n");
    tree.write(path + "_type", type + "\n");
  }
  hal_linux::ScanLocation place(const std::vector<std::string>& inputs = {"voltage2",
                                                                          "voltage0"}) const {
    return {"ads7951", inputs, "supercoil", 64, tree / "bus", tree / "dev"};
  }
  std::string attribute(const std::string& name) const { return tree.read(device + "/" + name); }

  const std::string device = "devices/spi0.0/iio:device0";
  TemporaryFolder tree;
  std::vector<std::string> writes;
};

}  // namespace supercoil::test
