// How messages refer to a page of the documentation, which is also there where only a package is.
#pragma once

#include <string>
#include <string_view>

namespace supercoil {

/// "faults/heater_open in `supercoil docs`". page: the file's path below docs/, without its .md; in
/// a package the same below /usr/share/doc/supercoil.
inline std::string documentation_page(std::string_view page) {
  return std::string(page) + " in `supercoil docs`";
}

}  // namespace supercoil
