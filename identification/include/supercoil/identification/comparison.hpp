// Models of a recording, each judged on a part of it that was not fitted.
#pragma once

#include <string>
#include <vector>

#include "supercoil/identification/fit.hpp"

namespace supercoil::identification {

/// One model, fitted to one part of a recording and judged on another.
struct EvaluatedModel {
  Fit fit;
  double fitted_rms_m = 0.0;
  double unseen_rms_m = 0.0;
  /// 1 − Σ error²/Σ (position − its mean)²: of the motion in that part. At most 1; may be negative.
  double fitted_explained = 0.0;
  double unseen_explained = 0.0;
};

struct Parts {
  Span fitted;
  Span unseen;
};

EvaluatedModel evaluate(Fit fit, const Samples& samples, const Parts& parts);
/// Rms error over both parts, as if they were equally long.
double overall_rms(const EvaluatedModel& model);

/// The unseen part begins when the muscle is last heated after a second almost without power, if
/// that happens at least twice (a start with heat counts) and the last time is after three tenths
/// of the recording and before its last tenth; otherwise it is the last third.
Parts default_parts(const Samples& samples);

struct Comparison {
  Sizes sizes{};
  Parts parts{};
  /// Of the whole stroke: a part that stands still judges nothing.
  double unseen_stroke_ratio = 0.0;
  /// Linear, each effect alone, then the steps to the chosen one.
  std::vector<EvaluatedModel> models;
  std::size_t chosen = 0;         ///< of models
  EvaluatedModel transformation;  ///< how a shape-memory wire would move
  std::string rejection_reason;   ///< why no model is accepted; empty: one explains the motion

  const EvaluatedModel& best() const { return models[chosen]; }
};

/// Adds at most four effects, one at a time: the one that lowers the error on data that was not
/// fitted the most, while it does by a tenth and by 0.1 % of the stroke, and the rms of both parts
/// is above 0.1 % of the stroke and falls by 3 %. Then removes effects that are no longer worth as
/// much, down to one. That error is the unseen part's rms and the fitted part's cross-validated
/// one, added in squares.
Comparison compare(const Samples& samples, const Parts& parts);

/// Why none of these models is accepted, and what to do about it where that is known: a material
/// with a phase transformation, a fit at its limit, a position that counts the wrong way, a muscle
/// that changed between the parts, a recording too short for its time constant, other causes.
/// Empty: the best one is accepted.
std::string why_rejected(const Comparison& comparison, const Samples& samples);

/// What a linear controller can use of a model: the linear model and what moves the rest length.
Effects linear_effects(const Effects& effects);

/// The difference between two fits of the same model in gain or time constant, whichever is larger
/// in the first fit's deviations. parameter: its index in the fit.
struct Change {
  std::size_t parameter;
  double ratio;       ///< second/first value
  double deviations;  ///< of the first fit
};
Change max_change(const Fit& first, const Fit& second);

}  // namespace supercoil::identification
