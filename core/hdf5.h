#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "core/spatial.h"

/// A small layer over the HDF5 C library for writing (hdf5_reader.h reads): every identifier has one owner that closes it, every
/// failure is a NumericsError (disk full, file already open elsewhere, ...) that names the file, the object and the library's own
/// innermost message.
///
/// Nothing written carries a time stamp: equal input gives equal bytes. Numbers are double precision, texts UTF-8 of variable length, arrays
/// row-major.
namespace wishbone::hdf5 {

/// Keeps the library from closing at exit what is still open: it crashes on a file whose closing failed (disk full), and here
/// every identifier has an owner that closes it. For main(), before any other use of the library.
void leave_out_exit_handler();

/// Owner of one HDF5 identifier: closes it when it goes out of scope. Movable, not copyable.
class Handle {
 public:
  using Id = std::int64_t;
  using Close = int (*)(Id);

  Handle() = default;
  Handle(Id id, Close close) : id_(id), close_(close) {}
  Handle(Handle&& other) noexcept;
  Handle& operator=(Handle&& other) noexcept;
  ~Handle() { reset(); }

  Id get() const { return id_; }
  /// Closes now; returns false when the library reports a failure.
  bool reset() noexcept;

 private:
  Id id_ = -1;
  Close close_ = nullptr;
};

/// What an attribute may hold: a number, a text, or a list of texts.
using Value = std::variant<double, std::string, std::vector<std::string>>;

/// Lengths of an array, slowest-varying dimension first; empty for a scalar.
using Shape = std::vector<std::size_t>;

/// A group or a dataset: something that has a path and attributes.
class Object {
 public:
  /// Path inside the file, "/bodies/chassis/position".
  std::string path() const;
  /// Path of the file that this object lives in.
  std::string file_path() const;

  /// Writes an attribute, replacing one of that name.
  void set_attribute(const std::string& name, const Value& value);

  Handle::Id id() const { return handle_.get(); }

 protected:
  explicit Object(Handle handle) : handle_(std::move(handle)) {}

  Handle handle_;
};

class Scale;

/// An array of doubles.
class Dataset : public Object {
 public:
  explicit Dataset(Handle handle) : Object(std::move(handle)) {}

  Shape shape() const;

  /// Replaces all elements in place.
  void assign(std::span<const double> values);

  /// Appends whole rows (along the first dimension) to a series made by Group::create_series.
  /// `rows` holds a multiple of the row length.
  void append(std::span<const double> rows);

  /// Says what the elements lie along: one dimension scale for each dimension.
  void attach_scales(std::span<Scale* const> scales);
  /// Where the elements of a table begin in the file [bytes].
  std::size_t file_offset() const;
};

/// A dimension scale (HDF5 dimension scales specification): the places along one dimension of other datasets.
class Scale {
 public:
  /// Makes `dataset` a scale of the given name.
  Scale(Dataset dataset, const std::string& name);
  Dataset& dataset() { return dataset_; }
  /// Writes the list of everything that the scale is attached to; the library would write it anew for every entry.
  void finish();

 private:
  friend class Dataset;
  struct Use {
    std::uint64_t dataset;  ///< object reference
    std::uint32_t dimension;
    std::uint32_t unused = 0;  ///< else the file would hold whatever the padding does
  };

  Dataset dataset_;
  std::vector<Use> uses_;
};

/// How a growing dataset is stored.
struct SeriesStorage {
  std::size_t chunk_rows =
      256;                     ///< rows of one chunk, the unit of compression and of growth; see chunk_rows()
  unsigned deflate_level = 4;  ///< 0 (none) to 9; the bytes are shuffled first
};

/// Rows of a chunk that holds at most a megabyte: `most` halved as often as it takes.
std::size_t chunk_rows(const Shape& row_shape, std::size_t most);

class Group : public Object {
 public:
  explicit Group(Handle handle) : Object(std::move(handle)) {}

  /// True when the path (relative to this group, or absolute) names an object.
  bool contains(const std::string& path) const;

  /// Throws NumericsError when there is no such group.
  Group open_group(const std::string& path) const;
  Dataset open_dataset(const std::string& path) const;

  /// Makes the group and those above it; opens it when it exists already.
  Group create_group(const std::string& path);
  /// Writes an array once. `values` are row-major and as many as `shape` says.
  Dataset write(const std::string& path, const Shape& shape, std::span<const double> values);
  /// Writes a matrix [rows, columns].
  Dataset write(const std::string& path, const Eigen::Ref<const MatrixX>& matrix);
  /// A chunked, compressed dataset [0..unlimited, row_shape...] that grows by Dataset::append. Elements that
  /// were never written read as NaN.
  /// Rows that are appended by whole chunks are written at once; none are kept in memory.
  Dataset create_series(const std::string& path, const Shape& row_shape, const SeriesStorage& storage = {});
  /// A matrix [rows, columns] in one piece, for which the file has room but nothing is written: elements read as zero.
  Dataset create_table(const std::string& path, std::size_t rows, std::size_t columns);
  /// A dataset [rows, row_shape...] that shows columns of a table from `first_column` on (a virtual dataset).
  Dataset create_view(const std::string& path, const Shape& row_shape, const Dataset& table,
                      std::size_t first_column);
};

/// A file under construction and its root group. Closing it closes all its objects.
class File : public Group {
 public:
  /// Makes a new file, replacing one of that name.
  static File create(const std::string& path);

  /// Hands everything to the operating system and closes. No object of the file may be in use after.
  void close();

 private:
  File(Handle file, Handle root) : Group(std::move(root)), file_(std::move(file)) {}

  Handle file_;
};

}  // namespace wishbone::hdf5
