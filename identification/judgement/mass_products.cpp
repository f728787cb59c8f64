#include "identification/judgement/mass_products.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace wishbone {

std::string largest_mass_products(const MatrixX& shapes, const SparseMatrix& M, std::size_t count) {
  constexpr double kLeast = 1e-3;
  struct Product {
    double size;
    Eigen::Index i, j;
  };
  const MatrixX gram = shapes.transpose() * (M * shapes);
  std::vector<Product> products;
  for (Eigen::Index i = 0; i < gram.rows(); ++i)
    for (Eigen::Index j = 0; j < i; ++j)
      if (const double size = std::abs(gram(i, j)) / std::sqrt(gram(i, i) * gram(j, j)); size >= kLeast)
        products.push_back({size, j + 1, i + 1});
  std::stable_sort(products.begin(), products.end(),
                   [](const Product& a, const Product& b) { return a.size > b.size; });
  std::string text;
  for (std::size_t k = 0; k < std::min(count, products.size()); ++k)
    text += fmt::format("{}{:.3f} (modes {} and {})", k > 0 ? ", " : "", products[k].size, products[k].i,
                        products[k].j);
  return text;
}

}  // namespace wishbone
