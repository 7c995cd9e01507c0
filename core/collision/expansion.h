// SPDX-License-Identifier: MIT
// Exact sums and products of doubles as expansions: sums of non-overlapping doubles, smallest
// first (Shewchuk, "Adaptive precision floating-point arithmetic and fast robust geometric
// predicates", 1997). Only for signs that a filter could not settle, so simple before fast.
#pragma once

#include <cmath>

namespace elbowroom {

// At most N terms; the caller sizes N by what its formula can need.
template <int N>
struct Expansion {
  double term[N];
  int count = 0;

  // Adds one double exactly (grow-expansion, zeros dropped).
  void add(double value) {
    double carry = value;
    int kept = 0;
    for (int i = 0; i < count; ++i) {
      const double sum = carry + term[i];
      const double part = sum - carry;
      const double error = (carry - (sum - part)) + (term[i] - part);
      if (error != 0) term[kept++] = error;
      carry = sum;
    }
    if (carry != 0) term[kept++] = carry;
    count = kept;
  }

  void add_product(double x, double y) {
    const double product = x * y;
    add(std::fma(x, y, -product));
    add(product);
  }

  // The largest term has the sign of the sum.
  int sign() const { return count == 0 ? 0 : term[count - 1] > 0 ? 1 : -1; }
};

// x - y, exact in two terms.
inline Expansion<2> exact_difference(double x, double y) {
  Expansion<2> e;
  e.add(x);
  e.add(-y);
  return e;
}

// sum += sign · x · y
template <int N, int P, int Q>
void add_product(Expansion<N>& sum, const Expansion<P>& x, const Expansion<Q>& y, double sign) {
  for (int i = 0; i < x.count; ++i) {
    for (int j = 0; j < y.count; ++j) sum.add_product(sign * x.term[i], y.term[j]);
  }
}

}  // namespace elbowroom
