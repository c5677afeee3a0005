// The draws of a study's runs, and the scenarios made from them.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "supercoil/hal/error.hpp"

#include "campaign/sampler.hpp"
#include "campaign/study.hpp"
#include "scenario/read_scenario.hpp"

namespace supercoil::host_sim::campaign {

class Draws {
 public:
  /// Must not outlive the study.
  explicit Draws(const Study& study);

  /// The value of each draw, in the study's order, before times and over; for a list: an index.
  std::vector<double> of_run(std::size_t run) const;
  /// The median of each draw; there the study must give a valid scenario.
  std::vector<double> medians() const;

  /// How many numbers between 0 and 1, both excluded, determine of_run().
  std::size_t dimensions() const { return study_->draws.size() + groups_.size(); }
  std::vector<double> at(const std::vector<double>& point) const;

  /// The complete scenario. The error says which draw refers to something that does not exist.
  Result<toml::table> document(const std::vector<double>& drawn, std::size_t contender,
                               std::size_t run) const;
  ScenarioOrProblems scenario(const std::vector<double>& drawn, std::size_t contender,
                              std::size_t run) const;

 private:
  const Study* study_;
  std::vector<std::string> groups_;
  Sampler sampler_;
};

/// For tables: a number, or the list's value.
std::string text_of(const Draw& draw, double drawn);

}  // namespace supercoil::host_sim::campaign
