#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "core/hdf5.h"

/// Reading HDF5 files that nobody has vouched for. The bytes are taken apart by a process of its own for each file (hdf5_server.h),
/// within limits on time and memory that follow the size of the file; what comes here are plain data. A file with broken bytes is
/// refused with an InputError that says what is wrong. Texts are UTF-8: what is not in a file counts as Latin-1.
namespace wishbone::hdf5 {

class ReadContents;

/// A group or a dataset of a file that is being read.
class ObjectReader {
 public:
  /// Path inside the file, "/bodies/chassis/position".
  const std::string& path() const { return path_; }
  /// Path of the file that this object lives in.
  const std::string& file_path() const;

  bool has_attribute(const std::string& name) const;
  /// Throws InputError when there is no such attribute or when it holds something else than a Value can.
  const Value& attribute(const std::string& name) const;
  /// Text of an attribute; empty when there is none or when it is not a text.
  std::string text_attribute(const std::string& name) const;
  /// Every attribute that a Value can hold (references and other foreign types are left out), by name.
  const std::map<std::string, Value>& attributes() const;

 protected:
  ObjectReader(std::shared_ptr<ReadContents> file, std::string path);

  std::shared_ptr<ReadContents> file_;
  std::string path_;
};

/// An array of numbers.
class DatasetReader : public ObjectReader {
 public:
  const Shape& shape() const;
  /// False for texts and other data that do not convert to double.
  bool is_numeric() const;
  /// All elements in row-major order. Throws InputError when they cannot be read, or are more than the file can hold.
  std::vector<double> read() const;
  /// The first `rows` rows (along the first dimension) only; what lies beyond is not touched.
  std::vector<double> read_rows(std::size_t rows) const;

 private:
  friend class GroupReader;
  using ObjectReader::ObjectReader;
};

class GroupReader : public ObjectReader {
 public:
  /// True when the path (relative to this group, or absolute) names an object.
  bool contains(const std::string& path) const;
  /// Names of the members, sorted.
  std::vector<std::string> members() const;
  /// Absolute paths of all datasets in this group and below, sorted.
  std::vector<std::string> dataset_paths() const;

  /// Throws InputError with the nearest existing members when there is no such group.
  GroupReader open_group(const std::string& path) const;
  DatasetReader open_dataset(const std::string& path) const;
  /// Reads a dataset of at most two dimensions; a vector comes back as one column, a scalar as 1x1.
  MatrixX read_matrix(const std::string& path) const;

 protected:
  using ObjectReader::ObjectReader;

 private:
  /// Full path of an object of this kind; throws InputError when there is none.
  std::string find(const std::string& path, bool dataset) const;
};

/// An open file and its root group.
class FileReader : public GroupReader {
 public:
  /// Throws InputError for what is missing, no file, not HDF5, or broken; NumericsError when the system gives no process.
  explicit FileReader(const std::string& path);
};

}  // namespace wishbone::hdf5
