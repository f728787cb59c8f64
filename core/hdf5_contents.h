#pragma once

#include <map>
#include <set>
#include <string>
#include <string_view>

#include "core/hdf5.h"

/// What is in an HDF5 file, all but the numbers of its datasets: plain data that goes from one process to another.
namespace wishbone::hdf5 {

struct ObjectFacts {
  bool is_dataset = false;  ///< else a group
  bool is_numeric = false;  ///< of a dataset: its elements convert to double
  Shape shape;              ///< of a dataset
  std::map<std::string, Value> attributes;
  std::set<std::string> others;  ///< attributes that a Value cannot hold
};

/// Every group and dataset by its absolute path, the root "/" among them.
using Contents = std::map<std::string, ObjectFacts>;

/// The path of what `parent` knows as `path`, which may be absolute; "" and "." mean the parent itself.
std::string joined_path(const std::string& parent, const std::string& path);

std::string packed(const Contents& contents);
/// Throws std::out_of_range for bytes that are not those of packed().
Contents unpacked_contents(std::string_view bytes);

}  // namespace wishbone::hdf5
