// The reference values that tests/reference/make.py computed with scipy.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "supercoil/control/actuator/parameters.hpp"
#include "supercoil/control/scalar/scalar.hpp"

namespace supercoil::test {

/// An entry of a topic's file, e.g. "runs" of mrac.json; a copy, so that loops may run over it.
/// Throws when it does not exist, which ends the run.
nlohmann::json reference(const std::string& topic, const std::string& entry);

control::PhysicalParameters parameters_from(const nlohmann::json& json);

/// A matrix from a list of rows.
template <class Result>
Result matrix_from(const nlohmann::json& rows) {
  Result result;
  for (Eigen::Index i = 0; i < result.rows(); ++i) {
    for (Eigen::Index j = 0; j < result.cols(); ++j) {
      result(i, j) = rows.at(static_cast<std::size_t>(i)).at(static_cast<std::size_t>(j));
    }
  }
  return result;
}

template <class Result>
Result vector_from(const nlohmann::json& list) {
  Result result;
  for (Eigen::Index i = 0; i < result.size(); ++i)
    result(i) = list.at(static_cast<std::size_t>(i));
  return result;
}

}  // namespace supercoil::test
