#include "campaign/draws.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <sstream>
#include <string_view>
#include <utility>

#include "batch/kept_lines.hpp"
#include "config/toml_file.hpp"

namespace supercoil::host_sim::campaign {

namespace {

std::vector<std::string> groups_of(const std::vector<Draw>& draws) {
  std::vector<std::string> groups;
  for (const Draw& draw : draws) {
    if (!draw.group.empty() && std::ranges::find(groups, draw.group) == groups.end())
      groups.push_back(draw.group);
  }
  return groups;
}

/// "name[2]": the name, and 2.
struct Step {
  std::string name;
  std::optional<std::size_t> index;
};

/// The first step of "a.b[2].c"; key keeps what follows the dot. Empty if it is not of this form.
std::optional<Step> take_step(std::string_view& key) {
  const std::size_t dot = std::min(key.find('.'), key.size());
  std::string_view step = key.substr(0, dot);
  key.remove_prefix(std::min(dot + 1, key.size()));
  const std::size_t bracket = step.find('[');
  if (bracket == std::string_view::npos) return Step{std::string(step), std::nullopt};
  std::size_t index = 0;
  const std::string_view digits = step.substr(bracket + 1);
  if (!digits.ends_with(']') || !batch::read(digits.substr(0, digits.size() - 1), index))
    return std::nullopt;
  return Step{std::string(step.substr(0, bracket)), index};
}

/// Sets "a.b[2].c"; adds missing tables. False if something else is in the way, or the list is
/// shorter.
bool set(toml::table& document, std::string_view key, const toml::node& value) {
  toml::table* table = &document;
  while (table != nullptr) {
    const auto step = take_step(key);
    if (!step || step->name.empty()) return false;
    toml::node* next = nullptr;
    toml::array* list = nullptr;
    if (step->index) {
      list = table->get_as<toml::array>(step->name);
      next = list == nullptr ? nullptr : list->get(*step->index);
      if (next == nullptr) return false;
    }
    if (key.empty()) {
      value.visit([&](const auto& one) {
        if (list == nullptr) {
          table->insert_or_assign(step->name, one);
        } else {
          list->replace(list->begin() + static_cast<std::ptrdiff_t>(*step->index), one);
        }
      });
      return true;
    }
    if (next == nullptr) next = &table->insert(step->name, toml::table{}).first->second;
    table = next->as_table();
  }
  return false;
}

/// Finds draws by name, and the scenario's numbers by key.
class Known {
 public:
  explicit Known(const toml::table& document) : document_(&document) {}

  void add(const std::string& name, double value) { drawn_[name] = value; }
  std::optional<double> find(const std::string& name) const {
    if (const auto drawn = drawn_.find(name); drawn != drawn_.end()) return drawn->second;
    return document_->at_path(name).value<double>();
  }

 private:
  const toml::table* document_;
  std::map<std::string, double> drawn_;
};

/// The error is the name that is not known.
Result<double> final_value(const Draw& draw, double drawn, const Known& known) {
  for (const std::string& name : draw.times) {
    const auto factor = known.find(name);
    if (!factor) return failure(name);
    drawn *= *factor;
  }
  for (const std::string& name : draw.over) {
    const auto divisor = known.find(name);
    if (!divisor) return failure(name);
    drawn /= *divisor;
  }
  return drawn;
}

bool set_all(toml::table& document, const Draw& draw, const toml::node& value) {
  return std::ranges::all_of(draw.keys,
                             [&](const std::string& key) { return set(document, key, value); });
}

/// Replaces the scenario's own tables on control: all contenders meet the same.
void use_contender(toml::table& document, const compare::Document& contender) {
  if (contender.text.empty()) return;
  erase_control(document);
  config::Diagnostics ignored(contender.name);  // it was read before
  apply_changes(document, config::parse(contender.text, ignored));
}

}  // namespace

Draws::Draws(const Study& study)
    : study_(&study),
      groups_(groups_of(study.draws)),
      sampler_(study.sampling, study.seed, study.draws.size() + groups_.size(),
               static_cast<std::size_t>(study.runs)) {}

std::vector<double> Draws::at(const std::vector<double>& point) const {
  std::vector<double> drawn;
  for (std::size_t i = 0; i < study_->draws.size(); ++i) {
    const Draw& draw = study_->draws[i];
    double probability = point[i];
    if (!draw.group.empty()) {
      // A Gaussian copula: the ranks are correlated, whatever the distributions are.
      const auto group = std::ranges::find(groups_, draw.group) - groups_.begin();
      const double shared = point[study_->draws.size() + static_cast<std::size_t>(group)];
      const double own = std::sqrt(1.0 - draw.correlation * draw.correlation);
      probability = normal_probability(draw.correlation * normal_quantile(shared) +
                                       own * normal_quantile(probability));
    }
    drawn.push_back(draw.distribution.at(probability));
  }
  return drawn;
}

std::vector<double> Draws::of_run(std::size_t run) const {
  return at(sampler_.point(run));
}

std::vector<double> Draws::medians() const {
  return at(std::vector<double>(dimensions(), 0.5));
}

Result<toml::table> Draws::document(const std::vector<double>& drawn, std::size_t contender,
                                    std::size_t run) const {
  toml::table document = study_->scenario;
  use_contender(document, study_->contenders[contender]);
  // Each run has its own noise, the same for all contenders.
  set(document, "simulation.seed", toml::value<std::int64_t>(static_cast<std::int64_t>(run) + 1));
  Known known(document);
  for (std::size_t i = 0; i < study_->draws.size(); ++i) {
    const Draw& draw = study_->draws[i];
    bool right = true;
    if (draw.distribution.kind == Distribution::Kind::list) {
      const toml::node& value = draw.values[static_cast<std::size_t>(drawn[i])];
      if (const auto number = value.value<double>()) known.add(draw.name, *number);
      right = set_all(document, draw, value);
    } else {
      const auto value = final_value(draw, drawn[i], known);
      if (!value) {
        return failure("draw " + draw.name + ": times or over names " + value.error().text() +
                       ", which is neither an earlier draw nor a number in the scenario");
      }
      known.add(draw.name, *value);
      right = set_all(document, draw, toml::value<double>(*value));
    }
    if (!right) {
      return failure("draw " + draw.name +
                     ": one of its keys is inside a value that is not a table, or beyond "
                     "the end of a list");
    }
  }
  return document;
}

ScenarioOrProblems Draws::scenario(const std::vector<double>& drawn, std::size_t contender,
                                   std::size_t run) const {
  auto made = document(drawn, contender, run);
  if (!made) return tl::unexpected(std::vector{Error{study_->name, 0, "", made.error().text()}});
  return scenario_from(std::move(*made), study_->name);
}

std::string text_of(const Draw& draw, double drawn) {
  if (draw.distribution.kind != Distribution::Kind::list) return batch::number(drawn);
  const toml::node& value = draw.values[static_cast<std::size_t>(drawn)];
  if (const auto text = value.value_exact<std::string>()) return *text;
  if (const auto floating = value.value_exact<double>()) return batch::number(*floating);
  std::ostringstream text;
  text << toml::node_view<const toml::node>(&value);
  return text.str();
}

}  // namespace supercoil::host_sim::campaign
