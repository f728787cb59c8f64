#include "core/hdf5.h"

#include <fmt/core.h>
#include <hdf5.h>
#include <hdf5_hl.h>
#include <unistd.h>

#include <limits>
#include <type_traits>
#include <utility>

#include "core/error.h"
#include "core/hdf5_library.h"

namespace wishbone::hdf5 {

static_assert(std::is_same_v<Handle::Id, hid_t>, "HDF5 1.10 or later has 64-bit identifiers");

namespace {

std::string join(const std::string& parent, const std::string& path) {
  if (path.starts_with('/')) return path;
  return parent == "/" ? "/" + path : parent + "/" + path;
}

/// Links whose parent groups are made on the way.
Handle link_properties() {
  Handle properties(H5Pcreate(H5P_LINK_CREATE), H5Pclose);
  H5Pset_create_intermediate_group(properties.get(), 1);
  return properties;
}

/// Object headers without time stamps: equal input, equal bytes.
Handle creation_properties(hid_t property_class) {
  Handle properties(H5Pcreate(property_class), H5Pclose);
  H5Pset_obj_track_times(properties.get(), false);
  return properties;
}

}  // namespace

void leave_out_exit_handler() {
  H5dont_atexit();
}

Handle::Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, -1)), close_(other.close_) {}

Handle& Handle::operator=(Handle&& other) noexcept {
  reset();
  id_ = std::exchange(other.id_, -1);
  close_ = other.close_;
  return *this;
}

bool Handle::reset() noexcept {
  if (id_ < 0) return true;
  const Silence silence;
  return close_(std::exchange(id_, -1)) >= 0;
}

std::string Object::path() const {
  return name_of(id(), H5Iget_name);
}

std::string Object::file_path() const {
  return name_of(id(), H5Fget_name);
}

Shape Dataset::shape() const {
  const Handle space(H5Dget_space(id()), H5Sclose);
  return shape_of(space.get());
}

void Dataset::assign(std::span<const double> values) {
  const Silence silence;
  const std::string where = where_is(*this);
  if (values.size() != element_count(shape()))
    throw InputError({where, "the number of values differs from the size of the dataset",
                      fmt::format("{}", values.size()), ""});
  if (H5Dwrite(id(), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) < 0)
    fail_writing(where, "cannot write the dataset");
}

void Dataset::append(std::span<const double> rows) {
  const Silence silence;
  const std::string where = where_is(*this);
  const Shape old_shape = shape();
  std::vector<hsize_t> start(old_shape.size(), 0);
  std::vector<hsize_t> count(old_shape.begin(), old_shape.end());
  const std::size_t row_length = element_count(Shape(old_shape.begin() + 1, old_shape.end()));
  start[0] = old_shape[0];
  count[0] = rows.size() / row_length;
  std::vector<hsize_t> extent = count;
  extent[0] = start[0] + count[0];

  if (H5Dset_extent(id(), extent.data()) < 0) fail_writing(where, "cannot extend the dataset");
  const Handle file_space(H5Dget_space(id()), H5Sclose);
  const Handle row_space(H5Screate_simple(static_cast<int>(count.size()), count.data(), nullptr), H5Sclose);
  H5Sselect_hyperslab(file_space.get(), H5S_SELECT_SET, start.data(), nullptr, count.data(), nullptr);
  if (H5Dwrite(id(), H5T_NATIVE_DOUBLE, row_space.get(), file_space.get(), H5P_DEFAULT, rows.data()) < 0)
    fail_writing(where, "cannot write the dataset");
}

void Dataset::make_scale(const std::string& name) {
  const Silence silence;
  const std::string where = where_is(*this);
  if (H5DSset_scale(id(), name.c_str()) < 0) fail_writing(where, "cannot make a dimension scale");
}

void Dataset::attach_scale(const Dataset& scale) {
  const Silence silence;
  const std::string where = where_is(*this);
  if (H5DSattach_scale(id(), scale.id(), 0) < 0) fail_writing(where, "cannot attach the dimension scale");
}

bool Group::contains(const std::string& path) const {
  const Silence silence;
  // The library wants every parent checked before the child.
  for (std::size_t end = path.find('/', 1); end != std::string::npos; end = path.find('/', end + 1))
    if (H5Lexists(id(), path.substr(0, end).c_str(), H5P_DEFAULT) <= 0) return false;
  return path == "/" || H5Lexists(id(), path.c_str(), H5P_DEFAULT) > 0;
}

Group Group::open_group(const std::string& path) const {
  const Silence silence;
  Handle handle(H5Gopen2(id(), path.c_str(), H5P_DEFAULT), H5Gclose);
  if (handle.get() < 0) fail_writing(file_path() + ":" + join(this->path(), path), "no such group");
  return Group(std::move(handle));
}

Dataset Group::open_dataset(const std::string& path) const {
  const Silence silence;
  Handle handle(H5Dopen2(id(), path.c_str(), H5P_DEFAULT), H5Dclose);
  if (handle.get() < 0) fail_writing(file_path() + ":" + join(this->path(), path), "no such dataset");
  return Dataset(std::move(handle));
}

