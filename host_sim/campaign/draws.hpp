// What the runs of a study draw, and the scenarios that it makes of them.
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

  /// Of each draw, in the study's order, before times and over. Of a list: an index.
  std::vector<double> of_run(std::size_t run) const;
  /// Half of all draws are below; what a study describes must be a scenario here.
  std::vector<double> medians() const;

  /// As many numbers between 0 and 1, both excluded, are what of_run() is made of.
  std::size_t dimensions() const { return study_->draws.size() + groups_.size(); }
  std::vector<double> at(const std::vector<double>& point) const;

  /// The scenario, written out. The error says which draw refers to what is not there.
  Result<toml::table> document(const std::vector<double>& drawn, std::size_t contender,
                               std::size_t run) const;
  ScenarioOrProblems scenario(const std::vector<double>& drawn, std::size_t contender,
                              std::size_t run) const;

 private:
  const Study* study_;
  std::vector<std::string> groups_;
  Sampler sampler_;
};

/// For tables: a number, or what stands in the list.
std::string text_of(const Draw& draw, double drawn);

}  // namespace supercoil::host_sim::campaign
