#include "campaign/search.hpp"

#include <algorithm>
#include <memory>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>

#include <nlopt.h>

#include "campaign/results.hpp"

namespace supercoil::host_sim::campaign {

namespace {

/// In place of infinity, which the optimiser cannot handle.
constexpr double worst_possible = 1e6;
/// Less than any run of a valid scenario.
constexpr double no_scenario = -1.0;
/// Both ends of a probability are excluded.
constexpr double nearest_end = 1e-9;

class Search {
 public:
  Search(const Study& study, const Draws& draws, std::size_t contender,
         const std::atomic<bool>& stop, const std::function<void()>& ran)
      : study_(&study), draws_(&draws), contender_(contender), stop_(&stop), ran_(&ran) {}

  WorstRun run(std::int64_t runs) {
    using Optimiser = std::unique_ptr<std::remove_pointer_t<nlopt_opt>, decltype(&nlopt_destroy)>;
    const auto dimensions = static_cast<unsigned>(draws_->dimensions());
    const Optimiser made(nlopt_create(NLOPT_GN_CRS2_LM, dimensions), &nlopt_destroy);
    optimiser_ = made.get();
    nlopt_srand(static_cast<std::uint32_t>(study_->seed) + 1U);
    nlopt_set_lower_bounds1(optimiser_, nearest_end);
    nlopt_set_upper_bounds1(optimiser_, 1.0 - nearest_end);
    nlopt_set_max_objective(optimiser_, &Search::evaluate, this);
    nlopt_set_maxeval(optimiser_, static_cast<int>(runs));
    nlopt_set_stopval(optimiser_, worst_possible);
    std::vector<double> point(dimensions, 0.5);
    double found = 0.0;
    const nlopt_result result = nlopt_optimize(optimiser_, point.data(), &found);
    if (result < 0 && result != NLOPT_FORCED_STOP && result != NLOPT_ROUNDOFF_LIMITED)
      throw std::runtime_error(std::string("NLopt: ") + nlopt_result_to_string(result));
    return worst_;
  }

 private:
  static double evaluate(unsigned count, const double* point, double* /*gradient*/, void* self) {
    return static_cast<Search*>(self)->evaluate({point, point + count});
  }

  double evaluate(const std::vector<double>& point) {
    const auto drawn = draws_->at(point);
    const auto scenario = draws_->scenario(drawn, contender_, 0);
    double severity_of_run = no_scenario;
    if (scenario) {
      auto outcome = simulate(*scenario, study_->window, *stop_);
      if (outcome) {
        severity_of_run = severity(*study_, *outcome);
        if (worst_.drawn.empty() || severity_of_run > worst_.severity)
          worst_ = {drawn, std::move(*outcome), severity_of_run, worst_.runs};
      }
    }
    ++worst_.runs;
    (*ran_)();
    if (*stop_) nlopt_force_stop(optimiser_);
    return std::min(severity_of_run, worst_possible);
  }

  const Study* study_;
  const Draws* draws_;
  std::size_t contender_;
  const std::atomic<bool>* stop_;
  const std::function<void()>* ran_;
  nlopt_opt optimiser_ = nullptr;
  WorstRun worst_;
};

}  // namespace

WorstRun search(const Study& study, const Draws& draws, std::size_t contender, std::int64_t runs,
                const std::atomic<bool>& stop, const std::function<void()>& ran) {
  return Search(study, draws, contender, stop, ran).run(runs);
}

}  // namespace supercoil::host_sim::campaign
