// A check for options that take a number: CLI11's own ranges accept NaN.
#pragma once

#include <cmath>
#include <string>

#include <CLI/CLI.hpp>

namespace supercoil {

inline const CLI::Validator is_finite(
    [](const std::string& text) {
      double value = 0.0;
      const bool ok = CLI::detail::lexical_cast(text, value) && std::isfinite(value);
      return ok ? std::string() : text + ": must be a finite number";
    },
    "");

}  // namespace supercoil
