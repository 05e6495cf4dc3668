#include "preprocess/seeding/orientation.hpp"

#include <array>
#include <cmath>

namespace tessera::preprocess {
namespace {

int sign(double x) {
  return (x > 0) - (x < 0);
}

/// A sum of doubles held exactly, as parts that do not overlap, smallest first (Shewchuk 1997,
/// grow-expansion).
class ExactSum {
 public:
  void add(double b) {
    int kept = 0;
    for (int k = 0; k < size_; ++k) {
      const double sum = b + parts_[k];
      const double from_part = sum - b;
      const double lost = (b - (sum - from_part)) + (parts_[k] - from_part);
      if (lost != 0)
        parts_[kept++] = lost;
      b = sum;
    }
    if (b != 0)
      parts_[kept++] = b;
    size_ = kept;
  }
  void add_product(double a, double b) {
    const double product = a * b;
    add(std::fma(a, b, -product));
    add(product);
  }
  int sign_of_sum() const { return size_ == 0 ? 0 : sign(parts_[size_ - 1]); }

 private:
  std::array<double, 13> parts_{};
  int size_ = 0;
};

} // namespace

int orientation(const Point2& a, const Point2& b, const Point2& c) {
  const double left = (a.x - c.x) * (b.y - c.y), right = (a.y - c.y) * (b.x - c.x);
  const double det = left - right;
  // Shewchuk's bound (3 + 16 u) u on the relative rounding of this expression, u = 2^-53.
  if (std::abs(det) > 3.3306690738754716e-16 * (std::abs(left) + std::abs(right)))
    return sign(det);
  ExactSum exact;
  exact.add_product(a.x, b.y);
  exact.add_product(-a.x, c.y);
  exact.add_product(-c.x, b.y);
  exact.add_product(-a.y, b.x);
  exact.add_product(a.y, c.x);
  exact.add_product(c.y, b.x);
  return exact.sign_of_sum();
}

int orientation_perturbed(const Point2& a, const Point2& b, const Point2& c) {
  if (const int s = orientation(a, b, c); s != 0)
    return s;
  // d/dc.x of the determinant is a.y - b.y, d/dc.y is b.x - a.x.
  if (a.y != b.y)
    return a.y > b.y ? 1 : -1;
  return sign(b.x - a.x);
}

} // namespace tessera::preprocess
