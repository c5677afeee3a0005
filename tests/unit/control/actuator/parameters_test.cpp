#include "supercoil/control/actuator/parameters.hpp"

#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <CppUTest/TestHarness.h>
#include <Eigen/LU>

#include "supercoil/control/actuator/conversions.hpp"
#include "supercoil/control/actuator/state_space.hpp"

using namespace supercoil::control;

namespace {

const std::vector<std::pair<std::string, double PhysicalParameters::*>> quantities{
    {"thermal_mass_J_per_K", &PhysicalParameters::thermal_mass_J_per_K},
    {"heat_transfer_W_per_K", &PhysicalParameters::heat_transfer_W_per_K},
    {"stiffness_N_per_m", &PhysicalParameters::stiffness_N_per_m},
    {"damping_Ns_per_m", &PhysicalParameters::damping_Ns_per_m},
    {"moving_mass_kg", &PhysicalParameters::moving_mass_kg},
    {"force_per_kelvin_N_per_K", &PhysicalParameters::force_per_kelvin_N_per_K},
};

}  // namespace

TEST_GROUP(Parameters){};

TEST(Parameters, ThePapersMuscleIsValid) {
  CHECK_FALSE(check(PhysicalParameters{}).has_value());
}

TEST(Parameters, CheckNamesTheInvalidParameter) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  for (const auto& [name, member] : quantities) {
    for (const double bad :
         {0.0, -1.0, infinity, -infinity, 1e9, std::numeric_limits<double>::quiet_NaN()}) {
      PhysicalParameters p;
      p.*member = bad;
      const auto violation = check(p);
      CHECK_TEXT(violation.has_value(), name.c_str());
      STRCMP_EQUAL(name.c_str(), violation->quantity);
      CHECK(violation->value == bad || bad != bad);
    }
  }
}

TEST(Parameters, RangeLimitsAreAllowedAndValuesJustBeyondAreNot) {
  for (const auto& [name, member] : quantities) {
    PhysicalParameters p;
    p.*member = -1.0;
    const Violation range = *check(p);
    for (const double end : {range.min, range.max}) {
      p.*member = end;
      CHECK_FALSE(check(p).has_value());
    }
    p.*member = std::nextafter(range.min, 0.0);
    CHECK(check(p).has_value());
    p.*member = std::nextafter(range.max, 1e300);
    CHECK(check(p).has_value());
  }
}

TEST(Parameters, StateSpaceHasThePolesOfTheTransferFunction) {
  const PhysicalParameters p;
  const auto system = state_space(p);
  const TransferFunction f = transfer_function_from(p);
  const auto& a = system.a;
  DOUBLES_EQUAL(f.b2, -a.trace(), 1e-10);
  DOUBLES_EQUAL(f.b1, 0.5 * (a.trace() * a.trace() - (a * a).trace()), 1e-9);
  DOUBLES_EQUAL(f.b0, -a.determinant(), 1e-9);
}

TEST(Parameters, StateSpaceRestsWhereHeatAndForcesBalance) {
  const PhysicalParameters p;
  const auto system = state_space(p);
  const Eigen::Vector2d power_and_load{4.5, 0.05};
  const Eigen::Vector3d rest = -system.a.inverse() * system.b * power_and_load;
  DOUBLES_EQUAL(50.6, rest[0], 0.05);
  DOUBLES_EQUAL(4.5 * p.dc_gain_m_per_W() - 0.05 / p.stiffness_N_per_m, rest[1], 1e-12);
  DOUBLES_EQUAL(0.0, rest[2], 1e-12);
}
