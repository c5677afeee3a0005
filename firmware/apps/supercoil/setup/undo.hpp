// Takes back what setup wrote into a board's file.
#pragma once

#include <functional>
#include <string>

#include <tl/expected.hpp>

#include "apps/supercoil/setup/options.hpp"

namespace supercoil::operating {

struct Undone {
  int channel = 1;
  std::string step;     ///< that had written
  std::string kept_as;  ///< the file as it was until now
};

/// The last change of the channel that is set up, with its step and those behind it. anyway:
/// whether to go on where the file is not as setup wrote it, whose reason it is given. The error
/// says what could not be done; the file is as it was then.
tl::expected<Undone, std::string> undo_setup(
    const SetupOptions& options, const std::function<bool(const std::string& why)>& anyway);

/// "board.toml is as it was before describe of channel 1; …"
std::string undone_text(const std::string& config, const Undone& undone);

}  // namespace supercoil::operating