Group Group::create_group(const std::string& path) {
  if (contains(path)) return open_group(path);
  const Silence silence;
  const std::string where = file_path() + ":" + join(this->path(), path);
  const Handle links = link_properties();
  const Handle creation = creation_properties(H5P_GROUP_CREATE);
  {
    const Handle made(H5Gcreate2(id(), path.c_str(), links.get(), creation.get(), H5P_DEFAULT), H5Gclose);
    if (made.get() < 0) fail_writing(where, "cannot make the group");
  }
  return open_group(path);
}

Dataset Group::write(const std::string& path, const Shape& shape, std::span<const double> values) {
  const Silence silence;
  const std::string where = file_path() + ":" + join(this->path(), path);
  if (values.size() != element_count(shape))
    throw InputError({where, "the number of values differs from what the shape says",
                      fmt::format("{} values for a shape of {}", values.size(), element_count(shape)), ""});
  const Handle links = link_properties();
  const Handle creation = creation_properties(H5P_DATASET_CREATE);
  const Handle space = simple_space(shape);
  Dataset dataset(Handle(
      H5Dcreate2(id(), path.c_str(), H5T_IEEE_F64LE, space.get(), links.get(), creation.get(), H5P_DEFAULT),
      H5Dclose));
  if (dataset.id() < 0) fail_writing(where, "cannot make the dataset");
  if (!values.empty() &&
      H5Dwrite(dataset.id(), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) < 0)
    fail_writing(where, "cannot write the dataset");
  return dataset;
}

Dataset Group::write(const std::string& path, const Eigen::Ref<const MatrixX>& matrix) {
  const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> rows = matrix;
  return write(path, {static_cast<std::size_t>(rows.rows()), static_cast<std::size_t>(rows.cols())},
               {rows.data(), static_cast<std::size_t>(rows.size())});
}

Dataset Group::create_series(const std::string& path, const Shape& row_shape, const SeriesStorage& storage) {
  const Silence silence;
  const std::string where = file_path() + ":" + join(this->path(), path);
  std::vector<hsize_t> start{0}, most{H5S_UNLIMITED}, chunk{storage.chunk_rows};
  for (std::vector<hsize_t>* lengths : {&start, &most, &chunk})
    lengths->insert(lengths->end(), row_shape.begin(), row_shape.end());
  const int rank = static_cast<int>(start.size());

  const Handle links = link_properties();
  const Handle creation = creation_properties(H5P_DATASET_CREATE);
  const double unwritten = std::numeric_limits<double>::quiet_NaN();
  H5Pset_fill_value(creation.get(), H5T_NATIVE_DOUBLE, &unwritten);
  H5Pset_chunk(creation.get(), rank, chunk.data());
  if (storage.deflate_level > 0) {
    H5Pset_shuffle(creation.get());
    H5Pset_deflate(creation.get(), storage.deflate_level);
  }
  const Handle space(H5Screate_simple(rank, start.data(), most.data()), H5Sclose);
  Dataset dataset(Handle(
      H5Dcreate2(id(), path.c_str(), H5T_IEEE_F64LE, space.get(), links.get(), creation.get(), H5P_DEFAULT),
      H5Dclose));
  if (dataset.id() < 0) fail_writing(where, "cannot make the dataset");
  return dataset;
}

File File::create(const std::string& path) {
  const Silence silence;
  const Handle creation = creation_properties(H5P_FILE_CREATE);
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5Pset_fclose_degree(access.get(), H5F_CLOSE_STRONG);
  Handle file(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, creation.get(), access.get()), H5Fclose);
  if (file.get() < 0) fail_writing(path, "cannot make the file");

  // Metadata leave the cache by flush() only.
  H5AC_cache_config_t cache;
  cache.version = H5AC__CURR_CACHE_CONFIG_VERSION;
  H5Fget_mdc_config(file.get(), &cache);
  cache.evictions_enabled = false;
  cache.incr_mode = H5C_incr__off;
  cache.flash_incr_mode = H5C_flash_incr__off;
  cache.decr_mode = H5C_decr__off;
  if (H5Fset_mdc_config(file.get(), &cache) < 0) fail_writing(path, "cannot configure the metadata cache");

  Handle root(H5Gopen2(file.get(), "/", H5P_DEFAULT), H5Gclose);
  if (root.get() < 0) fail_writing(path, "cannot open the root group");
  return File(std::move(file), std::move(root));
}

void File::flush() {
  const Silence silence;
  const std::string where = file_path();
  if (H5Fflush(file_.get(), H5F_SCOPE_GLOBAL) < 0) fail_writing(where, "cannot write");
}

void File::close() {
  flush();
  const std::string path = file_path();
  {
    const Silence silence;
    void* descriptor = nullptr;
    if (H5Fget_vfd_handle(file_.get(), H5P_DEFAULT, &descriptor) >= 0 &&
        fsync(*static_cast<int*>(descriptor)) != 0)
      fail_writing(path, "cannot put the file on the disk");
  }
  const bool closed_root = handle_.reset();
  if (!file_.reset() || !closed_root) fail_writing(path, "cannot close the file");
}

}  // namespace wishbone::hdf5
