#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <utility>

#include "supercoil/control/linear/matrix_functions.hpp"

// Sums are in the order of Eigen 3.4 without vectorisation, for matrices of fixed size; comments
// say where Eigen has several orders. matrix_exponential_test compares with Eigen's own.
namespace supercoil::control {
namespace {

struct SquareMatrix {
  explicit SquareMatrix(int rows) : size(rows) {}

  double& operator()(int row, int column) { return values[index(row, column)]; }
  double operator()(int row, int column) const { return values[index(row, column)]; }

  int size;
  std::array<double, std::size_t{max_exponential_size} * max_exponential_size> values{};

 private:
  std::size_t index(int row, int column) const {
    const int at = column * size + row;
    return static_cast<std::size_t>(at);
  }
};

/// Sums terms first to first + count, each half by itself, as Eigen does in unrolled loops.
template <typename Term>
double sum_in_halves(const Term& term, int first, int count) {
  if (count == 1) return term(first);
  const int half = count / 2;
  return sum_in_halves(term, first, half) + sum_in_halves(term, first + half, count - half);
}

template <typename Term>
double sum_in_turn(const Term& term, int first, int count) {
  double sum = 0.0;
  for (int k = first; k < first + count; ++k)
    sum += term(k);
  return sum;
}

/// Sums the even and the odd ones of the first eight terms by themselves, then adds the rest.
template <typename Term>
double sum_even_and_odd(const Term& term, int count) {
  double even = 0.0;
  double odd = 0.0;
  for (int k = 0; k < 8; k += 2) {
    even += term(k);
    odd += term(k + 1);
  }
  double sum = even + odd;
  for (int k = 8; k < count; ++k)
    sum += term(k);
  return sum;
}

/// Up to 7×7 Eigen multiplies coefficient by coefficient, above that four columns at a time.
SquareMatrix operator*(const SquareMatrix& left, const SquareMatrix& right) {
  const int size = left.size;
  SquareMatrix product(size);
  for (int column = 0; column < size; ++column) {
    for (int row = 0; row < size; ++row) {
      const auto term = [&](int k) { return left(row, k) * right(k, column); };
      product(row, column) = size < 8                ? sum_in_halves(term, 0, size)
                             : column < size / 4 * 4 ? sum_even_and_odd(term, size)
                                                     : sum_in_turn(term, 0, size);
    }
  }
  return product;
}

struct Term {
  double factor;
  const SquareMatrix& matrix;
};

/// factor·matrix + … + unit·I, from left to right.
SquareMatrix polynomial(std::initializer_list<Term> terms, double unit) {
  const int size = terms.begin()->matrix.size;
  SquareMatrix sum(size);
  for (int column = 0; column < size; ++column) {
    for (int row = 0; row < size; ++row) {
      double value = terms.begin()->factor * terms.begin()->matrix(row, column);
      for (const Term* term = terms.begin() + 1; term != terms.end(); ++term)
        value += term->factor * term->matrix(row, column);
      sum(row, column) = value + unit * (row == column ? 1.0 : 0.0);
    }
  }
  return sum;
}

/// exp ≈ (V − U)⁻¹ (V + U).
struct Pade {
  SquareMatrix u;
  SquareMatrix v;
};

Pade pade_3(const SquareMatrix& a) {
  const SquareMatrix a2 = a * a;
  return {a * polynomial({{1.0, a2}}, 60.0), polynomial({{12.0, a2}}, 120.0)};
}

Pade pade_5(const SquareMatrix& a) {
  const SquareMatrix a2 = a * a;
  const SquareMatrix a4 = a2 * a2;
  return {a * polynomial({{1.0, a4}, {420.0, a2}}, 15120.0),
          polynomial({{30.0, a4}, {3360.0, a2}}, 30240.0)};
}

Pade pade_7(const SquareMatrix& a) {
  const SquareMatrix a2 = a * a;
  const SquareMatrix a4 = a2 * a2;
  const SquareMatrix a6 = a4 * a2;
  return {a * polynomial({{1.0, a6}, {1512.0, a4}, {277200.0, a2}}, 8648640.0),
          polynomial({{56.0, a6}, {25200.0, a4}, {1995840.0, a2}}, 17297280.0)};
}

Pade pade_9(const SquareMatrix& a) {
  const SquareMatrix a2 = a * a;
  const SquareMatrix a4 = a2 * a2;
  const SquareMatrix a6 = a4 * a2;
  const SquareMatrix a8 = a6 * a2;
  return {
      a * polynomial({{1.0, a8}, {3960.0, a6}, {2162160.0, a4}, {302702400.0, a2}}, 8821612800.0),
      polynomial({{90.0, a8}, {110880.0, a6}, {30270240.0, a4}, {2075673600.0, a2}},
                 17643225600.0)};
}

SquareMatrix operator+(SquareMatrix left, const SquareMatrix& right) {
  for (std::size_t i = 0; i < left.values.size(); ++i)
    left.values[i] += right.values[i];
  return left;
}

/// The highest terms without the unit matrix: multiplied by A⁶, they are those of A⁸ to A¹².
SquareMatrix highest(const SquareMatrix& a6, double b6, const SquareMatrix& a4, double b4,
                     const SquareMatrix& a2, double b2) {
  SquareMatrix sum(a6.size);
  for (std::size_t i = 0; i < sum.values.size(); ++i)
    sum.values[i] = b6 * a6.values[i] + b4 * a4.values[i] + b2 * a2.values[i];
  return sum;
}

Pade pade_13(const SquareMatrix& a) {
  const SquareMatrix a2 = a * a;
  const SquareMatrix a4 = a2 * a2;
  const SquareMatrix a6 = a4 * a2;
  const SquareMatrix odd =
      a6 * highest(a6, 1.0, a4, 16380.0, a2, 40840800.0) +
      polynomial({{33522128640.0, a6}, {10559470521600.0, a4}, {1187353796428800.0, a2}},
                 32382376266240000.0);
  return {a * odd,
          a6 * highest(a6, 182.0, a4, 960960.0, a2, 1323241920.0) +
              polynomial({{670442572800.0, a6}, {129060195264000.0, a4}, {7771770303897600.0, a2}},
                         64764752532480000.0)};
}

/// The largest sum of a column's magnitudes.
double norm_1(const SquareMatrix& a) {
  double norm = 0.0;
  for (int column = 0; column < a.size; ++column) {
    norm =
        std::max(norm, sum_in_halves([&](int row) { return std::abs(a(row, column)); }, 0, a.size));
  }
  return norm;
}

/// In place: the upper triangle with the pivots, below it the factors. The rows of `other` are
/// exchanged in the same way.
void factorise(SquareMatrix& a, SquareMatrix& other) {
  const int size = a.size;
  for (int k = 0; k < size - 1; ++k) {
    int pivot = k;
    for (int row = k + 1; row < size; ++row)
      if (std::abs(a(row, k)) > std::abs(a(pivot, k))) pivot = row;
    if (a(pivot, k) != 0.0) {
      for (int column = 0; column < size && pivot != k; ++column) {
        std::swap(a(k, column), a(pivot, column));
        std::swap(other(k, column), other(pivot, column));
      }
      for (int row = k + 1; row < size; ++row)
        a(row, k) /= a(k, k);
    }
    for (int column = k + 1; column < size; ++column) {
      for (int row = k + 1; row < size; ++row)
        a(row, column) -= a(row, k) * a(k, column);
    }
  }
}

/// Four unknowns at a time, as in Eigen: their contributions to the others are summed before being
/// subtracted.
inline constexpr int panel = 4;

void solve_lower(const SquareMatrix& lu, SquareMatrix& x) {
  const int size = lu.size;
  for (int first = 0; first < size; first += panel) {
    const int end = std::min(first + panel, size);
    for (int column = 0; column < size; ++column) {
      for (int k = first; k < end; ++k) {
        for (int row = k + 1; row < end; ++row)
          x(row, column) -= x(k, column) * lu(row, k);
      }
      for (int row = end; row < size; ++row) {
        x(row, column) -=
            sum_in_turn([&](int k) { return lu(row, k) * x(k, column); }, first, end - first);
      }
    }
  }
}

void solve_upper(const SquareMatrix& lu, SquareMatrix& x) {
  const int size = lu.size;
  for (int end = size; end > 0; end -= panel) {
    const int first = std::max(end - panel, 0);
    for (int column = 0; column < size; ++column) {
      for (int k = end - 1; k >= first; --k) {
        x(k, column) *= 1.0 / lu(k, k);
        for (int row = first; row < k; ++row)
          x(row, column) -= x(k, column) * lu(row, k);
      }
      for (int row = 0; row < first; ++row) {
        x(row, column) -=
            sum_in_turn([&](int k) { return lu(row, k) * x(k, column); }, first, end - first);
      }
    }
  }
}

}  // namespace

void replace_by_exponential(std::span<double> matrix, int size) {
  SquareMatrix a(size);
  std::copy(matrix.begin(), matrix.end(), a.values.begin());
  const double norm = norm_1(a);
  int squarings = 0;
  const Pade pade = [&] {
    if (norm < 1.495585217958292e-002) return pade_3(a);
    if (norm < 2.539398330063230e-001) return pade_5(a);
    if (norm < 9.504178996162932e-001) return pade_7(a);
    if (norm < 2.097847961257068e+000) return pade_9(a);
    std::frexp(norm / 5.371920351148152, &squarings);
    squarings = std::max(squarings, 0);
    for (double& value : a.values)
      value = std::ldexp(value, -squarings);
    return pade_13(a);
  }();
  SquareMatrix result = pade.u + pade.v;
  SquareMatrix denominator = pade.v;
  for (std::size_t i = 0; i < denominator.values.size(); ++i)
    denominator.values[i] = -pade.u.values[i] + pade.v.values[i];
  factorise(denominator, result);
  solve_lower(denominator, result);
  solve_upper(denominator, result);
  for (int i = 0; i < squarings; ++i)
    result = result * result;
  std::copy_n(result.values.begin(), matrix.size(), matrix.begin());
}

}  // namespace supercoil::control
