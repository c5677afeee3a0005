// The options of supercoil docs, and of supercoil-sim docs.
#pragma once

#include <string>

namespace supercoil {

struct DocsOptions {
  std::string folder = "/usr/share/doc/supercoil-doc/html";
  int port = 8000;  ///< 0: a free one
  bool open = false;
};

}  // namespace supercoil
