#include "core/hdf5.h"

#include <fmt/core.h>
#include <hdf5.h>

#include <type_traits>
#include <utility>

#include "core/error.h"
#include "core/hdf5_contents.h"
#include "core/hdf5_library.h"

namespace wishbone::hdf5 {

static_assert(std::is_same_v<Handle::Id, hid_t>, "HDF5 1.10 or later has 64-bit identifiers");

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
  if (handle.get() < 0) fail_writing(file_path() + ":" + joined_path(this->path(), path), "no such group");
  return Group(std::move(handle));
}

Dataset Group::open_dataset(const std::string& path) const {
  const Silence silence;
  Handle handle(H5Dopen2(id(), path.c_str(), H5P_DEFAULT), H5Dclose);
  if (handle.get() < 0) fail_writing(file_path() + ":" + joined_path(this->path(), path), "no such dataset");
  return Dataset(std::move(handle));
}

Group Group::create_group(const std::string& path) {
  if (contains(path)) return open_group(path);
  const Silence silence;
  const std::string where = where_in(*this, path);
  make_groups_above(*this, path);
  const Handle creation = creation_properties(H5P_GROUP_CREATE);
  {
    const Handle made(H5Gcreate2(id(), path.c_str(), H5P_DEFAULT, creation.get(), H5P_DEFAULT), H5Gclose);
    if (made.get() < 0) fail_writing(where, "cannot make the group");
  }
  return open_group(path);
}

Dataset Group::write(const std::string& path, const Shape& shape, std::span<const double> values) {
  const Silence silence;
  const std::string where = where_in(*this, path);
  if (values.size() != element_count(shape))
    throw InputError({where, "the number of values differs from what the shape says",
                      fmt::format("{} values for a shape of {}", values.size(), element_count(shape)), ""});
  make_groups_above(*this, path);
  const Handle creation = creation_properties(H5P_DATASET_CREATE);
  const Handle space = simple_space(shape);
  Dataset dataset(Handle(
      H5Dcreate2(id(), path.c_str(), H5T_IEEE_F64LE, space.get(), H5P_DEFAULT, creation.get(), H5P_DEFAULT),
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

File File::create(const std::string& path) {
  const Silence silence;
  const Handle creation = creation_properties(H5P_FILE_CREATE);
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5Pset_fclose_degree(access.get(), H5F_CLOSE_STRONG);
  // The format of HDF5 1.8: attributes may exceed 64 KiB, as the list of what hangs on a dimension scale does.
  H5Pset_libver_bounds(access.get(), H5F_LIBVER_V18, H5F_LIBVER_LATEST);
  Handle file(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, creation.get(), access.get()), H5Fclose);
  if (file.get() < 0) fail_writing(path, "cannot make the file");
  Handle root(H5Gopen2(file.get(), "/", H5P_DEFAULT), H5Gclose);
  if (root.get() < 0) fail_writing(path, "cannot open the root group");
  return File(std::move(file), std::move(root));
}

void File::close() {
  const std::string path = file_path();
  {
    const Silence silence;
    if (H5Fflush(file_.get(), H5F_SCOPE_GLOBAL) < 0) fail_writing(path, "cannot write");
  }
  const bool closed_root = handle_.reset();
  if (!file_.reset() || !closed_root) fail_writing(path, "cannot close the file");
}

}  // namespace wishbone::hdf5
