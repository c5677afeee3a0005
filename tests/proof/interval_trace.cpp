// What IntervalObserver computes, as formulas and as numbers, for interval_proof.py: JSON.
#include <cstdint>
#include <cstdio>
#include <random>
#include <string>

#include "supercoil/control/thermal/interval_observer.hpp"

#include "proof/symbol.hpp"

using namespace supercoil;
using test::Symbol;

namespace {

/// The recursion of one step, from ends called `highest` and `lowest`, for any outcome of its
/// comparisons.
using SymbolicObserver = control::BasicIntervalObserver<Symbol>;

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  for (std::size_t at = text.find(what); at != std::string::npos;
       at = text.find(what, at + by.size()))
    text.replace(at, what.size(), by);
  return text;
}

void print_path(SymbolicObserver observer, bool hot_heats, bool cold_heats, bool last) {
  const std::string highest = observer.max_K().text();
  const std::string lowest = observer.min_K().text();
  Symbol::path = {{hot_heats, cold_heats}, {}};
  observer.step(Symbol("min_W"), Symbol("max_W"));
  const auto named = [&](const std::string& text) {
    return replaced(replaced(text, highest, "highest"), lowest, "lowest");
  };
  std::printf("  {\"when\": [");
  for (std::size_t i = 0; i < Symbol::path.conditions.size(); ++i)
    std::printf("%s\"%s\"", i == 0 ? "" : ", ", named(Symbol::path.conditions[i]).c_str());
  std::printf("],\n   \"highest\": \"%s\",\n   \"lowest\": \"%s\"}%s\n",
              named(observer.max_K().text()).c_str(), named(observer.min_K().text()).c_str(),
              last ? "" : ",");
}

void print_formulas() {
  SymbolicObserver observer(
      {Symbol("mass_l"), Symbol("mass_u"), Symbol("transfer_l"), Symbol("transfer_u")},
      Symbol("step_s"));
  // After a step each end becomes a formula of its own, which can be recognised in the next step's.
  observer.reset(Symbol("before"));
  Symbol::path = {};
  observer.step(Symbol("before_min_W"), Symbol("before_max_W"));
  std::printf("{\"paths\": [\n");
  for (const int i : {0, 1, 2, 3})
    print_path(observer, i / 2 == 1, i % 2 == 1, i == 3);
  std::printf("],\n");
}

/// Bounds and powers of any board, with the numbers that come out. Hexadecimal: to the last bit.
void print_numbers() {
  std::mt19937_64 random(1);
  const auto uniform = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(random() >> 11) * 0x1p-53;
  };
  std::printf("\"runs\": [\n");
  constexpr int runs = 40;
  for (int run = 0; run < runs; ++run) {
    const double scale = std::exp(uniform(-3.0, 3.0));  // small muscles and large ones
    const control::ThermalBounds b{0.13 * scale, uniform(0.14, 0.30) * scale, 0.045 * scale,
                                   uniform(0.05, 0.30) * scale};
    const double step_s = std::exp(uniform(std::log(1e-4), std::log(1e-1)));
    control::IntervalObserver observer(b, step_s);
    const double boot_K = uniform(0.0, 150.0);
    observer.reset(boot_K);
    std::printf("%s{\"bounds\": [\"%a\", \"%a\", \"%a\", \"%a\", \"%a\"],\n", run == 0 ? " " : ",",
                b.min_mass_J_per_K, b.max_mass_J_per_K, b.min_transfer_W_per_K,
                b.max_transfer_W_per_K, step_s);
    std::printf("  \"start\": \"%a\", \"steps\": [", boot_K);
    double max_W = 0.0;
    constexpr int steps = 200;
    for (int i = 0; i < steps; ++i) {
      if (random() % 8 == 0) max_W = scale * (random() % 3 == 0 ? 0.0 : uniform(0.0, 15.0));
      const double min_W = max_W * uniform(0.5, 1.0);
      observer.step(min_W, max_W);
      std::printf("%s[\"%a\", \"%a\", \"%a\", \"%a\"]", i == 0 ? "" : ", ", min_W, max_W,
                  observer.min_K(), observer.max_K());
    }
    std::printf("]}\n");
  }
  std::printf("]}\n");
}

}  // namespace

int main() {
  print_formulas();
  print_numbers();
  return 0;
}
