#include "scenario/reference.hpp"

#include <cmath>

#include <CppUTest/TestHarness.h>

using namespace supercoil::host_sim;

TEST_GROUP(Reference){};

TEST(Reference, SineStartsAtItsOffset) {
  const Reference sine;
  DOUBLES_EQUAL(0.011, sine.at(0.0), 0.0);
  DOUBLES_EQUAL(0.020, sine.at(3.14159265358979 / 0.5), 1e-12);
  DOUBLES_EQUAL(0.002, sine.min(), 1e-15);
  DOUBLES_EQUAL(0.020, sine.max(), 1e-15);
}

TEST(Reference, StepChangesOnceAtItsTime) {
  const Reference step{ReferenceKind::step, 0.0, {}, {0.001, 0.012}, 5.0};
  DOUBLES_EQUAL(0.001, step.at(4.999), 0.0);
  DOUBLES_EQUAL(0.012, step.at(5.0), 0.0);
  DOUBLES_EQUAL(0.012, step.at(5000.0), 0.0);
}

TEST(Reference, StepsRepeat) {
  const Reference steps{ReferenceKind::steps, 0.0, {}, {0.005, 0.015, 0.008}, 20.0};
  DOUBLES_EQUAL(0.005, steps.at(19.999), 0.0);
  DOUBLES_EQUAL(0.015, steps.at(20.0), 0.0);
  DOUBLES_EQUAL(0.008, steps.at(59.999), 0.0);
  DOUBLES_EQUAL(0.005, steps.at(60.0), 0.0);
  DOUBLES_EQUAL(0.015, steps.max(), 0.0);
}

TEST(Reference, PaperExcitationIsEquation18) {
  const Reference excitation = paper_excitation();
  for (const double t : {0.0, 1.0, 17.3, 69.0}) {
    DOUBLES_EQUAL(std::sin(t) + std::sin(0.5 * t) + std::sin(0.25 * t) + 2.5, excitation.at(t),
                  1e-12);
  }
}
