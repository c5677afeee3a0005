// The options of supercoil identify.
#include <CLI/CLI.hpp>

#include "apps/common/command_line.hpp"
#include "apps/supercoil/identify/options.hpp"

namespace supercoil::operating {

namespace {

void add_column(CLI::App& identify, const std::string& quantity, identification::Column& column,
                const std::string& units) {
  identify
      .add_option("--" + quantity + "-column", column.name,
                  "Name of the " + quantity + " column, or its number from 1 [found by its name]")
      ->type_name("NAME");
  identify.add_option("--" + quantity + "-unit", column.unit, units)->type_name("UNIT");
}

}  // namespace

void add_identify(CLI::App& app, IdentifyOptions& o) {
  CLI::App* identify = app.add_subcommand(
      "identify",
      "Fit a recording of position and power: print the muscle's parameters, how well each model "
      "predicts what it was not fitted to, and a [muscle] table");
  identify
      ->add_option("FILE", o.file,
                   "CSV with a line of names; trace.csv of supercoil-sim; a flight recording")
      ->required();
  add_column(*identify, "time", o.columns.time, "s, ms, us or min [by the name, else s]");
  add_column(*identify, "position", o.columns.position, "m, cm, mm or um [by the name, else m]");
  identify
      ->add_option("--position-scale", o.columns.position.scale,
                   "Factor on the position, which must grow when the muscle is heated: -1 if the "
                   "sensor counts the other way")
      ->check(is_finite)
      ->capture_default_str();
  add_column(*identify, "power", o.columns.power, "W or mW [by the name, else W]");
  identify
      ->add_option("--power-scale", o.columns.power.scale,
                   "Factor on the power: for a column that is 1 while heated, the power itself")
      ->check(is_finite)
      ->check(is_positive)
      ->capture_default_str();
  identify
      ->add_option("--channel", o.columns.channel,
                   "Channel to fit, 1 to 16, of a file with several")
      ->check(CLI::Range(1, 16));
  identify->add_option("--from", o.from_s, "Ignore what is before this time in s [the first]")
      ->check(is_finite);
  identify->add_option("--to", o.to_s, "Ignore what is after this time in s [the last]")
      ->check(is_finite);
  identify
      ->add_option("--fit", o.fit,
                   "Fit to this span, FROM:TO in s [up to the last heating from rest; with fewer "
                   "than two, the first two thirds]")
      ->type_name("SPAN");
  identify
      ->add_option("--judge", o.judge,
                   "Judge by this span, FROM:TO in s [everything after the fitted span]")
      ->type_name("SPAN");
  identify->add_flag("--bridge-gaps", o.bridge_gaps,
                     "Where rows are missing, assume that the power did not change");
  identify
      ->add_option(
          "--thermal-mass", o.thermal_mass_J_per_K,
          "Thermal mass of the muscle in J/K, which position and power do not determine [0.162]")
      ->check(is_finite)
      ->check(CLI::Range(1e-4, 1e3));
  CLI::Option* stiffness =
      identify
          ->add_option("--stiffness", o.stiffness_N_per_m,
                       "Stiffness in N/m, which position and power do not determine [16]")
          ->check(is_finite)
          ->check(CLI::Range(1e-2, 1e6));
  identify
      ->add_option("--moving-mass", o.moving_mass_kg,
                   "Moving mass in kg, the load included; the stiffness then follows from it")
      ->check(is_finite)
      ->check(CLI::Range(1e-5, 1e3))
      ->excludes(stiffness);
  identify->add_option("--muscle", o.muscle, "Write the [muscle] table to this file [print it]")
      ->type_name("TOML");
  identify->add_option("--plot", o.plot, "Draw measurement, prediction and residual (gnuplot)")
      ->type_name("SVG");
  identify->add_flag("--json", o.json, "Print one JSON object instead of text");
}

}  // namespace supercoil::operating
