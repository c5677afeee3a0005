#include "supercoil/control/actuator/conversions.hpp"

#include <limits>

#include <CppUTest/TestHarness.h>
#include <rapidcheck.h>

#include "unit/control/support/generators.hpp"
#include "unit/control/support/reference.hpp"

using namespace supercoil::control;
using supercoil::test::muscles;

namespace {

void expect_near(double expected, double actual, double relative) {
  DOUBLES_EQUAL(expected, actual, relative * std::abs(expected));
}

/// The largest relative difference between two parameter sets.
double difference(const PhysicalParameters& a, const PhysicalParameters& b) {
  const auto list = [](const PhysicalParameters& p) {
    return Vector<double, 6>{p.thermal_mass_J_per_K, p.heat_transfer_W_per_K,
                             p.stiffness_N_per_m,    p.damping_Ns_per_m,
                             p.moving_mass_kg,       p.force_per_kelvin_N_per_K};
  };
  return (list(a) - list(b)).cwiseQuotient(list(b)).cwiseAbs().maxCoeff();
}

constexpr KnownParameters paper_known{0.0086, 0.09};

}  // namespace

TEST_GROUP(Conversions){};

TEST(Conversions, ThePapersMuscleHasThePapersTheta) {
  const Theta theta = theta_from(PhysicalParameters{});
  DOUBLES_EQUAL(18.84, theta[0], 0.005);
  DOUBLES_EQUAL(38.61, theta[1], 0.005);
  DOUBLES_EQUAL(322.09, theta[2], 0.005);
  DOUBLES_EQUAL(165.58, theta[3], 0.005);
}

TEST(Conversions, ThePapersMuscleHasTheCorrectedTransferFunction) {
  const TransferFunction f = transfer_function_from(PhysicalParameters{});
  DOUBLES_EQUAL(97.67, f.b0, 0.005);
  DOUBLES_EQUAL(189.99, f.b1, 0.005);
  DOUBLES_EQUAL(22.77, f.b2, 0.005);
  DOUBLES_EQUAL(0.58985, f.b3, 0.000005);  // the printed 0.0048 is an erratum
  DOUBLES_EQUAL(6.04e-3, f.b3 / f.b0, 5e-6);
  DOUBLES_EQUAL(f.b3 / f.b0, PhysicalParameters{}.dc_gain_m_per_W(), 1e-12);
}

TEST(Conversions, FormsAgreeWithNumpy) {
  for (const auto& c : supercoil::test::reference("actuator", "cases")) {
    const auto p = supercoil::test::parameters_from(c.at("parameters"));
    const auto expected = supercoil::test::vector_from<Theta>(c.at("theta"));
    const Theta theta = theta_from(p);
    CHECK((theta - expected).norm() <= 1e-12 * expected.norm());
    const auto b = supercoil::test::vector_from<Vector<double, 4>>(c.at("b"));
    const TransferFunction f = transfer_function_from(p);
    expect_near(b[0], f.b0, 1e-12);
    expect_near(b[1], f.b1, 1e-12);
    expect_near(b[2], f.b2, 1e-12);
    expect_near(b[3], f.b3, 1e-12);
  }
}

TEST(Conversions, SlowestRealRootAgreesWithNumpy) {
  for (const auto& c : supercoil::test::reference("actuator", "cases")) {
    const auto theta = supercoil::test::vector_from<Theta>(c.at("theta"));
    const double mass = c.at("parameters").at("moving_mass_kg");
    const auto root = slowest_real_root(theta[0] * mass, theta[1], theta[2], theta[3]);
    CHECK(root.has_value());
    expect_near(c.at("slowest_real_root"), *root, 1e-9);
  }
}

TEST(Conversions, SlowestOfThreeRealRootsIsFoundEvenWhenHitExactly) {
  DOUBLES_EQUAL(-1.0, *slowest_real_root(1.0, 6.0, 11.0, 6.0), 1e-14);
  DOUBLES_EQUAL(-0.5, *slowest_real_root(2.0, 131.0, 1565.0, 750.0), 1e-12);
  CHECK(rc::check("three real roots", [] {
    const double slow = *supercoil::test::magnitudes(0.05, 5.0);
    const double middle = slow * *supercoil::test::magnitudes(1.1, 50.0);
    const double fast = middle * *supercoil::test::magnitudes(1.0, 50.0);
    const auto root =
        slowest_real_root(1.0, slow + middle + fast, slow * middle + slow * fast + middle * fast,
                          slow * middle * fast);
    RC_ASSERT(root.has_value());
    RC_ASSERT(std::abs(*root + slow) <= 1e-9 * slow);
  }));
}

TEST(Conversions, PhysicalToThetaRoundTrips) {
  CHECK(rc::check("through theta", [] {
    const auto p = *muscles();
    const auto back = physical_from(theta_from(p), {p.force_per_kelvin_N_per_K, p.moving_mass_kg});
    RC_ASSERT(back.has_value());
    RC_ASSERT(difference(*back, p) < 1e-8);
  }));
}

TEST(Conversions, PhysicalToTransferFunctionRoundTrips) {
  CHECK(rc::check("through b0..b3", [] {
    const auto p = *muscles();
    const auto back =
        physical_from(transfer_function_from(p), {p.force_per_kelvin_N_per_K, p.moving_mass_kg});
    RC_ASSERT(back.has_value());
    RC_ASSERT(difference(*back, p) < 1e-8);
    const auto f = transfer_function_from(theta_from(p), p.moving_mass_kg);
    RC_ASSERT(f.has_value());
    RC_ASSERT(std::abs(f->b0 / transfer_function_from(p).b0 - 1.0) < 1e-12);
  }));
}

TEST(Conversions, RefusesAThetaThatIsNotHurwitz) {
  const Theta good = theta_from(PhysicalParameters{});
  CHECK(physical_from(good, paper_known).has_value());
  for (Eigen::Index i = 0; i < 4; ++i) {
    for (const double bad : {0.0, -good[i], std::numeric_limits<double>::quiet_NaN()}) {
      Theta theta = good;
      theta[i] = bad;
      CHECK_FALSE(physical_from(theta, paper_known).has_value());
    }
  }
  Theta unstable = good;  // all positive, but m θ1 θ4 > θ2 θ3
  unstable[3] = 1.01 * good[1] * good[2] / (good[0] * paper_known.moving_mass_kg);
  CHECK_FALSE(physical_from(unstable, paper_known).has_value());
}

TEST(Conversions, RefusesKnownParametersThatAreNotPositive) {
  const Theta good = theta_from(PhysicalParameters{});
  CHECK_FALSE(physical_from(good, {0.0, 0.09}).has_value());
  CHECK_FALSE(physical_from(good, {-0.0086, 0.09}).has_value());
  CHECK_FALSE(physical_from(good, {0.0086, 0.0}).has_value());
  CHECK_FALSE(transfer_function_from(good, 0.0).has_value());
  CHECK_FALSE(transfer_function_from(Theta{0.0, 1.0, 1.0, 1.0}, 0.09).has_value());
}

TEST(Conversions, RefusesATransferFunctionWithoutPositiveGain) {
  const TransferFunction good = transfer_function_from(PhysicalParameters{});
  for (const double b3 : {0.0, -0.6, std::numeric_limits<double>::quiet_NaN()}) {
    TransferFunction f = good;
    f.b3 = b3;
    CHECK_FALSE(physical_from(f, paper_known).has_value());
  }
}
