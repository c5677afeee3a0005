// The covariance of recursive least squares, in factors that rounding cannot make indefinite.
#pragma once

#include "supercoil/control/scalar/scalar.hpp"

namespace supercoil::control {

/// C = U·diag(D)·Uᵀ with U unit upper triangular and D >= 0, updated by Bierman's algorithm
/// (Factorization Methods for Discrete Sequential Estimation, 1977, Sec. V.3). The textbook update
/// C − KφᵀC subtracts nearly equal numbers: in float it loses its positive directions after some
/// minutes of good excitation, and the estimate diverges. Here nothing is subtracted from D.
///
/// A parameter with D = 0 is known: its gain is 0.
template <class Scalar, int N>
class UdCovariance {
 public:
  /// Nothing is known of any parameter beyond these variances.
  explicit UdCovariance(const Vector<Scalar, N>& variances) { reset(variances); }

  /// As constructed: a diagonal of these variances, each >= 0.
  void reset(const Vector<Scalar, N>& variances) {
    u_.setIdentity();
    d_ = variances;
  }

  /// Takes z = θᵀφ + noise into account, forgets, and returns the gain K = Cφ/(noise + φᵀCφ). Only
  /// parameters from `first` on take part; the earlier ones must be known. noise > 0; forgetting
  /// in (0, 1].
  Vector<Scalar, N> update(const Vector<Scalar, N>& phi, Scalar noise, Scalar forgetting,
                           int first) {
    Vector<Scalar, N> gain = Vector<Scalar, N>::Zero();
    Scalar explained = noise * forgetting;
    for (int j = first; j < N; ++j) {
      Scalar f = phi[j];
      for (int i = first; i < j; ++i)
        f += u_(i, j) * phi[i];
      const Scalar v = d_[j] * f;
      const Scalar before = explained;
      explained += f * v;
      d_[j] *= before / (explained * forgetting);
      const Scalar factor = f / before;
      for (int i = first; i < j; ++i) {
        const Scalar old = u_(i, j);
        u_(i, j) -= gain[i] * factor;
        gain[i] += old * v;
      }
      gain[j] = v;
    }
    return gain / explained;
  }

  /// The first parameters become independent of all others, with these variances; 0 means that they
  /// are known. The covariance of the others stays: being last, they do not depend on the first.
  template <int Count>
  void renew_first(const Vector<Scalar, Count>& variances) {
    u_.template topRows<Count>().setZero();
    u_.template topLeftCorner<Count, Count>().setIdentity();
    d_.template head<Count>() = variances;
  }

  /// Scales the whole covariance. factor: >= 0.
  void scale(Scalar factor) { d_ *= factor; }

  /// Adds a covariance, positive semidefinite. The sum is factored again, last column first.
  void add(const Matrix<Scalar, N>& more) {
    Matrix<Scalar, N> rest = matrix() + more;
    for (int j = N - 1; j >= 0; --j) {
      d_[j] = rest(j, j);
      if (!(d_[j] > Scalar{})) continue;
      for (int i = 0; i < j; ++i)
        u_(i, j) = rest(i, j) / d_[j];
      for (int i = 0; i < j; ++i) {
        for (int k = 0; k <= i; ++k)
          rest(k, i) -= u_(k, j) * u_(i, j) * d_[j];
      }
    }
  }

  /// Adds to the variance of each parameter (>= 0); their covariances stay.
  void inflate(Scalar variance) { add(Matrix<Scalar, N>::Identity() * variance); }

  /// The largest variance of parameters first to N - 1; 0 when there are none.
  Scalar max_variance(int first) const {
    Scalar largest{};
    for (int i = first; i < N; ++i) {
      Scalar variance = d_[i];
      for (int j = i + 1; j < N; ++j)
        variance += u_(i, j) * u_(i, j) * d_[j];
      if (variance > largest) largest = variance;
    }
    return largest;
  }

  template <class Result = Scalar>
  Matrix<Result, N> matrix() const {
    const Matrix<Result, N> u = u_.template cast<Result>();
    return u * d_.template cast<Result>().asDiagonal() * u.transpose();
  }

 private:
  Matrix<Scalar, N> u_;
  Vector<Scalar, N> d_;
};

}  // namespace supercoil::control
