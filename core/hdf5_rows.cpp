#include <functional>
#include <limits>
#include <utility>

#include "core/error.h"
#include "core/hdf5_library.h"

/// Datasets that grow by rows: the compressed series of a finished file, and the table with its views of one under way.
namespace wishbone::hdf5 {
namespace {

std::vector<hsize_t> row_lengths(hsize_t rows, const Shape& row_shape) {
  std::vector<hsize_t> lengths{rows};
  lengths.insert(lengths.end(), row_shape.begin(), row_shape.end());
  return lengths;
}

Handle space_of(const std::vector<hsize_t>& lengths, const std::vector<hsize_t>& most) {
  return Handle(H5Screate_simple(static_cast<int>(lengths.size()), lengths.data(), most.data()), H5Sclose);
}

}  // namespace

std::size_t chunk_rows(const Shape& row_shape, std::size_t most) {
  constexpr std::size_t kMostElements = std::size_t{1} << 17;
  while (most > 1 && most * element_count(row_shape) > kMostElements) most /= 2;
  return most;
}

Dataset Group::create_series(const std::string& path, const Shape& row_shape, const SeriesStorage& storage) {
  const Silence silence;
  const std::string where = where_in(*this, path);
  const std::vector<hsize_t> start = row_lengths(0, row_shape), most = row_lengths(H5S_UNLIMITED, row_shape);
  const std::vector<hsize_t> chunk = row_lengths(chunk_rows(row_shape, storage.chunk_rows), row_shape);

  make_groups_above(*this, path);
  const Handle creation = creation_properties(H5P_DATASET_CREATE);
  const double unwritten = std::numeric_limits<double>::quiet_NaN();
  H5Pset_fill_value(creation.get(), H5T_NATIVE_DOUBLE, &unwritten);
  H5Pset_chunk(creation.get(), static_cast<int>(chunk.size()), chunk.data());
  if (storage.deflate_level > 0) {
    H5Pset_shuffle(creation.get());
    H5Pset_deflate(creation.get(), storage.deflate_level);
  }
  const Handle access(H5Pcreate(H5P_DATASET_ACCESS), H5Pclose);
  H5Pset_chunk_cache(access.get(), 0, 0, 0);
  const Handle space = space_of(start, most);
  Dataset dataset(Handle(
      H5Dcreate2(id(), path.c_str(), H5T_IEEE_F64LE, space.get(), H5P_DEFAULT, creation.get(), access.get()),
      H5Dclose));
  if (dataset.id() < 0) fail_writing(where, "cannot make the dataset");
  return dataset;
}

void Dataset::append(std::span<const double> rows) {
  const Silence silence;
  const std::string where = where_is(*this);
  const Shape old_shape = shape();
  const Shape row_shape(old_shape.begin() + 1, old_shape.end());
  std::vector<hsize_t> start(old_shape.size(), 0);
  start[0] = old_shape[0];
  const std::vector<hsize_t> count = row_lengths(rows.size() / element_count(row_shape), row_shape);
  const std::vector<hsize_t> extent = row_lengths(start[0] + count[0], row_shape);

  if (H5Dset_extent(id(), extent.data()) < 0) fail_writing(where, "cannot extend the dataset");
  const Handle file_space(H5Dget_space(id()), H5Sclose);
  const Handle row_space = space_of(count, count);
  H5Sselect_hyperslab(file_space.get(), H5S_SELECT_SET, start.data(), nullptr, count.data(), nullptr);
  if (H5Dwrite(id(), H5T_NATIVE_DOUBLE, row_space.get(), file_space.get(), H5P_DEFAULT, rows.data()) < 0)
    fail_writing(where, "cannot write the dataset");
}

Dataset Group::create_table(const std::string& path, std::size_t rows, std::size_t columns) {
  const Silence silence;
  const std::string where = where_in(*this, path);
  make_groups_above(*this, path);
  const Handle creation = creation_properties(H5P_DATASET_CREATE);
  H5Pset_alloc_time(creation.get(), H5D_ALLOC_TIME_EARLY);
  H5Pset_fill_time(creation.get(), H5D_FILL_TIME_NEVER);
  const Handle space = simple_space({rows, columns});
  Dataset table(Handle(
      H5Dcreate2(id(), path.c_str(), H5T_IEEE_F64LE, space.get(), H5P_DEFAULT, creation.get(), H5P_DEFAULT),
      H5Dclose));
  if (table.id() < 0) fail_writing(where, "cannot make the table");
  return table;
}

std::size_t Dataset::file_offset() const {
  const haddr_t offset = H5Dget_offset(id());
  if (offset == HADDR_UNDEF) fail_writing(where_is(*this), "the dataset has no place in the file");
  return static_cast<std::size_t>(offset);
}

Dataset Group::create_view(const std::string& path, const Shape& row_shape, const Dataset& table,
                           std::size_t first_column) {
  const Silence silence;
  const std::string where = where_in(*this, path);
  const Handle table_space(H5Dget_space(table.id()), H5Sclose);
  const hsize_t start[2] = {0, first_column};
  const hsize_t count[2] = {table.shape().at(0), element_count(row_shape)};
  H5Sselect_hyperslab(table_space.get(), H5S_SELECT_SET, start, nullptr, count, nullptr);
  const std::vector<hsize_t> lengths = row_lengths(count[0], row_shape);
  const Handle space = space_of(lengths, lengths);

  make_groups_above(*this, path);
  const Handle creation = creation_properties(H5P_DATASET_CREATE);
  H5Pset_virtual(creation.get(), space.get(), ".", table.path().c_str(), table_space.get());
  Dataset view(Handle(
      H5Dcreate2(id(), path.c_str(), H5T_IEEE_F64LE, space.get(), H5P_DEFAULT, creation.get(), H5P_DEFAULT),
      H5Dclose));
  if (view.id() < 0) fail_writing(where, "cannot make the view");
  return view;
}

}  // namespace wishbone::hdf5
