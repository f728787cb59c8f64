#include "app/wide_signal.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace wishbone {
namespace {

constexpr std::size_t kVectorsShown = 2;
constexpr std::size_t kScalarsShown = 4;

/// Numbers that a reader sees as one thing: a vector where the signal has axes, else a single number.
int width_of_thing(const Signal& signal) {
  if (signal.shape.size() > 1) return signal.shape.back();
  return signal.frame.empty() ? 1 : signal.size();
}

bool has(const ResultFile& file, const Signal& signal) {
  const Signal* own = file.find(signal.path);
  return own && own->shape == signal.shape && file.time().size() > 0;
}

/// Largest norm of each thing over both files; what is not a number counts as infinite, not to be overlooked.
VectorX largest_norms(const Signal& signal, int width, const ResultFile& a, const ResultFile& b) {
  VectorX largest = VectorX::Zero(signal.size() / width);
  for (const ResultFile* file : {&a, &b}) {
    if (!has(*file, signal)) continue;
    const MatrixX u = file->read(signal.path);
    for (Eigen::Index i = 0; i < largest.size(); ++i) {
      const VectorX norms = u.middleCols(i * width, width).rowwise().norm();
      largest[i] =
          norms.hasNaN() ? std::numeric_limits<double>::infinity() : std::max(largest[i], norms.maxCoeff());
    }
  }
  return largest;
}

}  // namespace

std::vector<int> notable_components(const Signal& signal, const ResultFile& a, const ResultFile& b) {
  const int width = width_of_thing(signal);
  std::vector<int> things(static_cast<std::size_t>(signal.size() / width));
  std::iota(things.begin(), things.end(), 0);
  const std::size_t most = width > 1 ? kVectorsShown : kScalarsShown;
  if (things.size() > most) {
    const VectorX largest = largest_norms(signal, width, a, b);
    std::stable_sort(things.begin(), things.end(), [&](int i, int j) { return largest[i] > largest[j]; });
    things.resize(most);
    std::sort(things.begin(), things.end());
  }
  std::vector<int> components;
  for (const int thing : things)
    for (int i = 0; i < width; ++i) components.push_back(thing * width + i);
  return components;
}

VectorX peaks(const Signal& signal, const ResultFile& file) {
  if (!has(file, signal)) return {};
  return file.read(signal.path).cwiseAbs().colwise().maxCoeff();
}

}  // namespace wishbone
