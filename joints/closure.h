#pragma once

#include <span>
#include <vector>

#include "bodies/gauge.h"

namespace wishbone {

template <class T>
class Sides {
 public:
  Sides(std::span<const MarkerStateT<T>> all, std::span<const MarkerIndex> mine) : all_(all), mine_(mine) {}
  const MarkerStateT<T>& operator[](int i) const { return all_[mine_[i]]; }

 private:
  std::span<const MarkerStateT<T>> all_;
  std::span<const MarkerIndex> mine_;
};
template <class T>
class MarkerAccelerations {
 public:
  MarkerAccelerations(std::span<const MarkerAccelerationT<T>> all, std::span<const MarkerIndex> mine)
      : all_(all), mine_(mine) {}
  const MarkerAccelerationT<T>& operator[](int i) const { return all_[mine_[i]]; }

 private:
  std::span<const MarkerAccelerationT<T>> all_;
  std::span<const MarkerIndex> mine_;
};

}  // namespace wishbone
